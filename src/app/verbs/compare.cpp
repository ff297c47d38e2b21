/// The verb `compare`, which Python does.
#include "app/python_tools.hpp"
#include "app/verb.hpp"

namespace solidus::app {

namespace {

class Compare final : public Verb {
 public:
  explicit Compare(CLI::App& program)
      : Verb(program, "compare", "Compare two runs: tables, curves and fields") {
    command().add_option("FOLDER", folder_, "Folder of the results of one run")->required();
    command().add_option("OTHER_FOLDER", other_, "Folder of the results of another run")->required();
    command()
        .add_option("-o,--output", output_, "Folder for tables and pictures; default FOLDER/compare_OTHER")
        ->type_name("FOLDER");
    command().add_flag("--no-plots", no_plots_, "Tables alone");
  }
  ExitCode run() override {
    PythonArguments arguments = {folder_, other_};
    arguments.add("--output", output_);
    arguments.flag("--no-plots", no_plots_);
    return run_python("compare", arguments.words());
  }

 private:
  std::string folder_, other_, output_;
  bool no_plots_ = false;
};

}  // namespace

std::unique_ptr<Verb> compare_verb(CLI::App& program) {
  return std::make_unique<Compare>(program);
}

}  // namespace solidus::app
