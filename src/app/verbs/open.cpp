/// The verb `open`, which Python does: a page for the browser in which a case is made, run and judged.
#include "app/python_tools.hpp"
#include "app/verb.hpp"

namespace solidus::app {

namespace {

class Open final : public Verb {
 public:
  explicit Open(CLI::App& program)
      : Verb(program, "open",
             "Make, check, run and judge a case in the browser, at an address of this machine alone") {
    // What is opened at first; without it the page asks for a file.
    command().add_option("PART", path_,
                         "A part (STEP, BREP, IGES, STL), a mesh or a case; default none: the page asks");
    command().add_flag("--no-browser", no_browser_, "Print the address and start no browser");
  }
  ExitCode run() override {
    PythonArguments arguments = {};
    arguments.flag("--no-browser", no_browser_);
    // After two dashes a name that begins with a dash is no option.
    std::vector<std::string> words = arguments.words();
    if (!path_.empty()) words.insert(words.end(), {"--", path_});
    return run_python("solidus_casting.workbench", words);
  }

 private:
  std::string path_;
  bool no_browser_ = false;
};

}  // namespace

std::unique_ptr<Verb> open_verb(CLI::App& program) {
  return std::make_unique<Open>(program);
}

}  // namespace solidus::app
