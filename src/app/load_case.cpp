/// Loads a case with the options of the command line; the verb `resolve`, which prints it.
#include "app/verbs.hpp"

namespace solidus::app {

model::Case load_case(const CaseArguments& arguments) {
  std::optional<model::Physics> physics;
  if (arguments.heat_only) physics = model::Physics::heat;
  if (arguments.coupled) physics = model::Physics::thermomechanical;
  model::Case c = model::load_case(arguments.path, arguments.set, physics);
  c.spec.mesh.trust_script = arguments.trust_script;
  return c;
}

ExitCode resolve(const CaseArguments& arguments) {
  print(load_case(arguments).toml());
  return k_done;
}

}  // namespace solidus::app
