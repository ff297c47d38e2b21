// Plates in the mould of a casting: Chvorinov's closed forms turned round.
#include "check/plate_estimate.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace {

using namespace solidus;
using namespace solidus::check;

constexpr double k_melting = 900, k_cold = 300;  // [K]
constexpr double k_heat = 2500 * (4e5 + 1000 * 1);

/// Freezes within a kelvin and conducts so well that it has one temperature.
material::Material metal() {
  material::Material m;
  m.density = 2500;
  m.conductivity = Table(1e5);
  m.specific_heat = Table(1000.0);
  m.phase_changes.push_back(
      {"solidification", material::PhaseFraction::linear(k_melting - 1, k_melting), 4e5, 0, true});
  return m;
}

// t = π/4 (ρ L/(T_m − T_0))² (D/2)²/(k ρ C) of the mould, whatever shape the casting itself has.
TEST(PlateEstimate, IsChvorinovsRuleInSand) {
  const material::Material melt = metal();
  material::Material sand;
  sand.density = 1500;
  sand.conductivity = Table(0.6);
  sand.specific_heat = Table(1100.0);
  FreezingProblem casting{&melt, k_melting, 0.01, 0.02, {}, {}, {}};
  casting.moulds.push_back({1, &sand, k_cold, 400, [](double, double, double) { return 1e7; }, false, {}});
  const criteria::PlateTimes plates = plate_times(casting);
  ASSERT_EQ(plates.time.size(), 7U);
  EXPECT_NEAR(plates.thickness.front(), 2 * 0.01 / 8, 1e-12);
  EXPECT_NEAR(plates.thickness.back(), 2 * 0.01 * 8, 1e-12);
  for (const double thickness : {0.01, 0.03}) {
    const double part = k_heat / (k_melting - 0.5 - k_cold) * thickness / 2;
    const double time = std::numbers::pi / 4 * part * part / (0.6 * 1500 * 1100);
    EXPECT_NEAR(plates.thickness_of(time), thickness, 0.05 * thickness);  // cells and steps of the estimate
  }
}

// t = ρ L (D/2)/(h (T_m − T_a)) under a film.
TEST(PlateEstimate, IsTheHeatOverTheFilm) {
  const material::Material melt = metal();
  FreezingProblem casting{&melt, k_melting, 0.01, 0.01, {}, {}, {}};
  casting.open.push_back({[](double t, double) { return -100 * (t - k_cold); }});
  const criteria::PlateTimes plates = plate_times(casting);
  const double time = k_heat * 0.008 / (100 * (k_melting - 0.5 - k_cold));
  EXPECT_NEAR(plates.thickness_of(time), 0.016, 0.02 * 0.016);
}

}  // namespace
