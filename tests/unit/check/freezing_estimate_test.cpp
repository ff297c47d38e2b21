// The estimate of the time to freeze against what is known in closed form.
#include "check/freezing_estimate.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace {

using namespace solidus;
using namespace solidus::check;

constexpr double k_melting = 900, k_cold = 300;  // [K]

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

material::Material sand() {
  material::Material m;
  m.density = 1500;
  m.conductivity = Table(0.6);
  m.specific_heat = Table(1100.0);
  return m;
}

/// Chvorinov's rule itself: a mould without end takes q = √(k ρ C/(π t)) (T_m − T_0), so that
/// t = π/4 (ρ L/(T_m − T_0))² (V/A)²/(k ρ C).
TEST(FreezingEstimate, IsChvorinovsRuleInAMouldWithoutEnd) {
  const material::Material melt = metal(), mould = sand();
  FreezingProblem problem{&melt, k_melting, 0.01, 0.01, {}, {}, {}};
  problem.moulds.push_back({1, &mould, k_cold, 50, [](double, double, double) { return 1e7; }, false, {}});
  const FreezingEstimate found = estimate_freezing(problem);
  ASSERT_TRUE(found.time);
  const double heat = 2500 * (4e5 + 1000 * 1) / (k_melting - 0.5 - k_cold), square = 0.6 * 1500 * 1100;
  const double exact = std::numbers::pi / 4 * heat * heat / square * 0.01 * 0.01;
  EXPECT_NEAR(*found.time, exact, 0.1 * exact);  // twenty-four cells, steps that grow by a twentieth
  EXPECT_EQ(found.governed_by, "the mould");
  // Twice as thick: four times as long.
  problem.modulus = problem.depth = 0.02;
  EXPECT_NEAR(*estimate_freezing(problem).time, 4 * *found.time, 0.05 * 4 * *found.time);
}

/// t = ρ L (V/A)/(h (T_m − T_a)) where a film governs.
TEST(FreezingEstimate, IsTheHeatOverTheFilmWhereThatGoverns) {
  const material::Material melt = metal();
  FreezingProblem problem{&melt, k_melting, 0.01, 0.01, {}, {}, {}};
  problem.open.push_back({[](double t, double) { return -100 * (t - k_cold); }});
  const FreezingEstimate found = estimate_freezing(problem);
  ASSERT_TRUE(found.time);
  const double exact = 2500 * (4e5 + 1000 * 1) * 0.01 / (100 * (k_melting - 0.5 - k_cold));
  EXPECT_NEAR(*found.time, exact, 0.02 * exact);
}

/// A fifth of its volume of sand is as hot as the metal before that is solid.
TEST(FreezingEstimate, AMouldThatIsTooSmallDoesNotFreezeTheMetal) {
  const material::Material melt = metal(), mould = sand();
  FreezingProblem problem{&melt, k_melting, 0.01, 0.01, {}, {}, {}};
  problem.moulds.push_back(
      {1, &mould, k_cold, 0.2, [](double, double, double) { return 1000.0; }, false, {}});
  const FreezingEstimate found = estimate_freezing(problem);
  EXPECT_FALSE(found.time);
  EXPECT_GT(found.rest, k_melting - 1);
}

/// Metal without resistance has one temperature, also where it is two bodies: t = ρ L V/(h A (T_m − T_a))
/// with the volume and the skin of both.
TEST(FreezingEstimate, IsThatOfBothWhereABodyIsPouredWithAnother) {
  const material::Material melt = metal();
  constexpr double k_thick = 0.02, k_thin = 0.005, k_film = 100;  // V/A [m], h [W/(m² K)]
  FreezingProblem problem{&melt, k_melting, k_thick, k_thick, {}, {}, {}};
  problem.open.push_back({[](double t, double) { return -k_film * (t - k_cold); }});
  const double alone = *estimate_freezing(problem).time;
  // As large as the body, on a tenth of its skin.
  problem.neighbours.push_back(
      {&melt, k_melting, 0.1, 1, [](double t, double) { return -k_film / k_thin * (t - k_cold); }});
  const FreezingEstimate found = estimate_freezing(problem);
  ASSERT_TRUE(found.time);
  const double together = 2 / (1 / k_thick + 1 / k_thin);  // (V + V)/(V/0.02 m + V/0.005 m)
  const double exact = 2500 * (4e5 + 1000 * 1) * together / (k_film * (k_melting - 0.5 - k_cold));
  EXPECT_NEAR(*found.time, exact, 0.03 * exact);
  EXPECT_NEAR(alone, exact * k_thick / together, 0.03 * alone);
  ASSERT_EQ(found.neighbours.size(), 1u);
  EXPECT_NEAR(found.neighbours[0], exact, 0.03 * exact);
}

}  // namespace
