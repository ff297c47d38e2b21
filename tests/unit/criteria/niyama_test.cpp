#include "criteria/niyama.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "bodies.hpp"

namespace solidus {
namespace {

using criteria::FeedingLaw;

TEST(FeedingLaw, OfALinearSolidFractionIsTheClosedForm) {
  const FeedingLaw law = *FeedingLaw::of(test::metal(40));
  for (const double g : {0.01, 0.1, 0.3, 0.9, 1.0})
    EXPECT_NEAR(law.resistance(g), 180 * (1 / g - g + 2 * std::log(g)), 1e-9 * (1 + law.resistance(g)));
}

// Ny* of K. D. Carlson and C. Beckermann (Metall. Mater. Trans. A 40 (2009) 163) for the melt that is left
// when pores open.
TEST(FeedingLaw, HasTheNumbersOfCarlsonAndBeckermann) {
  const FeedingLaw law = *FeedingLaw::of(test::metal(40));
  const struct {
    double left, number;
  } rows[] = {{0.3, 10.610}, {0.2, 16.870}, {0.1, 30.872}, {0.05, 50.125}, {0.01, 127.829}};
  for (const auto& [left, number] : rows) EXPECT_NEAR(std::sqrt(law.resistance(left)), number, 6e-4) << left;
}

TEST(FeedingLaw, FindsThePoresThatBelongToItsNumber) {
  const FeedingLaw law = *FeedingLaw::of(test::metal(40));
  for (const double g : {0.01, 0.1, 0.3, 0.9})
    EXPECT_NEAR(law.pore_fraction(std::sqrt(law.resistance(g))), 0.05 * g, 1e-6);
  // Nothing feeds: all the shrinkage, to the root of what rounding leaves of a cubic zero.
  EXPECT_NEAR(law.pore_fraction(0), 0.05, 1e-5);
}

TEST(FeedingLaw, OfMetalWhoseLastMeltFreezesAtOnceHasAnEndToItsResistance) {
  material::Material m = test::metal(40);
  m.phase_changes[0].fraction = material::PhaseFraction::scheil(933, 887, 850, 0.13);
  const FeedingLaw law = *FeedingLaw::of(m);
  const double eutectic = 1 - m.phase_changes[0].fraction.above(850);
  EXPECT_DOUBLE_EQ(law.resistance(0.5 * eutectic), law.resistance(eutectic));
  EXPECT_EQ(law.pore_fraction(1.01 * std::sqrt(law.resistance(eutectic))), 0);
  EXPECT_NEAR(law.pore_fraction(0.99 * std::sqrt(law.resistance(eutectic))), 0.05 * eutectic, 0.002);
  for (const double g : {0.6, 0.7, 0.9})  // on different pieces of the curve
    EXPECT_NEAR(law.pore_fraction(std::sqrt(law.resistance(g))), 0.05 * g, 1e-9) << g;
}

TEST(FeedingLaw, IsNotThereForWhatDoesNotShrinkOrHasNoRangeOrNoArms) {
  material::Material expands = test::metal(40);
  expands.phase_changes[0].volume_change = 0.02;
  EXPECT_FALSE(FeedingLaw::of(expands));
  EXPECT_FALSE(FeedingLaw::of(test::metal(0)));
  material::Material iron = test::metal(40);  // what graphite adds outweighs the shrinkage
  iron.phase_changes.push_back({"graphite", material::PhaseFraction::linear(860, 880), 0, 0.06, false});
  EXPECT_FALSE(FeedingLaw::of(iron));
  material::Material unknown = test::metal(40);
  unknown.casting.arm_spacing.reset();
  EXPECT_FALSE(FeedingLaw::of(unknown));
  EXPECT_FALSE(unknown.casting.secondary_arm_spacing(100));
}

TEST(Niyama, IsZeroWithoutACoolingRate) {
  EXPECT_EQ(criteria::niyama(1000, 0), 0);
  EXPECT_DOUBLE_EQ(criteria::niyama(1000, 4), 500);
}

}  // namespace
}  // namespace solidus
