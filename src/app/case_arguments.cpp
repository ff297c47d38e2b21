/// Options that several verbs share are declared once, with what they do to the case.
#include "app/case_arguments.hpp"

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <optional>

#include "material/external_law.hpp"
#include "system/errors.hpp"
#include "system/input_file.hpp"
#include "system/processes.hpp"

namespace solidus::app {

void add_case(CLI::App& verb, CaseArguments& arguments) {
  verb.add_option("CASE", arguments.path,
                  "A case file, or a folder with a case.toml; CASE:VARIANT for one of its variants")
      ->required();
  verb.add_option("--set", arguments.set, "Change a key, for example --set time.step=\"0.5 s\"")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

void add_physics(CLI::App& verb, CaseArguments& arguments) {
  CLI::Option* heat_only = verb.add_flag("--heat-only", arguments.heat_only,
                                         "Compute heat alone; what does not apply is left out and named");
  verb.add_flag("--coupled", arguments.coupled, "Compute heat and mechanics")->excludes(heat_only);
}

void add_trust(CLI::App& verb, bool& trust) {
  verb.add_flag("--trust-geo", trust,
                "Run .geo scripts whatever they say: they can start programs and write files as you can");
}

void add_trust_laws(CLI::App& verb) {
  verb.add_flag_callback(
      "--trust-laws", [] { material::trust_external_laws(); },
      "Load laws of materials from shared objects: their code runs as a program of their author");
}

setup::Case load_case(const CaseArguments& arguments) {
  std::optional<cases::Physics> physics;
  if (arguments.heat_only) physics = cases::Physics::heat;
  if (arguments.coupled) physics = cases::Physics::thermomechanical;
  setup::Case c = setup::load_case(arguments.path, arguments.set, physics);
  c.spec.mesh.trust_script = arguments.trust_script;
  return c;
}

void print(const std::string& given) {
  const std::string text = printable(given);
  if (processes::rank() != 0) return;
  const bool whole = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (!whole || std::fflush(stdout) != 0) {
    if (errno == EPIPE) return;  // no process reads on, as with `| head`
    throw InputError({"standard output", 0, 0}, std::strerror(errno));
  }
}

}  // namespace solidus::app
