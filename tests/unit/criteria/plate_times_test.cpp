// Plates that freeze as long as a place does: powers of the time between the sizes of a table, and beyond
// them.
#include "criteria/plate_times.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace solidus::criteria {
namespace {

// t = 2e6 s/m² D², as in sand.
TEST(PlateTimes, FollowChvorinovsSquare) {
  PlateTimes plates;
  for (const double thickness : {0.01, 0.02, 0.04}) {
    plates.thickness.push_back(thickness);
    plates.time.push_back(2e6 * thickness * thickness);
  }
  for (const double thickness : {0.002, 0.01, 0.013, 0.035, 0.04, 0.2})
    EXPECT_NEAR(plates.thickness_of(2e6 * thickness * thickness), thickness, 1e-12 * thickness);
}

// From an interface, t ∝ D, to a mould, t ∝ D²: between two sizes the power in between.
TEST(PlateTimes, TakeThePowerOfTheirNeighbours) {
  const PlateTimes plates{{0.01, 0.02, 0.04}, {10, 20, 80}};
  EXPECT_NEAR(plates.thickness_of(15), 0.015, 1e-12);
  EXPECT_NEAR(plates.thickness_of(40), 0.02 * std::sqrt(2.0), 1e-12);
}

TEST(PlateTimes, SayNothingWhereNothingIsKnown) {
  EXPECT_EQ(PlateTimes{}.thickness_of(10), 0);
  EXPECT_EQ((PlateTimes{{0.01}, {10}}).thickness_of(10), 0);
  const PlateTimes plates{{0.01, 0.02}, {10, 40}};
  EXPECT_EQ(plates.thickness_of(-1), 0);  // not frozen
  EXPECT_EQ(plates.thickness_of(0), 0);
}

}  // namespace
}  // namespace solidus::criteria
