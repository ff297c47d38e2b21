/// The verb `export`: what a run left in a format of another program (app/export_format.hpp).
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <vector>

#include "app/case_arguments.hpp"
#include "app/export_format.hpp"
#include "app/verb.hpp"
#include "system/errors.hpp"

namespace solidus::app {

namespace {

/// "--calculix, --abaqus or --med".
std::string listed(const std::vector<std::string>& options, const char* last) {
  if (options.size() < 2) return options.empty() ? "" : options.front();
  return fmt::format("{} {} {}", fmt::join(options.begin(), options.end() - 1, ", "), last, options.back());
}

/// The options of the formats that start an analysis.
std::vector<std::string> options_of_analyses() {
  std::vector<std::string> options;
  for (const ExportFormat& format : export_formats())
    if (format.starts_analysis) options.push_back(fmt::format("--{}", format.name));
  return options;
}

class Export final : public Verb {
 public:
  explicit Export(CLI::App& program)
      : Verb(program, "export",
             "Write what a run left for another program: its end as the "
             "start of a structural analysis, or its fields"),
        files_(export_formats().size()) {
    command().add_option("FOLDER", folder_, "Folder of the run's results")->required();
    // One option for each format that has registered itself; they share the other ones.
    for (std::size_t i = 0; i < files_.size(); ++i) {
      const ExportFormat& format = export_formats()[i];
      command()
          .add_option(fmt::format("--{}", format.name), files_[i], std::string(format.help))
          ->type_name("FILE");
    }
    command().add_flag("--deformed", request_.deformed, "Deformed instead of nominal coordinates");
    command().add_flag("--temperature-history", request_.temperature_history,
                       fmt::format("With {}: the temperatures of all times as the load, no stress",
                                   listed(options_of_analyses(), "or")));
    add_trust(command(), request_.trust_script);
    add_trust_laws(command());
  }

  ExitCode run() override {
    const std::size_t chosen = chosen_format();
    const ExportFormat& format = export_formats()[chosen];
    if (!format.starts_analysis && (request_.deformed || request_.temperature_history))
      throw InputError({},
                       fmt::format("--deformed and --temperature-history are for {}",
                                   listed(options_of_analyses(), "and")),
                       "displacements are among the fields: Warp By Vector in ParaView");
    request_.folder = folder_;
    request_.file = files_[chosen];
    print(format.write(request_));
    return k_done;
  }

 private:
  /// The one format for which a file is given. Throws InputError for none or several.
  std::size_t chosen_format() const {
    std::vector<std::size_t> asked_for;
    std::vector<std::string> options;
    for (std::size_t i = 0; i < files_.size(); ++i) {
      options.push_back(fmt::format("--{} FILE", export_formats()[i].name));
      if (!files_[i].empty()) asked_for.push_back(i);
    }
    if (asked_for.size() != 1)
      throw InputError({}, "export needs one format and the file to write", listed(options, "or"));
    return asked_for.front();
  }

  std::string folder_;
  std::vector<std::string> files_;  ///< [format], to write; one of them is not empty
  ExportRequest request_;
};

}  // namespace

std::unique_ptr<Verb> export_verb(CLI::App& program) {
  return std::make_unique<Export>(program);
}

}  // namespace solidus::app
