#include "build/scheme_input.hpp"

#include <algorithm>
#include <stdexcept>

#include "coupling/guarded_scheme.hpp"

namespace solidus::model {

coupling::SchemeContext scheme_context(const CaseSpec& spec, bool keeps_strain) {
  coupling::SchemeContext c;
  if (spec.exchanges_heat()) c.heating = structural_form(spec);
  c.as_printed = spec.coupling.as_printed;
  c.inertia = spec.dynamics.has_value();
  c.rubs =
      std::any_of(spec.contacts.begin(), spec.contacts.end(), [](const auto& pair) { return pair.friction; });
  c.slides_in_heat = std::any_of(spec.contacts.begin(), spec.contacts.end(), [](const auto& pair) {
    return pair.friction && pair.friction->thermal_return_mapping;
  });
  c.keeps_strain = keeps_strain;
  c.integration = spec.mechanics.integration;
  return c;
}

bool lags_a_step(const CaseSpec& spec, bool keeps_strain) {
  return spec.coupled() && spec.coupling.scheme->lags_a_step(scheme_context(spec, keeps_strain));
}

bool may_map_slip_again(const CaseSpec& spec, bool keeps_strain) {
  if (!spec.coupled()) return false;
  coupling::SchemeContext c = scheme_context(spec, keeps_strain);
  const coupling::SchemeKind& scheme = *spec.coupling.scheme;
  const bool mechanics_first = c.inertia || scheme.lags_a_step(c);
  c.slides_in_heat = true;
  return mechanics_first && !scheme.objection(c);
}

bool slips_after_heat(const CaseSpec& spec, bool keeps_strain) {
  if (!spec.coupled()) return false;
  const coupling::SchemeTraits traits = spec.coupling.scheme->traits();
  return !traits.iterates && !traits.second_order && traits.mapping != mechanics::Mapping::simultaneous &&
         !spec.dynamics && !lags_a_step(spec, keeps_strain);
}

std::unique_ptr<coupling::CouplingScheme> coupling_scheme(const CaseSpec& spec,
                                                          const coupling::Phases& phases) {
  auto scheme = spec.coupled()
                    ? spec.coupling.scheme->make(phases, scheme_context(spec, phases.keeps_strain()))
                    : coupling::single_phase(phases);
  return std::make_unique<coupling::GuardedScheme>(std::move(scheme), phases);
}

mechanics::StructuralForm structural_form(const CaseSpec& spec) {
  using Heating = CouplingSpec::StructuralHeatForm;
  switch (spec.coupling.structural_heating) {
    case Heating::energy:
      return mechanics::StructuralForm::energy;
    case Heating::entropy:
      return mechanics::StructuralForm::entropy;
    case Heating::literal:
      return mechanics::StructuralForm::literal;
    case Heating::temperature:
      return mechanics::StructuralForm::temperature;
    case Heating::none:
      break;
  }
  throw std::logic_error("deformation exchanges no heat in this case");
}

}  // namespace solidus::model
