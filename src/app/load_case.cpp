/// Loads a case with the options of the command line.
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

}  // namespace solidus::app
