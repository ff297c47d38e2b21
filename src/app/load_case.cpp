/// A case with what the command line says about it.
#include "app/verbs.hpp"

namespace solidus::app {

model::Case load_case(const CaseArguments& arguments) {
  model::Case c = model::load_case(arguments.path, arguments.set);
  c.spec.mesh.trust_script = arguments.trust_script;
  return c;
}

}  // namespace solidus::app
