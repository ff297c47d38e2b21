/// The verb `plot`, which Python does.
#include "app/python_tools.hpp"
#include "app/verb.hpp"

namespace solidus::app {

namespace {

class Plot final : public Verb {
 public:
  explicit Plot(CLI::App& program) : Verb(program, "plot", "Draw the pictures of a folder of results") {
    command().add_option("FOLDER", folder_, "Folder of the results")->required();
    command().add_option("--plots", plots_, "A plots.toml other than the case's own")->type_name("FILE");
  }
  ExitCode run() override {
    PythonArguments arguments = {folder_};
    arguments.add("--plots", plots_);
    return run_python("plot_case", arguments.words());
  }

 private:
  std::string folder_, plots_;
};

}  // namespace

std::unique_ptr<Verb> plot_verb(CLI::App& program) {
  return std::make_unique<Plot>(program);
}

}  // namespace solidus::app
