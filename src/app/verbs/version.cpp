/// The verb `version`.
#include "system/version.hpp"

#include <fmt/format.h>

#include "app/case_arguments.hpp"
#include "app/verb.hpp"
#include "parallel/petsc_options.hpp"

namespace solidus::app {

namespace {

class Version final : public Verb {
 public:
  explicit Version(CLI::App& program) : Verb(program, "version", "Print versions") {}
  ExitCode run() override {
    print(
        fmt::format("Solidus {}\n{}\nGmsh {}\n", program_version(), petsc::version(), SOLIDUS_GMSH_VERSION));
    return k_done;
  }
};

}  // namespace

std::unique_ptr<Verb> version_verb(CLI::App& program) {
  return std::make_unique<Version>(program);
}

}  // namespace solidus::app
