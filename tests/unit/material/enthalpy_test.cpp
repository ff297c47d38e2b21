#include "material/enthalpy.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

namespace solidus::material {
namespace {

constexpr double k_density = 2650;
const Table k_capacity({600, 900, 932.5, 1000}, {1400, 1450, 1500, 1300});

PhaseChange change(const std::string& name, PhaseFraction fraction, double latent_heat) {
  return {name, std::move(fraction), latent_heat, 0.0, name == "solidification"};
}

/// A freezing range, an isothermal change, a Scheil curve with eutectic and a change at the very end of the
/// table of C.
std::vector<PhaseChange> many_changes() {
  return {change("solidification", PhaseFraction::scheil(933.5, 888, 850, 0.13), 3.9e5),
          change("range", PhaseFraction::linear(931, 932), 2e5),
          change("isothermal", PhaseFraction::linear(910, 910), 1e5),
          change("lowest", PhaseFraction::linear(600, 600), 3e4),
          change("highest", PhaseFraction::linear(1000, 1000), 4e4)};
}

/// h by its definition, from the table's integral and the fractions.
double definition(double temperature, double lowest, const std::vector<PhaseChange>& changes, bool above) {
  double h = k_density * k_capacity.integral(lowest, temperature);
  for (const PhaseChange& c : changes)
    h += k_density * c.latent_heat *
         (1 - (above ? c.fraction.above(temperature) : c.fraction.below(temperature)));
  return h;
}

TEST(EnthalpyCurve, IsSensiblePlusLatentHeatEverywhere) {
  const auto changes = many_changes();
  const EnthalpyCurve curve(k_density, k_capacity, changes);
  const double lowest = curve.pieces().front().t0;
  for (double t = 400; t < 1300; t += 0.37) {
    ASSERT_NEAR(curve.upper(t), definition(t, lowest, changes, true), 1e-13 * curve.upper(1300));
    ASSERT_NEAR(curve.lower(t), definition(t, lowest, changes, false), 1e-13 * curve.upper(1300));
  }
  for (const double t : {600.0, 850.0, 888.0, 910.0, 932.0, 1000.0}) {
    EXPECT_NEAR(curve.upper(t), definition(t, lowest, changes, true), 1e-13 * curve.upper(1300)) << t;
    EXPECT_NEAR(curve.lower(t), definition(t, lowest, changes, false), 1e-13 * curve.upper(1300)) << t;
  }
}

TEST(EnthalpyCurve, HoldsTheWholeLatentHeatWhateverTheFractions) {
  const auto changes = many_changes();
  double latent = 0;
  for (const PhaseChange& c : changes) latent += k_density * c.latent_heat;
  const EnthalpyCurve with(k_density, k_capacity, changes), without(k_density, k_capacity, {});
  const double difference = with.upper(1100) - with.lower(500) - (without.upper(1100) - without.lower(500));
  EXPECT_NEAR(difference / latent, 1, 1e-14);
}

// ds = dh/Θ with h itself: Simpson's rule on pieces of 0.1 K, whose error is 1e-9 even where the curve is
// steepest.
TEST(EnthalpyCurve, EntropyIsTheIntegralOfHeatOverTemperature) {
  const EnthalpyCurve curve(k_density, k_capacity, many_changes());
  double integral = 0;
  const double start = curve.upper_entropy(420);
  for (int i = 0; i < 8000; ++i) {
    const double a = 420 + 0.1 * i, b = 420 + 0.1 * (i + 1), m = 0.5 * (a + b);
    // by parts: ∫dh/Θ = [h/Θ] + ∫h/Θ² dΘ, which knows nothing of capacities
    const auto f = [&](double t, double h) { return h / (t * t); };
    integral += curve.lower(b) / b - curve.upper(a) / a +
                (b - a) / 6 * (f(a, curve.upper(a)) + 4 * f(m, curve.upper(m)) + f(b, curve.lower(b)));
    integral += (curve.upper(b) - curve.lower(b)) / b;  // a jump
    ASSERT_NEAR(curve.upper_entropy(b) - start, integral, 1e-6 * std::abs(integral)) << b;
  }
}

TEST(EnthalpyCurve, EntropyJumpsByHeatOverTemperature) {
  const EnthalpyCurve curve(k_density, k_capacity, many_changes());
  for (const auto& jump : curve.jumps())
    EXPECT_NEAR(curve.upper_entropy(jump.temperature) - curve.lower_entropy(jump.temperature),
                jump.height / jump.temperature, 1e-9 * jump.height);
  EXPECT_EQ(curve.upper_entropy(777), curve.lower_entropy(777));
}

TEST(EnthalpyCurve, EntropyOfAConstantCapacityIsALogarithm) {
  const EnthalpyCurve curve(k_density, 900.0, {});
  EXPECT_NEAR(curve.upper_entropy(600) - curve.upper_entropy(300), k_density * 900 * std::log(2.0), 1e-6);
}

TEST(EnthalpyCurve, InverseReturnsTheTemperatureItCameFrom) {
  const EnthalpyCurve curve(k_density, k_capacity, many_changes());
  for (double t = 400; t < 1300; t += 0.173) {
    ASSERT_NEAR(curve.temperature(curve.upper(t)), t, 1e-11) << t;  // 1e-14 of the temperature
    ASSERT_NEAR(curve.temperature(curve.lower(t)), t, 1e-11) << t;
  }
}

TEST(EnthalpyCurve, ValueReturnsTheEnthalpyItCameFromOutsideJumps) {
  const EnthalpyCurve curve(k_density, k_capacity, many_changes());
  const double low = curve.lower(400), high = curve.upper(1300);
  for (int i = 0; i <= 20000; ++i) {
    const double h = low + (high - low) * i / 20000.0, t = curve.temperature(h);
    const double slack = 1e-13 * high;
    ASSERT_GE(h, curve.lower(t) - slack);
    ASSERT_LE(h, curve.upper(t) + slack);
    if (curve.inverse_slope(h) > 0) {
      ASSERT_NEAR(curve.upper(t), h, slack);
    }
  }
}

TEST(EnthalpyCurve, InverseIsMonotoneAndContinuous) {
  const EnthalpyCurve curve(k_density, k_capacity, many_changes());
  const double low = curve.lower(400), high = curve.upper(1300), dh = (high - low) / 50000;
  double previous = curve.temperature(low);
  for (int i = 1; i <= 50000; ++i) {
    const double t = curve.temperature(low + dh * i);
    ASSERT_GE(t, previous - 1e-12);
    ASSERT_LE(t - previous, dh / (k_density * 1300) * (1 + 1e-9));  // the least capacity bounds the slope
    previous = t;
  }
}

TEST(EnthalpyCurve, JumpsLieWhereChangesAreIsothermalAndHaveTheirHeat) {
  const auto changes = many_changes();
  const EnthalpyCurve curve(k_density, k_capacity, changes);
  const double eutectic = changes[0].fraction.below(850) - changes[0].fraction.above(850);
  const std::vector<EnthalpyCurve::Jump> expected{{600, k_density * 3e4},
                                                  {850, k_density * 3.9e5 * eutectic},
                                                  {910, k_density * 1e5},
                                                  {1000, k_density * 4e4}};
  ASSERT_EQ(curve.jumps().size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const auto& jump = curve.jumps()[i];
    EXPECT_EQ(jump.temperature, expected[i].temperature);
    EXPECT_NEAR(jump.height / expected[i].height, 1, 1e-14);
    EXPECT_NEAR((curve.upper(jump.temperature) - curve.lower(jump.temperature)) / jump.height, 1, 1e-12);
    const double inside = curve.lower(jump.temperature) + 0.3 * jump.height;
    EXPECT_EQ(curve.temperature(inside), jump.temperature);
    EXPECT_EQ(curve.inverse_slope(inside), 0);
  }
}

TEST(EnthalpyCurve, CapacityIsTheDerivativeAndItsReciprocalThatOfTheInverse) {
  const EnthalpyCurve curve(k_density, k_capacity, many_changes());
  for (const double t : {450.0, 700.3, 860.7, 905.0, 920.0, 931.5, 950.0, 1200.0}) {
    const double h = 1e-5;
    EXPECT_NEAR((curve.upper(t + h) - curve.upper(t - h)) / (2 * h) / curve.capacity(t), 1, 2e-6) << t;
    EXPECT_NEAR(curve.inverse_slope(curve.upper(t)) * curve.capacity(t), 1, 1e-10) << t;
  }
  EXPECT_NEAR(curve.capacity(931.5), k_density * (k_capacity.value(931.5) + 2e5), 1e-3);
}

TEST(EnthalpyCurve, ContinuesWithTheEndCapacities) {
  const EnthalpyCurve curve(k_density, k_capacity, {});
  EXPECT_DOUBLE_EQ(curve.capacity(100), k_density * 1400);
  EXPECT_DOUBLE_EQ(curve.capacity(3000), k_density * 1300);
  EXPECT_DOUBLE_EQ(curve.upper(3000) - curve.upper(2000), k_density * 1300 * 1000);
}

TEST(EnthalpyCurve, FollowsALinearContinuationForOneWidthWithoutLosingItsPositiveCapacity) {
  const Table linear({273, 673}, {340, 390}, Extrapolation::linear),
      steep({273, 673}, {100, 1000}, Extrapolation::linear);
  const EnthalpyCurve curve(7800, linear, {}), guarded(7800, steep, {});
  for (const double t : {200.0, 300.0, 800.0, 1070.0})
    EXPECT_NEAR(curve.capacity(t) / 7800, linear.value(t), 1e-9) << t;
  for (double t = 1; t < 3000; t += 1) ASSERT_GE(guarded.capacity(t), 7800 * 50 * (1 - 1e-12)) << t;
}

TEST(EnthalpyCurve, WithConstantCapacityAndOneIsothermalChangeIsThreeLines) {
  const PhaseChange freezing = change("solidification", PhaseFraction::linear(933, 933), 3.95e5);
  const EnthalpyCurve curve(1000, Table(500.0), std::span(&freezing, 1));
  EXPECT_NEAR(curve.upper(1000) - curve.lower(900), 1000 * (500.0 * 100 + 3.95e5), 1e-6);
  EXPECT_NEAR(curve.upper(933) - curve.lower(933), 3.95e8, 1e-6);
  const EnthalpyCurve plain(1000, Table(500.0), {});
  EXPECT_NEAR(plain.upper(800) - plain.upper(300), 2.5e8, 1e-6);
  EXPECT_NEAR(plain.temperature(plain.upper(512.5)), 512.5, 1e-11);
}

TEST(EnthalpyCurve, RefusesCapacitiesAndDensitiesThatAreNotPositive) {
  const PhaseChange negative = change("solidification", PhaseFraction::linear(900, 933), -1);
  EXPECT_THROW(EnthalpyCurve(0, k_capacity, {}), std::invalid_argument);
  EXPECT_THROW(EnthalpyCurve(1000, Table(0.0), {}), std::invalid_argument);
  EXPECT_THROW(EnthalpyCurve(1000, Table({300, 400}, {100, -1}), {}), std::invalid_argument);
  EXPECT_THROW(EnthalpyCurve(1000, k_capacity, std::span(&negative, 1)), std::invalid_argument);
}

}  // namespace
}  // namespace solidus::material
