/// A thermal phase whose freezing is followed: for the verification of criteria.
#pragma once

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "criteria/freezing.hpp"
#include "heat/thermal_phase.hpp"

namespace solidus::verification {

/// Values of the criteria at the end, by field [local node].
using Fields = std::map<std::string, std::vector<double>>;

/// Runs until `end` in equal steps, or until everything has frozen.
inline Fields freeze(const mesh::Mesh& mesh, AnalysisKind kind,
                     const std::vector<material::Material>& materials,
                     const heat::ThermalConditions& conditions, const std::vector<double>& start, double end,
                     double dt) {
  heat::ThermalPhase phase(mesh, kind, materials, conditions);
  criteria::Freezing freezing(mesh, kind, phase.storage());
  const mechanics::MechanicalState none;
  heat::ThermalState old = phase.states().initial(start), next = old;
  std::vector<double> before = phase.states().solid_fraction(old), after = before;
  criteria::CriterionRecord record = freezing.initial({0, old, none, before});
  const auto n = static_cast<int>(std::lround(end / dt));
  for (int i = 1; i <= n; ++i) {
    phase.solve(old, next, i * dt, dt);
    after = phase.states().solid_fraction(next);
    freezing.step({(i - 1) * dt, old, none, before}, {i * dt, next, none, after}, record);
    std::swap(old, next);
    before = after;
    if (phase.states().mean_solid_fraction(old) == 1.0) break;
  }
  Fields fields;
  std::vector<std::span<double>> values;
  for (const quantities::Quantity* field : freezing.fields())
    values.emplace_back(fields[std::string(field->name)] = std::vector<double>(mesh.x.size()));
  freezing.fill({end, old, none, before}, record, values);
  return fields;
}

/// Round numbers of a light metal: 2500 kg/m³, 1000 J/(kg K), 4e5 J/kg; liquidus 900 K.
inline material::Material light_metal(double conductivity, double range) {
  material::Material m;
  m.name = "metal";
  m.density = 2500;
  m.conductivity = Table(conductivity);
  m.specific_heat = Table(1000.0);
  m.phase_changes = {{"solidification", material::PhaseFraction::linear(900 - range, 900), 4e5, 0.0, true}};
  return m;
}

}  // namespace solidus::verification
