/// The case cases/hot_spots: the melt that a thin neck cuts off from its riser is found, and where it freezes
/// last.
#include <gtest/gtest.h>

#include "case_run.hpp"

namespace {

using solidus::testing::Columns;

TEST(HotSpots, TheMeltBehindTheNeckIsClosedOffAndFreezesInItsMiddle) {
  const auto run = solidus::testing::run("cases/hot_spots", "hot_spots");
  ASSERT_TRUE(run.finished) << run.reason;
  const Columns pools = solidus::testing::read_csv(std::filesystem::path(SOLIDUS_BINARY_DIR) / "case_runs" /
                                                   "hot_spots" / "pools.csv");
  const std::vector<double>& number = pools.at("pool[1]");
  bool froze = false;
  for (std::size_t i = 0; i < number.size(); ++i) {
    EXPECT_LE(number[i], 2);  // no crumbs
    if (number[i] != 2 || pools.at("frozen_at[s]")[i] < 0) continue;
    froze = true;
    EXPECT_EQ(pools.at("parent[1]")[i], 1);
    EXPECT_GT(pools.at("closed_off_since[s]")[i], 90);
    EXPECT_LT(pools.at("closed_off_since[s]")[i], 120);
    EXPECT_NEAR(pools.at("frozen_at[s]")[i], 145, 8);
    EXPECT_NEAR(pools.at("x[m]")[i], 0.155, 0.006);  // two elements
    EXPECT_NEAR(pools.at("y[m]")[i], 0.020, 0.006);
  }
  EXPECT_TRUE(froze);
}

}  // namespace
