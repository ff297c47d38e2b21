/// What the scheme needs to know of the case is gathered first; the scheme's own row then makes it.
#include "setup/scheme_input.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "cases/roles.hpp"
#include "coupling/guarded_scheme.hpp"
#include "material/external_law.hpp"

namespace solidus::setup {

namespace {

constexpr double k_unbounded = std::numeric_limits<double>::infinity();

/// Temperatures of a run [K].
struct Range {
  double low = k_unbounded, high = 0;
  void see(double least, double most) {
    low = std::min(low, least);
    high = std::max(high, most);
  }
  /// Those that a condition has; without a bound where a formula or a file says them.
  void see(const Function& f) {
    if (f.place != nullptr)
      see(0, k_unbounded);
    else
      see(f.table.min_value(), f.table.max_value());
  }
};

bool heats(const Function& f) {
  return f.place != nullptr || f.of == Argument::temperature || f.table.max_value() > 0;
}

/// Temperatures that bodies, surroundings and tools have in the run; without an upper bound where heat comes
/// in without one. The heat of friction is not counted.
Range temperatures(const cases::CaseSpec& spec, std::span<const InitialTemperatureRange> start) {
  using Kind = cases::ThermalConditionSpec::Kind;
  Range all;
  for (const InitialTemperatureRange& range : start) all.see(range.low, range.high);
  for (const cases::RigidSurfaceSpec& tool : spec.rigid_surfaces)
    if (tool.temperature) all.see(*tool.temperature);
  if (!spec.sources.empty()) all.see(all.low, k_unbounded);
  for (const cases::ThermalConditionSpec& c : spec.thermal_conditions) {
    if ((c.kind == Kind::flux && heats(c.flux)) || (c.kind == Kind::source && heats(c.power)) ||
        c.kind == Kind::exothermic)
      all.see(all.low, k_unbounded);
    if (c.kind == Kind::temperature) all.see(c.temperature);
    if (c.kind == Kind::film || c.kind == Kind::radiation) all.see(c.ambient);
  }
  return all;
}

}  // namespace

bool keeps_strain(const cases::CaseSpec& spec, const std::vector<material::Material>& materials,
                  std::span<const InitialTemperatureRange> start) {
  constexpr double k_same = 1;  // [K]
  const Range all = temperatures(spec, start);
  // Metal that melts or flows keeps the strain of the temperatures at which it did.
  for (std::size_t b = 0; b < materials.size(); ++b) {
    if (!materials[b].mechanical() || cases::only_conducts(spec.bodies[b])) continue;
    const material::PhaseChange* freezing = materials[b].solidification();
    if (freezing != nullptr && all.high >= freezing->fraction.solidus()) return true;
    const bool yields = materials[b].flow.has_value() || material::external_law(materials[b]) != nullptr;
    if (yields && all.high - all.low > k_same) return true;
  }
  return false;
}

coupling::SchemeContext scheme_context(const cases::CaseSpec& spec, bool keeps_strain) {
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

bool lags_a_step(const cases::CaseSpec& spec, bool keeps_strain) {
  return spec.coupled() && spec.coupling.scheme->lags_a_step(scheme_context(spec, keeps_strain));
}

bool may_map_slip_again(const cases::CaseSpec& spec, bool keeps_strain) {
  if (!spec.coupled()) return false;
  coupling::SchemeContext c = scheme_context(spec, keeps_strain);
  const coupling::SchemeKind& scheme = *spec.coupling.scheme;
  const bool mechanics_first = c.inertia || scheme.lags_a_step(c);
  c.slides_in_heat = true;
  return mechanics_first && !scheme.objection(c);
}

bool slips_after_heat(const cases::CaseSpec& spec, bool keeps_strain) {
  if (!spec.coupled()) return false;
  const coupling::SchemeTraits traits = spec.coupling.scheme->traits();
  return !traits.iterates && !traits.second_order && traits.mapping != mechanics::Mapping::simultaneous &&
         !spec.dynamics && !lags_a_step(spec, keeps_strain);
}

std::unique_ptr<coupling::CouplingScheme> coupling_scheme(const cases::CaseSpec& spec,
                                                          const coupling::Phases& phases, bool keeps_strain) {
  auto scheme = spec.coupled() ? spec.coupling.scheme->make(phases, scheme_context(spec, keeps_strain))
                               : coupling::single_phase(phases);
  return std::make_unique<coupling::GuardedScheme>(std::move(scheme), phases);
}

mechanics::StructuralForm structural_form(const cases::CaseSpec& spec) {
  using Heating = cases::CouplingSpec::StructuralHeatForm;
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

}  // namespace solidus::setup
