/// The verb `help`.
#include "app/case_arguments.hpp"
#include "app/command_line.hpp"
#include "app/verb.hpp"

namespace solidus::app {

namespace {

class Help final : public Verb {
 public:
  explicit Help(CLI::App& program) : Verb(program, "help", "Print what a verb does and its options") {
    command().add_option("VERB", verb_, "A verb; without it the list of verbs");
  }
  ExitCode run() override {
    // help() of the program itself would tell of this verb, which was asked for.
    print(verb_.empty()
              ? program().get_formatter()->make_help(&program(), "solidus", CLI::AppFormatMode::Normal)
              : verb_named(program(), verb_).help("solidus"));
    return k_done;
  }

 private:
  std::string verb_;
};

}  // namespace

std::unique_ptr<Verb> help_verb(CLI::App& program) {
  return std::make_unique<Help>(program);
}

}  // namespace solidus::app
