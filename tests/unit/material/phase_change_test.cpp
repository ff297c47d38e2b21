#include "material/phase_change.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

namespace solidus::material {
namespace {

// Aluminium with 7 % silicon, linearised phase diagram [K].
constexpr double k_melting = 933.5, k_liquidus = 888.0, k_eutectic = 850.0, k_partition = 0.13;

double lever(double t) {
  return (k_liquidus - t) / ((1 - k_partition) * (k_melting - t));
}
double scheil(double t) {
  return 1 - std::pow((k_melting - t) / (k_melting - k_liquidus), 1 / (k_partition - 1));
}

TEST(PhaseFraction, LinearRunsFromOneAtTheSolidusToZeroAtTheLiquidus) {
  const auto f = PhaseFraction::linear(900, 940);
  EXPECT_EQ(f.value(899), 1);
  EXPECT_EQ(f.value(900), 1);
  EXPECT_DOUBLE_EQ(f.value(910), 0.75);
  EXPECT_EQ(f.value(940), 0);
  EXPECT_EQ(f.value(941), 0);
  EXPECT_EQ(f.derivative(899), 0);
  EXPECT_DOUBLE_EQ(f.derivative(900), -0.025);
  EXPECT_DOUBLE_EQ(f.derivative(939), -0.025);
  EXPECT_EQ(f.derivative(940), 0);
}

TEST(PhaseFraction, IsothermalChangeIsMoltenAtItsTemperatureWhereNothingElseIsKnown) {
  const auto f = PhaseFraction::linear(933, 933);
  EXPECT_EQ(f.below(933), 1);
  EXPECT_EQ(f.value(933), 0);
  EXPECT_EQ(f.above(933), 0);
  EXPECT_EQ(f.value(std::nextafter(933.0, 0.0)), 1);
  EXPECT_EQ(f.value(std::nextafter(933.0, 1e9)), 0);
  EXPECT_EQ(f.derivative(933), 0);
}

TEST(PhaseFraction, ThePlateauShareTellsHowMuchOfAnIsothermalChangeIsDone) {
  const auto f = PhaseFraction::table({{850, 1}, {850, 0.5}, {870, 0.4}, {870, 0.2}, {900, 0}});
  for (const double share : {0.0, 0.25, 0.5, 1.0}) {
    EXPECT_DOUBLE_EQ(f.value(850, share), 1 - 0.5 * share);
    EXPECT_DOUBLE_EQ(f.value(870, share), 0.4 - 0.2 * share);
    for (const double t : {800.0, 860.0, 885.0, 950.0}) EXPECT_EQ(f.value(t, share), f.value(t)) << t;
  }
}

TEST(PhaseFraction, TheIsothermalShareIsThatOfAllJumps) {
  EXPECT_DOUBLE_EQ(
      PhaseFraction::table({{850, 1}, {850, 0.5}, {870, 0.4}, {870, 0.2}, {900, 0}}).isothermal_share(), 0.7);
  EXPECT_EQ(PhaseFraction::linear(900, 900).isothermal_share(), 1);
  EXPECT_EQ(PhaseFraction::linear(800, 900).isothermal_share(), 0);
}

TEST(PhaseFraction, TheMeanOverTemperatureLeavesOutWhatChangesAtOneTemperature) {
  const PhaseFraction f = PhaseFraction::table({{650, 1}, {650, 0.3}, {670, 0.1}, {690, 0}});
  EXPECT_DOUBLE_EQ(f.mean_over_temperature(0.1, 0.2), 0.15) << "over a range";
  EXPECT_DOUBLE_EQ(f.mean_over_temperature(0.2, 0.6), 0.25) << "down to the change";
  EXPECT_DOUBLE_EQ(f.mean_over_temperature(0.6, 1), 1) << "from within it to the solid";
  EXPECT_DOUBLE_EQ(f.mean_over_temperature(1, 0.6), 1) << "and back";
  EXPECT_DOUBLE_EQ(f.mean_over_temperature(0.6, 0.2), 0.25) << "from within it to the mush";
  EXPECT_DOUBLE_EQ(f.mean_over_temperature(0.4, 0.6), 0.5) << "within it no temperature changes";
  EXPECT_DOUBLE_EQ(f.mean_over_temperature(0.6, 0.4), 0.5) << "nor where a little melts again";
  EXPECT_DOUBLE_EQ(f.mean_over_temperature(0.6, 0.6), 0.6) << "nor where nothing freezes";
  EXPECT_DOUBLE_EQ(f.mean_over_temperature(0.2, 1), 0.6) << "through it";
  const PhaseFraction pure = PhaseFraction::linear(900, 900);
  EXPECT_DOUBLE_EQ(pure.mean_over_temperature(0, 0.5), 0) << "melt that begins to freeze";
  EXPECT_DOUBLE_EQ(pure.mean_over_temperature(0.5, 1), 1);
  EXPECT_DOUBLE_EQ(pure.mean_over_temperature(1, 1), 1);
}

TEST(PhaseFraction, TableTakesBothDirectionsAndAnIsothermalPart) {
  const auto rising = PhaseFraction::table({{850, 1}, {850, 0.5}, {880, 0.2}, {888, 0}});
  const auto falling = PhaseFraction::table({{888, 0}, {880, 0.2}, {850, 0.5}, {850, 1}});
  EXPECT_EQ(rising.points(), falling.points());
  EXPECT_EQ(rising.below(850), 1);
  EXPECT_EQ(rising.above(850), 0.5);
  EXPECT_EQ(rising.value(850), 0.5);
  EXPECT_DOUBLE_EQ(rising.value(865), 0.35);
  EXPECT_DOUBLE_EQ(rising.derivative(850), -0.01);
  EXPECT_DOUBLE_EQ(rising.derivative(880), -0.025);
}

TEST(PhaseFraction, LeverRuleAndScheilFollowTheirFormulasWithinTheSamplingTolerance) {
  const auto by_lever = PhaseFraction::lever_rule(k_melting, k_liquidus, k_eutectic, k_partition);
  const auto by_scheil = PhaseFraction::scheil(k_melting, k_liquidus, k_eutectic, k_partition);
  for (int i = 1; i < 10000; ++i) {
    const double t = k_eutectic + (k_liquidus - k_eutectic) * i / 10000.0;
    ASSERT_NEAR(by_lever.value(t), lever(t), 1e-6);
    ASSERT_NEAR(by_scheil.value(t), scheil(t), 1e-6);
  }
  EXPECT_EQ(by_scheil.below(k_eutectic), 1);
  EXPECT_NEAR(by_scheil.above(k_eutectic), scheil(k_eutectic),
              1e-15);  // the eutectic rest freezes isothermally
  EXPECT_LT(by_scheil.points().size(), 600u);
}

TEST(PhaseFraction, LeverRuleEndsAtTheSolidusWhenThatLiesAboveTheEutectic) {
  const double partition = 0.8, solidus = (k_liquidus - 0.2 * k_melting) / 0.8;
  const auto f = PhaseFraction::lever_rule(k_melting, k_liquidus, 800, partition);
  EXPECT_DOUBLE_EQ(f.solidus(), solidus);
  EXPECT_EQ(f.below(solidus), 1);
  EXPECT_NEAR(f.above(solidus), 1, 1e-12);  // no jump beyond rounding
}

TEST(PhaseFraction, NeverRisesAndIsTheSumOfItsSlopes) {
  const auto f = PhaseFraction::scheil(k_melting, k_liquidus, k_eutectic, k_partition);
  double previous = 1;
  for (double t = 840; t < 900; t += 0.0101) {
    ASSERT_LE(f.value(t), previous);
    previous = f.value(t);
    const double h = 1e-7;
    if (f.derivative(t) == f.derivative(t + h)) {  // the same piece
      ASSERT_NEAR(f.derivative(t), (f.value(t + h) - f.value(t)) / h,
                  1e-7);  // rounding: 2e-16/h and of t + h
    }
  }
}

TEST(PhaseFraction, LanesAnswerAsNumbersDoAlsoAtJumpsAndOutside) {
  const auto jump = PhaseFraction::table({{850, 1}, {850, 0.5}, {870, 0.4}, {870, 0.2}, {900, 0}});
  for (const PhaseFraction& f : {jump, PhaseFraction::linear(900, 940), PhaseFraction::linear(933, 933),
                                 PhaseFraction::scheil(933, 886, 821, 0.14)}) {
    std::vector<double> temperatures{100, 5000};
    for (const auto& [t, fraction] : f.points())
      for (const double at : {t, std::nextafter(t, 0.0), std::nextafter(t, 1e9), t + 0.3})
        temperatures.push_back(at);
    for (const double t : temperatures) {
      Lane pack(910.0);
      pack.set(3, t);
      const auto line = f.line(pack);
      ASSERT_NEAR(line.value[3], f.value(t), 1e-15) << t;  // a product and a sum, contracted or not
      ASSERT_EQ(line.slope[3], f.derivative(t)) << t;
      ASSERT_NEAR(line.value[4], f.value(910), 1e-15);
      ASSERT_NEAR(f.value(t), f.above(t), 1e-15) << t;
      ASSERT_GE(line.value[3], 0);
    }
  }
}

TEST(PhaseFraction, RefusesWhatIsNoFraction) {
  EXPECT_THROW(PhaseFraction::linear(941, 940), std::invalid_argument);
  EXPECT_THROW(PhaseFraction::linear(std::nan(""), 940), std::invalid_argument);
  EXPECT_THROW(PhaseFraction::table({{900, 1}}), std::invalid_argument);
  EXPECT_THROW(PhaseFraction::table({{900, 0.9}, {950, 0}}), std::invalid_argument);
  EXPECT_THROW(PhaseFraction::table({{900, 1}, {950, 0.1}}), std::invalid_argument);
  EXPECT_THROW(PhaseFraction::table({{900, 0}, {950, 1}}), std::invalid_argument);
  EXPECT_THROW(PhaseFraction::table({{900, 1}, {940, 0.2}, {930, 0.1}, {950, 0}}), std::invalid_argument);
  EXPECT_THROW(PhaseFraction::table({{900, 1}, {930, 0.1}, {940, 0.2}, {950, 0}}), std::invalid_argument);
  EXPECT_THROW(PhaseFraction::scheil(k_liquidus, k_melting, k_eutectic, k_partition), std::invalid_argument);
  EXPECT_THROW(PhaseFraction::scheil(k_melting, k_liquidus, 900, k_partition), std::invalid_argument);
  EXPECT_THROW(PhaseFraction::lever_rule(k_melting, k_liquidus, k_eutectic, 1.0), std::invalid_argument);
}

}  // namespace
}  // namespace solidus::material
