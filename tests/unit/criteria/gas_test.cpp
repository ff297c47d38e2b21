/// Gas that comes out of solution: solubilities of the papers, pores against closed balances by Sieverts.
#include <gtest/gtest.h>

#include <cmath>

#include "criteria/gas_law.hpp"

namespace solidus::criteria {
namespace {

constexpr double k_per_hundred_grams = 1e-5;  // [m³/kg] in a cm³ per 100 g
constexpr double k_tension = 0.87;            // [N/m]
constexpr double k_solidus = 850, k_liquidus = 887, k_density = 2685;

/// Hydrogen in aluminium after Ransley and Neufeld.
material::Gas hydrogen() {
  return {.name = "hydrogen",
          .melt = {2.796, 2760},
          .solid = {0.788, 2080},
          .content = 0.15 * k_per_hundred_grams,
          .surface_tension = k_tension,
          .source = {}};
}

material::Material metal() {
  material::Material m;
  m.name = "metal";
  m.density = k_density;
  m.gas = hydrogen();
  m.phase_changes.push_back({.name = "freezing",
                             .fraction = material::PhaseFraction::linear(k_solidus, k_liquidus),
                             .solidification = true});
  m.casting.arm_spacing = 10e-6;
  return m;
}

TEST(Gas, SolubilitiesOfRansleyAndNeufeld) {
  const material::Gas gas = hydrogen();
  EXPECT_NEAR(gas.solubility(933.5, 0) / k_per_hundred_grams, 0.69085, 1e-5);
  EXPECT_NEAR(gas.solubility(933.5, 1) / k_per_hundred_grams, 0.03629, 1e-5);
  EXPECT_NEAR(gas.solubility(1000, 0) / k_per_hundred_grams, 1.0864, 1e-4);
  EXPECT_NEAR(gas.pressure(gas.solubility(900, 0.4), 900, 0.4), material::k_standard_pressure, 1e-6);
}

// What the solid and the surface tension leave of 0.3 cm³ per 100 g, as an ideal gas.
TEST(Gas, PoresOfASampleAreThoseOfAClosedBalance) {
  for (const double bar : {0.08, 1.0, 10.0}) {
    const GasOptions options{.content = 0.3 * k_per_hundred_grams, .ambient_pressure = bar * 1e5};
    const GasLaw law = *GasLaw::of(metal(), options);
    constexpr double k_time = 100;
    const double radius = 10e-6 * std::cbrt(k_time) / 2, p = bar * 1e5 + 2 * k_tension / radius;
    const double dissolved = std::pow(10, 0.788 - 2080 / k_solidus) * std::sqrt(p / 101325);  // cm³/100 g
    const double gas = (0.3 - dissolved) * (101325 / p) * (k_solidus / 273.15);               // cm³ in 100 g
    const double metal = 100 / (k_density * 1e-3);                                            // cm³ of 100 g
    ASSERT_GT(gas, 0);
    EXPECT_NEAR(law.pores({k_solidus, 1, k_time}, 0) / (gas / (gas + metal)), 1, 1e-9) << bar;
  }
}

TEST(Gas, StaysInSolutionUntilItsPressureOvercomesMeltAndSurfaceTension) {
  const material::Gas gas = hydrogen();
  const GasLaw law = *GasLaw::of(metal(), {});
  constexpr double k_time = 10;
  const double outside = material::k_standard_pressure + 4 * k_tension / (10e-6 * std::cbrt(k_time));
  bool before = false, after = false;
  for (double solid = 0; solid <= 1; solid += 0.01) {
    const bool overcomes = gas.pressure(gas.content, 860, solid) > outside;
    EXPECT_EQ(law.pores({860, solid, k_time}, 0) > 0, overcomes) << solid;
    (overcomes ? after : before) = true;
  }
  EXPECT_TRUE(before && after);
  EXPECT_FALSE(GasLaw::of(metal(), {.content = 0}).has_value());
  EXPECT_FALSE(GasLaw::of(metal(), {.follow = false}).has_value());
}

TEST(Gas, GrowsAsThePressureOfTheMeltFalls) {
  const GasLaw law = *GasLaw::of(metal(), {});
  constexpr double k_step = 10;  // [Pa]
  for (const double pressure : {2e4, 0.0, -5e4, -9e4}) {
    const GasLaw::Place place{860, 0.95, 30};
    const double slope =
        (law.pores(place, pressure + k_step) - law.pores(place, pressure - k_step)) / (2 * k_step);
    EXPECT_LT(slope, 0);
    EXPECT_NEAR(law.slope(place, pressure) / slope, 1, 1e-5);
  }
  for (const double pressure : {2e4, 0.0, -5e4})
    EXPECT_NEAR(law.pressure_at({860, 0.95, 30}, law.pores({860, 0.95, 30}, pressure)), pressure, 1e-6);
  // The melt cannot pull more than the surroundings press.
  EXPECT_EQ(law.slope({860, 0.95, 30}, -2e5), 0);
  EXPECT_EQ(law.pores({860, 0.95, 30}, -2e5), law.pores({860, 0.95, 30}, -101325));
}

}  // namespace
}  // namespace solidus::criteria
