/// The verb `man`.
#include "app/case_arguments.hpp"
#include "app/manual_page.hpp"
#include "app/verb.hpp"

namespace solidus::app {

namespace {

class Man final : public Verb {
 public:
  explicit Man(CLI::App& program) : Verb(program, "man", "Print the manual page, for man -l -") {}
  ExitCode run() override {
    print(manual_page(command_tree(program())));
    return k_done;
  }
};

}  // namespace

std::unique_ptr<Verb> man_verb(CLI::App& program) {
  return std::make_unique<Man>(program);
}

}  // namespace solidus::app
