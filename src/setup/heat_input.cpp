/// Each thermal condition becomes the conditions of the phase; options are checked against each other.
#include "setup/heat_input.hpp"

#include "setup/body_input.hpp"
#include "setup/channel_input.hpp"
#include "setup/place_input.hpp"
#include "setup/source_input.hpp"

namespace solidus::setup {

namespace {

heat::Coefficient coefficient(const Function& f, cases::TimeOrigin clock, const cases::StageRun* stage,
                              AnalysisKind kind) {
  if (f.of == Argument::temperature) return {f.table, true};
  return {place_function(f, clock, stage, kind), false};
}

}  // namespace

heat::ThermalConditions thermal_conditions(const cases::CaseSpec& spec, const cases::StageRun* stage) {
  using Kind = cases::ThermalConditionSpec::Kind;
  // Each condition that holds in this stage becomes one of the solver's. Values are functions of place and
  // time on the clock that the condition names.
  heat::ThermalConditions conditions;
  conditions.absent_bodies = gone_bodies(spec, stage);
  for (const auto& c : spec.thermal_conditions) {
    if (!cases::holds(c.stages, stage)) continue;
    const AnalysisKind kind = spec.analysis.kind;
    // Functions of place and time get the clock of the condition here.
    const auto placed = [&](const Function& f) { return place_function(f, c.clock, stage, kind); };
    // Each kind has what it needs: what is held, what flows, or to what and how well heat passes.
    switch (c.kind) {
      case Kind::temperature:
        conditions.temperatures.push_back({c.name, c.group, placed(c.temperature)});
        break;
      case Kind::flux:
        conditions.fluxes.push_back({c.name, c.group, placed(c.flux), placed(c.factor)});
        break;
      case Kind::film:
        conditions.films.push_back({c.name, c.group, coefficient(c.coefficient, c.clock, stage, kind),
                                    placed(c.ambient), placed(c.factor)});
        break;
      case Kind::radiation:
        conditions.radiations.push_back({c.name, c.group, coefficient(c.emissivity, c.clock, stage, kind),
                                         placed(c.ambient), placed(c.factor),
                                         c.sees == cases::ThermalConditionSpec::Sees::enclosure});
        break;
      case Kind::source:
        conditions.sources.push_back({c.name, c.group, placed(c.power), placed(c.factor)});
        break;
      case Kind::exothermic:
        conditions.exothermics.push_back({c.name, c.group, c.heat, c.ignition, c.duration});
        break;
    }
  }
  add_channels(spec, stage, conditions);
  add_sources(spec, conditions);
  return conditions;
}

std::string against_two_stages(const cases::CaseSpec& spec) {
  using Heating = cases::CouplingSpec::StructuralHeatForm;
  if (!spec.coupled()) return {};
  const cases::CouplingSpec& c = spec.coupling;
  if (!c.scheme->traits().leaves_stepping) return "the scheme has an integration of its own";
  if (c.structural_heating != Heating::energy && c.structural_heating != Heating::none)
    return "this form of structural heat is of first order";
  return {};
}

heat::HeatOptions heat_options(const cases::CaseSpec& spec) {
  heat::HeatOptions options = spec.heat;
  options.alone = !spec.simultaneous();
  // Two stages unless something of the case speaks against them.
  if (!options.stepping)
    options.stepping = !spec.dynamics && against_two_stages(spec).empty()
                           ? heat::ThermalStepping::sdirk2
                           : heat::ThermalStepping::backward_euler;
  if (!spec.coupled()) return options;
  if (spec.coupling.as_printed)
    options.sensible =
        spec.coupling.structural_heating == cases::CouplingSpec::StructuralHeatForm::temperature
            ? heat::SensibleForm::temperature
            : heat::SensibleForm::entropy;
  return options;
}

}  // namespace solidus::setup
