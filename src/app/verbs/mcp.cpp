/// The verb `mcp`, which Python does.
#include "app/python_tools.hpp"
#include "app/verb.hpp"

namespace solidus::app {

namespace {

class Mcp final : public Verb {
 public:
  explicit Mcp(CLI::App& program)
      : Verb(program, "mcp", "Serve assistants: the Model Context Protocol over standard input and output") {
    command().add_option("FOLDER", folder_, "The only folder that is worked in; default the present one");
    command().add_flag(
        "--trust-files", trust_files_,
        "Serve where the system cannot refuse other files: only the paths of cases are looked at");
  }
  ExitCode run() override {
    PythonArguments arguments = {folder_.empty() ? "." : folder_};
    arguments.flag("--trust-files", trust_files_);
    return run_python("solidus_casting.mcp", arguments.words());
  }

 private:
  std::string folder_;
  bool trust_files_ = false;
};

}  // namespace

std::unique_ptr<Verb> mcp_verb(CLI::App& program) {
  return std::make_unique<Mcp>(program);
}

}  // namespace solidus::app
