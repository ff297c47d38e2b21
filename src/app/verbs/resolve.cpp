/// The verb `resolve`.
#include "app/case_arguments.hpp"
#include "app/verb.hpp"

namespace solidus::app {

namespace {

/// Prints a case as one file: includes, overrides and defaults in place, paths absolute. Reads no mesh.
class Resolve final : public Verb {
 public:
  explicit Resolve(CLI::App& program)
      : Verb(program, "resolve", "Print a case as one file: includes, --set and defaults in place") {
    add_case(command(), arguments_);
    add_physics(command(), arguments_);
  }
  ExitCode run() override {
    print(load_case(arguments_).toml());
    return k_done;
  }

 private:
  CaseArguments arguments_;
};

}  // namespace

std::unique_ptr<Verb> resolve_verb(CLI::App& program) {
  return std::make_unique<Resolve>(program);
}

}  // namespace solidus::app
