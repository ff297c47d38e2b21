#include "app/python_verbs.hpp"

#include <CLI/CLI.hpp>
#include <vector>

#include "app/places.hpp"
#include "app/python_tools.hpp"

namespace solidus::app {

PythonVerbs::PythonVerbs(CLI::App& program)
    : plot_(program.add_subcommand("plot", "Draw the pictures of a folder of results")),
      compare_(program.add_subcommand("compare", "Compare two runs: tables, curves and fields")),
      study_(program.add_subcommand("study", "Run a case many times with other values, and compare")),
      uncertain_(program.add_subcommand(
          "uncertain", "Print how far the answers of a case may be off because its data are")),
      mcp_(program.add_subcommand(
          "mcp", "Serve assistants: the Model Context Protocol over standard input and output")) {
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
  CaseArguments& c = uncertain_case_;
  uncertain_
      ->add_option("CASE", c.path,
                   "A case file, or a folder with a case.toml; CASE:VARIANT for one of its variants")
      ->required();
  uncertain_->add_option("--set", c.set, "Change a key, for example --set time.step=\"0.5 s\"")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  uncertain_->add_flag("--heat-only", c.heat_only, "Compute heat alone");
  uncertain_->add_flag("--trust-geo", c.trust_script, "Run .geo scripts whatever they say, as of run");
  uncertain_->add_option("-o,--output", output_, "Folder of all runs; default results/CASE/uncertain")
      ->type_name("FOLDER");
  uncertain_->add_option("-j,--jobs", jobs_, "Runs at a time; default one a core")->type_name("NUMBER");
  uncertain_->add_option("--runs", runs_, "Runs at most; default 20")->type_name("NUMBER");
  uncertain_->add_flag("--one-sided", one_sided_, "Move no parameter to the lower end of its range");
  uncertain_
      ->add_option("--samples", samples_, "So many runs of a Latin hypercube instead of one a parameter")
      ->type_name("NUMBER");
  uncertain_->add_option("--seed", seed_, "Of the samples; default 1")->type_name("NUMBER");
  uncertain_->add_flag("--restart", restart_, "Keep the runs that have ended");
  uncertain_->add_flag("--dry-run", dry_run_, "Print what is uncertain and run nothing");
  uncertain_->add_flag("--parameters", parameters_, "Print what is uncertain as JSON and run nothing");
  mcp_->add_option("FOLDER", folder_, "The only folder that is worked in; default the present one");
  mcp_->add_flag("--trust-files", trust_files_,
                 "Serve where the system cannot refuse other files: only the paths of cases are looked at");
}

std::optional<ExitCode> PythonVerbs::run_uncertain() const {
  if (parameters_) return list_uncertain(uncertain_case_);
  std::vector<std::string> arguments = {uncertain_case_.path};
  // With the sign between them: a value may begin with a dash.
  for (const std::string& assignment : uncertain_case_.set) arguments.push_back("--set=" + assignment);
  const auto add = [&](const std::string& name, const std::string& value) {
    if (!value.empty()) arguments.push_back(name + "=" + value);
  };
  const auto flag = [&](const char* name, bool wanted) {
    if (wanted) arguments.emplace_back(name);
  };
  if (output_.empty()) add("--results-root", results_root().string());
  add("--output", output_);
  add("--jobs", jobs_);
  add("--runs", runs_);
  add("--samples", samples_);
  add("--seed", seed_);
  flag("--heat-only", uncertain_case_.heat_only);
  flag("--trust-geo", uncertain_case_.trust_script);
  flag("--one-sided", one_sided_);
  flag("--restart", restart_);
  flag("--dry-run", dry_run_);
  return run_python("uncertain", arguments);
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
    return run_python("plot_case", arguments);
  }
  if (*compare_) {
    arguments.push_back(other_);
    add("--output", output_);
    flag("--no-plots", no_plots_);
    return run_python("compare", arguments);
  }
  if (*uncertain_) return run_uncertain();
  if (*mcp_) {
    if (folder_.empty()) arguments = {"."};
    flag("--trust-files", trust_files_);
    return run_python("solidus_casting.mcp", arguments);
  }
  if (!*study_) return {};
  if (output_.empty()) add("--results-root", results_root().string());
  add("--output", output_);
  add("--jobs", jobs_);
  flag("--restart", restart_);
  flag("--dry-run", dry_run_);
  return run_python("study", arguments);
}

}  // namespace solidus::app
