#include "app/python_verbs.hpp"

#include <CLI/CLI.hpp>
#include <vector>

#include "app/places.hpp"
#include "app/python_tools.hpp"

namespace solidus::app {

PythonVerbs::PythonVerbs(CLI::App& program)
    : plot_(program.add_subcommand("plot", "Draw the pictures of a folder of results")),
      compare_(program.add_subcommand("compare", "Compare two runs: tables, curves and fields")),
      study_(program.add_subcommand("study", "Run a case many times with other values, and compare")) {
  plot_->add_option("FOLDER", folder_, "Folder of the results")->required();
  plot_->add_option("--plots", plots_, "A plots.toml other than the case's own")->type_name("FILE");
  compare_->add_option("FOLDER", folder_, "Folder of the results of one run")->required();
  compare_->add_option("OTHER_FOLDER", other_, "Folder of the results of another run")->required();
  compare_->add_option("-o,--output", output_, "Folder for tables and pictures; default FOLDER/compare_OTHER")
      ->type_name("FOLDER");
  compare_->add_flag("--no-plots", no_plots_, "Tables alone");
  study_->add_option("FILE", folder_, "The study: a case, values, how to choose them")->required();
  study_->add_option("-o,--output", output_, "Folder of all runs; default results/CASE/STUDY")
      ->type_name("FOLDER");
  study_->add_option("-j,--jobs", jobs_, "Runs at a time; default one a core")->type_name("NUMBER");
  study_->add_flag("--restart", restart_, "Keep the runs that have ended");
  study_->add_flag("--dry-run", dry_run_, "Print the table of runs and run none");
}

std::optional<ExitCode> PythonVerbs::run() const {
  std::vector<std::string> arguments = {folder_};
  const auto add = [&](const char* name, const std::string& value) {
    if (!value.empty()) arguments.insert(arguments.end(), {name, value});
  };
  const auto flag = [&](const char* name, bool wanted) {
    if (wanted) arguments.emplace_back(name);
  };
  if (*plot_) {
    add("--plots", plots_);
    return run_python("solidus_plots", arguments);
  }
  if (*compare_) {
    arguments.push_back(other_);
    add("--output", output_);
    flag("--no-plots", no_plots_);
    return run_python("solidus_plots.compare", arguments);
  }
  if (!*study_) return {};
  if (output_.empty()) add("--results-root", results_root().string());
  add("--output", output_);
  add("--jobs", jobs_);
  flag("--restart", restart_);
  flag("--dry-run", dry_run_);
  return run_python("solidus_plots.study", arguments);
}

}  // namespace solidus::app
