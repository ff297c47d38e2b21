/// The verb `fill`: how the metal fills the mould of a case.
#include <filesystem>

#include "app/case_arguments.hpp"
#include "app/mould_filling.hpp"
#include "app/places.hpp"
#include "app/verb.hpp"
#include "results/output/run_folder.hpp"

namespace solidus::app {

namespace {

constexpr int k_most_processes = 64;

class Fill final : public Verb {
 public:
  explicit Fill(CLI::App& program)
      : Verb(program, "fill", "Fill the mould of a case with metal, by OpenFOAM, as [filling] says") {
    add_case(command(), arguments_);
    command()
        .add_option("-o,--output", output_, "Folder of the filling; default results/CASE/VARIANT/filling")
        ->type_name("FOLDER");
    command()
        .add_option("--processes", options_.processes,
                    "Compute the flow on so many processes; default as many as pay")
        ->type_name("NUMBER")
        ->check(CLI::Range(1, k_most_processes));
    command().add_flag("--restart", options_.restart, "Continue a filling that was stopped");
    add_trust(command(), arguments_.trust_script);
  }
  ExitCode run() override {
    const setup::Case c = load_case(arguments_);
    const std::filesystem::path folder =
        output_.empty() ? results_root() / results::default_run_folder(c.file, c.variant) / "filling"
                        : std::filesystem::path(output_);
    return fill_mould(c, folder, options_);
  }

 private:
  CaseArguments arguments_;
  std::string output_;
  FillingOptions options_;
};

}  // namespace

std::unique_ptr<Verb> fill_verb(CLI::App& program) {
  return std::make_unique<Fill>(program);
}

}  // namespace solidus::app
