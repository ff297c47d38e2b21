/// Criteria of hot tearing against values that anyone can compute again: Al-4.5Cu by Scheil's equation, T_m =
/// 660.4 °C, slope 3.4 K/%, k = 0.17, eutectic at 548.2 °C.
#include "criteria/hot_tearing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "criteria/mush_strain.hpp"

namespace solidus::criteria {
namespace {

constexpr double k_melting = 660.4, k_liquidus = 660.4 - 3.4 * 4.5, k_eutectic = 548.2, k_partition = 0.17;

/// The curve in straight pieces, with the eutectic as a jump at its low end.
std::vector<std::pair<double, double>> scheil(int pieces) {
  std::vector<std::pair<double, double>> curve = {{k_eutectic, 1.0}};
  for (int i = 0; i <= pieces; ++i) {
    const double t = std::lerp(k_eutectic, k_liquidus, static_cast<double>(i) / pieces);
    curve.emplace_back(t, 1 - std::pow((k_melting - t) / (k_melting - k_liquidus), 1 / (k_partition - 1)));
  }
  return curve;
}

constexpr double k_shrinkage = 0.06, k_viscosity = 1e-3, k_drop = 2000;  // as of the authors

TEST(HotTearing, RappazDrezetGremaudOfAlCu) {
  const TearingLaw law(scheil(4000), k_shrinkage, k_viscosity, k_drop);
  EXPECT_NEAR(law.a(), 2986.46, 0.02);
  EXPECT_NEAR(law.b(), 415039.7, 2);
  constexpr double k_gradient = 1e4, k_spacing = 100e-6;
  const TearingLaw::Place fast{k_gradient, 1e-3 * k_gradient, k_spacing},
      slow{k_gradient, 1e-4 * k_gradient, k_spacing};
  EXPECT_NEAR(law.drop_of_shrinkage(fast), 322.54, 0.01);
  EXPECT_NEAR(law.critical_strain_rate(fast), 0.021183, 1e-6);
  EXPECT_NEAR(law.drop_of_shrinkage(slow), 32.25, 0.01);
  EXPECT_NEAR(law.critical_strain_rate(slow), 0.024849, 1e-6);
  EXPECT_NEAR(law.tendency(fast, law.critical_strain_rate(fast)), 1, 1e-12);
  EXPECT_NEAR(law.tendency(slow, 0), 32.25 / k_drop, 1e-5);
}

TEST(HotTearing, ShrinkageAloneTearsWhereItTakesAllOfThePressure) {
  const TearingLaw law(scheil(400), k_shrinkage, k_viscosity, k_drop);
  const TearingLaw::Place fine{1e3, 10, 20e-6};
  EXPECT_EQ(law.critical_strain_rate(fine), 0);
  EXPECT_GT(law.tendency(fine, 0), 1);
}

// 1/G² has no limit where fronts meet. With a mush as long as the casting, here 0.1 m, Δp is
// 180 μ/(λ₂² G) [v β A + (1 + β) ε̇ B/G] with G = 96.9 K/0.1 m.
TEST(HotTearing, TheMushIsNoLongerThanTheCastingWhereTheGradientVanishes) {
  constexpr double k_longest = 0.1, k_spacing = 300e-6, k_rate = 0.1, k_strain_rate = 1e-5;
  const TearingLaw law(scheil(4000), k_shrinkage, k_viscosity, k_drop, k_longest);
  constexpr double k_least = (k_liquidus - k_eutectic) / k_longest;
  const double resistance = 180 * k_viscosity / (k_spacing * k_spacing * k_least);
  const double shrinkage = resistance * k_rate / k_least * k_shrinkage * 2986.46,
               strain = resistance * (1 + k_shrinkage) * k_strain_rate * 415039.7 / k_least;
  for (const double gradient : {1e-9, 1.0, 0.999 * k_least}) {
    const TearingLaw::Place place{gradient, k_rate, k_spacing};
    EXPECT_NEAR(law.drop_of_shrinkage(place), shrinkage, 1e-4 * shrinkage) << gradient;
    EXPECT_NEAR(law.drop(place, k_strain_rate), shrinkage + strain, 1e-4 * strain) << gradient;
    EXPECT_NEAR(law.tendency(place, law.critical_strain_rate(place)), 1, 1e-12) << gradient;
  }
  // A steeper gradient is taken as it is.
  const TearingLaw::Place steep{1e4, 10, k_spacing};
  const TearingLaw endless(scheil(4000), k_shrinkage, k_viscosity, k_drop);
  EXPECT_EQ(law.drop(steep, k_strain_rate), endless.drop(steep, k_strain_rate));
}

// From the critical drop on a pore opens: the law does not say how far beyond it the pressure would fall.
TEST(HotTearing, IsToldUpToAHundredTimesTheThreshold) {
  const TearingLaw law(scheil(400), k_shrinkage, k_viscosity, k_drop);
  EXPECT_GT(law.drop({1, 10, 20e-6}, 0), 1000 * k_drop);
  EXPECT_EQ(law.tendency({1, 10, 20e-6}, 0), 100);
}

TEST(HotTearing, TheRootIsWhereGrainsBridge) {
  // f from 1 to 0 over 100 K: above the root at f = 0.98 A is 100 ∫ f²/(1 − f)² df = 100 (f + 2 ln(1 − f) +
  // 1/(1 − f) − 1).
  std::vector<std::pair<double, double>> line;
  for (int i = 0; i <= 1000; ++i) line.emplace_back(0.1 * i, 1 - 1e-3 * i);
  EXPECT_NEAR(TearingLaw(line, k_shrinkage, k_viscosity, k_drop).a(),
              100 * (0.98 + 2 * std::log(0.02) + 50 - 1), 0.01);
}

TEST(HotTearing, KouOfAlCu) {
  EXPECT_NEAR(kou_index(scheil(4000)), 1390.96, 0.1);
  constexpr double k_near = 1e-4;
  EXPECT_NEAR(kou_index(scheil(40000), 0.87 - k_near, 0.87 + k_near), 990.93, 0.5);
  EXPECT_NEAR(kou_index(scheil(40000), 0.90 - k_near, 0.90 + k_near), 1629.0, 1);
  // Nothing is steep where all freezes at one temperature.
  EXPECT_EQ(kou_index({{900, 1}, {900, 0}}), 0);
}

// Scheil's curve ends at the eutectic, where grains bridge at once.
TEST(HotTearing, TheRootOfAnAlloyWithEutecticIsWhereThatBegins) {
  EXPECT_NEAR(root_of(scheil(4000)),
              1 - std::pow((k_melting - k_eutectic) / (k_melting - k_liquidus), 1 / (k_partition - 1)), 1e-9);
}

TEST(HotTearing, CriticalStrainOfWonYeoSeolOh) {
  material::Casting steel;
  steel.crack_strain = 0.02821;
  const struct {
    double width, rate, strain;
  } rows[] = {{10, 1e-4, 0.069024}, {10, 1e-3, 0.033566}, {10, 1e-2, 0.016323},
              {30, 1e-4, 0.026722}, {30, 1e-3, 0.012995}, {30, 1e-2, 0.006319}};
  for (const auto& row : rows)
    EXPECT_NEAR(critical_crack_strain(steel, row.rate, row.width), row.strain, 1e-6) << row.width;
}

}  // namespace
}  // namespace solidus::criteria
