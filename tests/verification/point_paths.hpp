/// Materials and loadings of the tests at a material point. Lengths of time, stresses and rates in SI.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "csv.hpp"
#include "point/point_history.hpp"

namespace solidus::verification {

using point::ComponentRamp;
using point::Control;
using point::History;
using point::MaterialPoint;
using point::MaterialPointRecord;
using point::Segment;

inline constexpr double k_young = 70e9, k_poisson = 0.3, k_expansion = 2e-5;
inline constexpr double k_bulk = k_young / (3 * (1 - 2 * k_poisson));
inline constexpr double k_shear_modulus = k_young / (2 * (1 + k_poisson));

/// Solid below 800 K, liquid above 900 K, half of each at 850 K; constant properties.
inline material::Material point_material() {
  material::Material m;
  m.name = "point";
  m.density = 2700;
  m.conductivity = 200;
  m.specific_heat = 1000;
  m.specific_heat_at = material::SpecificHeatAt::constant_strain;
  m.young_modulus = k_young;
  m.poisson_ratio = k_poisson;
  m.expansion = k_expansion;
  m.liquid_viscosity = 1e9;
  m.phase_changes = {{"freezing", material::PhaseFraction::linear(800, 900), 4e5, 0.0, true}};
  return m;
}

/// The component ramps, all others held at their stress (zero).
inline Segment segment(double duration, int steps,
                       const std::vector<std::pair<int, ComponentRamp>>& components) {
  Segment s;
  s.duration = duration;
  s.steps = steps;
  for (const auto& [i, ramp] : components) s.components[static_cast<std::size_t>(i)] = ramp;
  return s;
}

inline ComponentRamp strain_to(double target) {
  return {{target, {}}, Control::strain};
}
inline ComponentRamp strain_rate(double rate) {
  return {{{}, rate}, Control::strain};
}
inline ComponentRamp strain_held() {
  return {{}, Control::strain};
}
inline ComponentRamp stress_to(double target) {
  return {{target, {}}, Control::stress};
}

inline History run_all(const material::Material& m, const MaterialPoint::Options& options,
                       std::vector<Segment> segments) {
  History h = point::run(m, {options, std::move(segments)});
  EXPECT_TRUE(h.finished) << h.reason;
  return h;
}

inline double observed_order(double coarse, double fine, double ratio = 2) {
  return std::log(coarse / fine) / std::log(ratio);
}

}  // namespace solidus::verification
