/// Measures in the order in which they need each other.
#include "check/case_measures.hpp"

#include "setup/mechanics_input.hpp"

namespace solidus::model {

CaseMeasures measure(const CaseSpec& spec, const Assembly& a) {
  CaseMeasures m;
  m.bodies = measure_bodies(a.mesh, spec.analysis.kind);
  for (const auto& pair : a.contacts)
    m.contacts.push_back(measure_contact(a.mesh, *pair, spec.analysis.kind, gravity(spec.analysis)));
  for (const ThermalConditionSpec& condition : spec.thermal_conditions)
    m.surfaces.push_back(measure_surface(a.mesh, condition.group, spec.analysis.kind));
  if (spec.has_heat()) m.pours = pours(spec, a, m);
  m.effort = estimate_effort(spec, a, m);
  return m;
}

}  // namespace solidus::model
