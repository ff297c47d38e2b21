#include "coupling/turn_watch.hpp"

#include <gtest/gtest.h>

namespace solidus::coupling {
namespace {

using Finding = TurnWatch::Finding;

TEST(TurnWatchTest, GoesOnWhileGapsSettle) {
  TurnWatch watch;  // the first step of two blocks, 2 s
  for (const double share : {0.47, 0.22, 0.087, 0.034}) EXPECT_EQ(watch.after(share), Finding::nearer);
}

TEST(TurnWatchTest, TakesGapsBetweenTwoStatesOnceAndThenGivesUp) {
  TurnWatch watch;
  EXPECT_EQ(watch.after(0.300), Finding::nearer);
  EXPECT_EQ(watch.after(0.317), Finding::round);
  EXPECT_EQ(watch.after(0.300), Finding::stuck);
}

TEST(TurnWatchTest, GoesOnWhereGapsBetweenHaveHelped) {
  TurnWatch watch;
  EXPECT_EQ(watch.after(0.20), Finding::nearer);
  EXPECT_EQ(watch.after(0.19), Finding::round);
  EXPECT_EQ(watch.after(0.05), Finding::nearer);
}

}  // namespace
}  // namespace solidus::coupling
