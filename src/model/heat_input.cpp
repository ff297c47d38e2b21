#include "model/heat_input.hpp"

namespace solidus::model {

namespace {

heat::Coefficient coefficient(const Function& f) {
  return {f.table, f.of == Argument::temperature};
}

}  // namespace

heat::Conditions thermal_conditions(const CaseSpec& spec) {
  using Kind = ThermalConditionSpec::Kind;
  heat::Conditions conditions;
  for (const auto& c : spec.thermal_conditions) {
    switch (c.kind) {
      case Kind::temperature:
        conditions.temperatures.push_back({c.name, c.group, c.temperature.table});
        break;
      case Kind::flux:
        conditions.fluxes.push_back({c.name, c.group, c.flux.table});
        break;
      case Kind::film:
        conditions.films.push_back({c.name, c.group, coefficient(c.coefficient), c.ambient.table});
        break;
      case Kind::radiation:
        conditions.radiations.push_back({c.name, c.group, coefficient(c.emissivity), c.ambient.table});
        break;
      case Kind::source:
        conditions.sources.push_back({c.name, c.group, c.power.table});
        break;
    }
  }
  return conditions;
}

heat::HeatOptions heat_options(const CaseSpec& spec) {
  heat::HeatOptions options = spec.heat;
  if (!spec.coupled()) return options;
  if (spec.coupling.as_printed)
    options.sensible = spec.coupling.structural_heating == CouplingSpec::StructuralHeating::temperature
                           ? heat::SensibleForm::temperature
                           : heat::SensibleForm::entropy;
  return options;
}

}  // namespace solidus::model
