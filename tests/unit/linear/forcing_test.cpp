#include "linear/forcing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace solidus::linear {
namespace {

constexpr double k_distant_goal = 1e-9;  ///< a goal that lies far below

TEST(Forcing, AsksForExactSolvesWhereItIsOff) {
  Forcing forcing(false, 0.1);
  EXPECT_EQ(forcing.next(1.0, 0.5), 0.0);
  EXPECT_EQ(forcing.next(1e-3, 0.5), 0.0);
}

TEST(Forcing, BeginsWithTwoDigitsAndFollowsTheFallOfTheResidual) {
  Forcing forcing(true, 0.1);
  EXPECT_DOUBLE_EQ(forcing.next(5.0, k_distant_goal), 1e-2);
  // Choice 2 of Eisenstat and Walker with γ = 0.9 and the golden ratio.
  EXPECT_NEAR(forcing.next(0.05, k_distant_goal), 0.9 * std::pow(1e-2, 1.6180339887), 1e-10);
  EXPECT_NEAR(forcing.next(0.005, k_distant_goal), 0.9 * std::pow(1e-1, 1.6180339887), 1e-10);
}

TEST(Forcing, TurnsLinearConvergenceIntoOneOfOrderOnePointSix) {
  // A linear system: an iteration gains exactly what it is asked for.
  Forcing forcing(true, 0.1);
  double norm = 1, fall = 1, order = 0;
  for (int k = 0; k < 4; ++k) {
    const double eta = forcing.next(norm, std::numeric_limits<double>::min());
    if (k > 0) order = std::log(eta / 0.9) / std::log(fall);
    fall = eta;
    norm *= eta;
  }
  EXPECT_NEAR(order, 1.618, 1e-3);
}

TEST(Forcing, GainsADigitAtLeastWhereTheResidualHasRisen) {
  Forcing forcing(true, 0.1);
  forcing.next(1.0, k_distant_goal);
  EXPECT_EQ(forcing.next(30.0, k_distant_goal), 0.1);
}

TEST(Forcing, KeepsToItsLoosestTerm) {
  Forcing forcing(true, 1e-3);
  EXPECT_EQ(forcing.next(1.0, 0.5), 1e-3);
  EXPECT_EQ(forcing.next(2.0, 0.5), 1e-3);
}

TEST(Forcing, GoesNoFurtherThanATenthOfTheGoal) {
  Forcing forcing(true, 0.1);
  EXPECT_DOUBLE_EQ(forcing.next(1.0, 0.5), 0.05);
  EXPECT_DOUBLE_EQ(forcing.next(1e-3, 0.3), 0.03);
  EXPECT_EQ(forcing.next(1e-6, 2.0), 0.1);  // another field has not ended yet
}

}  // namespace
}  // namespace solidus::linear
