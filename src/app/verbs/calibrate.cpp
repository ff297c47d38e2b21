/// The verb `calibrate`, which Python does.
#include "app/case_arguments.hpp"
#include "app/places.hpp"
#include "app/python_tools.hpp"
#include "app/verb.hpp"

namespace solidus::app {

namespace {

class Calibrate final : public Verb {
 public:
  explicit Calibrate(CLI::App& program)
      : Verb(program, "calibrate", "Find what of a case is unknown from measurements, with intervals") {
    add_case(command(), case_);
    command().add_option("MEASURED", measured_, "Readings: a table as a logger writes it")->required();
    command().add_flag("--heat-only", case_.heat_only, "Compute heat alone");
    command()
        .add_option("--unknowns", unknowns_, "What is unknown; default calibrate.toml next to the case")
        ->type_name("FILE");
    command()
        .add_option("-o,--output", output_, "Folder of all runs; default results/CASE/calibrate")
        ->type_name("FOLDER");
    command()
        .add_option("-j,--jobs", jobs_, "Runs at a time, for differences; default one a core")
        ->type_name("NUMBER");
  }
  ExitCode run() override {
    PythonArguments arguments = {case_.path, measured_};
    for (const std::string& assignment : case_.set) arguments.add("--set", assignment);
    arguments.flag("--heat-only", case_.heat_only);
    arguments.add("--unknowns", unknowns_);
    if (output_.empty()) arguments.add("--results-root", results_root().string());
    arguments.add("--output", output_);
    arguments.add("--jobs", jobs_);
    return run_python("calibrate", arguments.words());
  }

 private:
  CaseArguments case_;
  std::string measured_, unknowns_, output_, jobs_;
};

}  // namespace

std::unique_ptr<Verb> calibrate_verb(CLI::App& program) {
  return std::make_unique<Calibrate>(program);
}

}  // namespace solidus::app
