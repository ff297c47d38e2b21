/// Measures in the order in which they need each other.
#include "check/case_measures.hpp"

#include "setup/mechanics_input.hpp"

namespace solidus::check {

CaseMeasures measure(const cases::CaseSpec& spec, const setup::Assembly& a) {
  CaseMeasures m;
  m.bodies = measure_bodies(a.mesh, spec.analysis.kind);
  for (const auto& pair : a.contacts)
    m.contacts.push_back(
        setup::measure_contact(a.mesh, *pair, spec.analysis.kind, setup::gravity(spec.analysis)));
  for (const cases::ThermalConditionSpec& condition : spec.thermal_conditions)
    m.surfaces.push_back(setup::measure_surface(a.mesh, condition.group, spec.analysis.kind));
  if (spec.has_heat()) m.pours = pours(spec, a, m);
  m.effort = estimate_effort(spec, a, m);
  return m;
}

}  // namespace solidus::check
