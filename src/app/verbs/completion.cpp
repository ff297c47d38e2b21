/// The verb `completion`.
#include "app/completion.hpp"

#include "app/case_arguments.hpp"
#include "app/verb.hpp"
#include "cases/case_keys.hpp"
#include "cases/case_materials.hpp"
#include "input/key_docs.hpp"
#include "material/cards/library.hpp"

namespace solidus::app {

namespace {

/// The words that completion offers besides verbs and options.
KnownWords known_words() {
  return {key_paths(cases::case_keys().info()), material::material_names(cases::material_folders())};
}

class Completion final : public Verb {
 public:
  explicit Completion(CLI::App& program)
      : Verb(program, "completion", "Print a script with which a shell completes command lines") {
    command().add_option("SHELL", shell_, "bash, zsh or fish")->required();
  }
  ExitCode run() override {
    print(completion(command_tree(program()), known_words(), shell_));
    return k_done;
  }

 private:
  std::string shell_;
};

}  // namespace

std::unique_ptr<Verb> completion_verb(CLI::App& program) {
  return std::make_unique<Completion>(program);
}

}  // namespace solidus::app
