/// The verb `study`, which Python does.
#include "app/places.hpp"
#include "app/python_tools.hpp"
#include "app/verb.hpp"

namespace solidus::app {

namespace {

class Study final : public Verb {
 public:
  explicit Study(CLI::App& program)
      : Verb(program, "study", "Run a case many times with other values, and compare") {
    command().add_option("FILE", file_, "The study: a case, values, how to choose them")->required();
    command()
        .add_option("-o,--output", output_, "Folder of all runs; default results/CASE/STUDY")
        ->type_name("FOLDER");
    command().add_option("-j,--jobs", jobs_, "Runs at a time; default one a core")->type_name("NUMBER");
    command().add_flag("--restart", restart_, "Keep the runs that have ended");
    command().add_flag("--dry-run", dry_run_, "Print the table of runs and run none");
  }
  ExitCode run() override {
    PythonArguments arguments = {file_};
    if (output_.empty()) arguments.add("--results-root", results_root().string());
    arguments.add("--output", output_);
    arguments.add("--jobs", jobs_);
    arguments.flag("--restart", restart_);
    arguments.flag("--dry-run", dry_run_);
    return run_python("study", arguments.words());
  }

 private:
  std::string file_, output_, jobs_;
  bool restart_ = false, dry_run_ = false;
};

}  // namespace

std::unique_ptr<Verb> study_verb(CLI::App& program) {
  return std::make_unique<Study>(program);
}

}  // namespace solidus::app
