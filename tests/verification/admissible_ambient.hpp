/// Whether the conditions of a body are those under which the stability functional 𝓛 of 2.24 cannot grow.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "contact/points/parameters.hpp"
#include "heat/loads/thermal_conditions.hpp"
#include "mechanics/loads/mechanical_conditions.hpp"

namespace solidus::verification {

/// The ambient temperature Θ_a [K] where all conditions of a quasi-static run are admissible (2.26,
/// coupling_stability.md, 2): dead loads, supports at rest, no flux and no source, one constant temperature
/// of all surroundings. Insulated: the lowest temperature of the start. Tables are looked at in a thousand
/// times.
inline std::optional<double> admissible_ambient(const heat::ThermalConditions& thermal,
                                                const mechanics::MechanicalConditions& mechanical,
                                                const std::optional<contact::ContactParameters>& contact,
                                                const std::vector<double>& start, double end) {
  constexpr int k_times = 1000;
  const auto stays = [&](const PlaceFunction& f, double value) {
    if (!f.uniform()) return false;
    for (int i = 0; i <= k_times; ++i)
      if (f.value(end * i / k_times) != value) return false;
    return true;
  };
  const auto all = [](const auto& list, const auto& holds) {
    return std::all_of(list.begin(), list.end(), holds);
  };
  const auto steady = [&](const PlaceFunction& f) { return f.uniform() && stays(f, f.value(0)); };

  std::vector<PlaceFunction> surroundings;
  for (const auto& c : thermal.temperatures) surroundings.push_back(c.value);
  for (const auto& c : thermal.films) surroundings.push_back(c.ambient);
  for (const auto& c : thermal.radiations) surroundings.push_back(c.ambient);
  const double ambient =
      surroundings.empty() ? *std::min_element(start.begin(), start.end()) : surroundings.front().value(0);

  const bool holds =
      all(surroundings, [&](const PlaceFunction& f) { return stays(f, ambient); }) &&
      all(thermal.fluxes, [&](const heat::Flux& c) { return stays(c.value, 0); }) &&
      all(thermal.sources, [&](const heat::Source& c) { return stays(c.power, 0); }) &&
      all(mechanical.displacements, [&](const auto& c) { return stays(c.value, 0); }) &&
      all(mechanical.pressures, [&](const mechanics::Pressure& c) { return steady(c.value); }) &&
      all(mechanical.tractions, [&](const mechanics::Traction& c) { return all(c.value, steady); }) &&
      !(contact && contact->rigid_master);
  return holds ? std::optional(ambient) : std::nullopt;
}

}  // namespace solidus::verification
