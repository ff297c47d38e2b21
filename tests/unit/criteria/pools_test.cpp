/// Pools of melt in a bar: split, joined, frozen; on one process and on two.
#include "criteria/pools.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "bodies.hpp"
#include "system/errors.hpp"

namespace solidus {
namespace {

using criteria::Pool;
using criteria::Pools;
using test::Casting;

// A bar of 20 × 2 cells of 10 mm; melt where `hot` says.
Casting bar() {
  return {test::block_mesh(mesh::Shape::quad4, {0.2, 0.02}, {20, 2}), 40};
}

// Melt (at 950 K) between the given places [m], solid (at 800 K) elsewhere.
Casting::Field melt(std::vector<std::pair<double, double>> hot) {
  return [hot = std::move(hot)](const mesh::Point& x) {
    const bool inside = std::any_of(hot.begin(), hot.end(), [&](const auto& range) {
      return x[0] > range.first - 1e-6 && x[0] < range.second + 1e-6;
    });
    return inside ? 950.0 : 800.0;
  };
}

TEST(Pools, KeepTheirNumbersWhenTheySplit) {
  Casting casting = bar();
  Pools pools(casting.mesh, casting.storage);
  casting.start(pools, 0, melt({{0, 0.2}}));
  ASSERT_EQ(Pools::pools(casting.record).size(), 1U);
  EXPECT_NEAR(Pools::pools(casting.record)[0].volume, 0.2 * 0.02, 1e-12);
  casting.step(pools, 10, melt({{0.02, 0.05}, {0.08, 0.16}}));
  std::vector<Pool> now = Pools::pools(casting.record);
  ASSERT_EQ(now.size(), 2U);
  EXPECT_NEAR(now[0].volume, 0.09 * 0.02, 1e-12);  // the larger part keeps its number
  EXPECT_LT(now[0].closed_off, 0);
  EXPECT_NEAR(now[1].volume, 0.04 * 0.02, 1e-12);
  EXPECT_EQ(now[1].parent, 1);
  EXPECT_EQ(now[1].closed_off, 10);
  casting.step(pools, 20, melt({{0.03, 0.05}, {0.08, 0.10}, {0.12, 0.15}}));
  now = Pools::pools(casting.record);
  ASSERT_EQ(now.size(), 3U);
  EXPECT_NEAR(now[0].where[0], 0.135, 0.0151);
  EXPECT_NEAR(now[1].where[0], 0.04, 0.0101);
  EXPECT_EQ(now[2].parent, 1);
  EXPECT_NEAR(now[2].where[0], 0.09, 0.0101);
  auto fields = casting.fields(pools);
  for (std::size_t i = 0; i < casting.mesh.x.size(); ++i) {
    const double x = casting.mesh.x[i][0];
    const double expected = x > 0.029 && x < 0.051   ? 2
                            : x > 0.079 && x < 0.101 ? 3
                            : x > 0.119 && x < 0.151 ? 1
                                                     : 0;
    EXPECT_EQ(fields["liquid_pool"][i], expected) << x;
    EXPECT_EQ(fields["pool_volume"][i] > 0, expected > 0) << x;
    // What has passed the limit keeps the pool that it was in last; pool 1 was all of the bar at first.
    const double zone = expected > 0 ? expected : x > 0.019 && x < 0.051 ? 2 : 1;
    EXPECT_EQ(fields["feeding_zone"][i], zone) << x;
  }
}

TEST(Pools, EndWhereTheirLastNodePassesTheLimit) {
  Casting casting = bar();
  Pools pools(casting.mesh, casting.storage, {.limit = 0.5, .feeders = {}});
  casting.start(pools, 0, melt({{0, 0.2}}));
  casting.step(pools, 10, melt({{0.02, 0.05}, {0.08, 0.16}}));
  // The last of the small pool is at x = 0.04. From 950 K it is at 860 K after six tenths of the step, and
  // has passed the limit at half of that.
  casting.step(pools, 20, melt({{0.04, 0.04}, {0.08, 0.16}}));
  casting.step(pools, 30, melt({{0.08, 0.16}}));
  const std::vector<Pool> now = Pools::pools(casting.record);
  ASSERT_EQ(now.size(), 2U);
  EXPECT_NEAR(now[1].frozen, 23, 1e-9);
  EXPECT_TRUE(now[1].ended);
  EXPECT_NEAR(now[1].where[0], 0.04, 1e-9);
  EXPECT_EQ(now[1].volume, 0);
  EXPECT_NEAR(now[1].largest, 0.04 * 0.02, 1e-12);
  casting.step(pools, 40, melt({{0.08, 0.16}}));
  EXPECT_FALSE(Pools::pools(casting.record)[1].ended);
}

TEST(Pools, ThatMeetBecomeTheLargerOne) {
  Casting casting = bar();
  Pools pools(casting.mesh, casting.storage);
  casting.start(pools, 0, melt({{0, 0.04}, {0.08, 0.16}}));
  ASSERT_EQ(Pools::pools(casting.record).size(), 2U);
  const int larger = Pools::pools(casting.record)[0].volume > Pools::pools(casting.record)[1].volume ? 0 : 1;
  casting.step(pools, 10, melt({{0, 0.16}}));
  const std::vector<Pool> now = Pools::pools(casting.record);
  ASSERT_EQ(now.size(), 2U);
  const auto kept = static_cast<std::size_t>(larger), gone = 1 - kept;
  EXPECT_TRUE(now[kept].present());
  EXPECT_NEAR(now[kept].volume, 0.165 * 0.02, 1e-12);
  EXPECT_EQ(now[gone].into, now[kept].number);
  EXPECT_LT(now[gone].frozen, 0);
}

TEST(Pools, AreNoCrumbsOfSingleNodes) {
  Casting casting = bar();
  Pools pools(casting.mesh, casting.storage);
  casting.start(pools, 0, melt({{0, 0.2}}));
  casting.step(pools, 10, melt({{0.02, 0.02}, {0.06, 0.06}, {0.08, 0.16}}));
  ASSERT_EQ(Pools::pools(casting.record).size(), 1U);
  EXPECT_NEAR(Pools::pools(casting.record)[0].volume, 0.09 * 0.02, 1e-12);
}

TEST(Pools, OfEqualHalvesAreToldApartByTheirNodes) {
  Casting casting = bar();
  Pools pools(casting.mesh, casting.storage);
  casting.start(pools, 0, melt({{0, 0.2}}));
  casting.step(pools, 10, melt({{0.02, 0.08}, {0.12, 0.18}}));
  const std::vector<Pool> now = Pools::pools(casting.record);
  ASSERT_EQ(now.size(), 2U);
  EXPECT_LT(now[0].where[0], 0.1);  // the lesser number in the input
}

TEST(Pools, AreClosedOffFromTheMomentTheyTouchNoFeeder) {
  Casting casting = bar();
  Pools pools(casting.mesh, casting.storage, {.limit = 0.7, .feeders = {"x_min"}});
  casting.start(pools, 0, melt({{0, 0.2}}));
  EXPECT_LT(Pools::pools(casting.record)[0].closed_off, 0);
  casting.step(pools, 10, melt({{0, 0.04}, {0.08, 0.16}}));
  std::vector<Pool> now = Pools::pools(casting.record);
  ASSERT_EQ(now.size(), 2U);
  EXPECT_EQ(now[0].closed_off, 10);  // the larger part has lost its feeder
  EXPECT_LT(now[1].closed_off, 0);
  casting.step(pools, 20, melt({{0.01, 0.04}, {0.08, 0.16}}));
  now = Pools::pools(casting.record);
  EXPECT_EQ(now[0].closed_off, 10);
  EXPECT_EQ(now[1].closed_off, 20);
}

TEST(Pools, NeedAFeederThatTheMeshHas) {
  Casting casting = bar();
  EXPECT_THROW(Pools(casting.mesh, casting.storage, {.limit = 0.7, .feeders = {"riser"}}), InputError);
}

TEST(Pools, FindConnectionsAroundCorners) {
  // A U of melt in a plate: one pool, whose arms no row of nodes joins directly.
  Casting casting(test::block_mesh(mesh::Shape::tri3, {0.1, 0.1}, {10, 10}), 40);
  Pools pools(casting.mesh, casting.storage);
  const auto u = [](const mesh::Point& x) {
    const bool arm = (x[0] < 0.025 || x[0] > 0.075) && x[1] > 0.015, foot = x[1] > 0.015 && x[1] < 0.035;
    return arm || foot ? 950.0 : 800.0;
  };
  casting.start(pools, 0, u);
  EXPECT_EQ(Pools::pools(casting.record).size(), 1U);
  casting.step(pools, 10, [&](const mesh::Point& x) { return x[1] < 0.035 ? 800.0 : u(x); });
  EXPECT_EQ(Pools::pools(casting.record).size(), 2U);
}

}  // namespace
}  // namespace solidus
