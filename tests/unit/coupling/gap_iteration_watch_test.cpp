#include "coupling/gap_iteration_watch.hpp"

#include <gtest/gtest.h>

namespace solidus::coupling {
namespace {

using Finding = GapIterationWatch::Finding;

TEST(GapIterationWatchTest, GoesOnWhileGapsSettle) {
  GapIterationWatch watch;  // the first step of two blocks, 2 s
  for (const double share : {0.47, 0.22, 0.087, 0.034}) EXPECT_EQ(watch.after(share), Finding::nearer);
}

TEST(GapIterationWatchTest, TakesGapsBetweenTwoStatesOnceAndThenGivesUp) {
  GapIterationWatch watch;
  EXPECT_EQ(watch.after(0.300), Finding::nearer);
  EXPECT_EQ(watch.after(0.317), Finding::between);
  EXPECT_EQ(watch.after(0.300), Finding::stuck);
}

TEST(GapIterationWatchTest, GoesOnWhereGapsBetweenHaveHelped) {
  GapIterationWatch watch;
  EXPECT_EQ(watch.after(0.20), Finding::nearer);
  EXPECT_EQ(watch.after(0.19), Finding::between);
  EXPECT_EQ(watch.after(0.05), Finding::nearer);
}

}  // namespace
}  // namespace solidus::coupling
