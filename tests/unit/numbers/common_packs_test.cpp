#include "numbers/common_packs.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace solidus {
namespace {

struct Three {
  Lane a, b, c;
};

Lane rising(double from) {
  Lane lane;
  for (int i = 0; i < k_lanes; ++i) lane.set(i, from + i);
  return lane;
}

void expect_equal(const Lane& a, const Lane& b) {
  for (int i = 0; i < k_lanes; ++i) EXPECT_EQ(a[i], b[i]);
}

TEST(CommonPacks, AreZeroUntilTheyAreSet) {
  const CommonPacks<Three> packs(3);
  expect_equal(packs[2].b, Lane(0.0));
  EXPECT_EQ(packs.width(), 0U);
}

TEST(CommonPacks, KeepWhatIsEverywhereTheSameOnce) {
  CommonPacks<Three> packs(100);
  for (std::size_t i = 0; i < packs.size(); ++i) packs.set(i, {Lane(7.0), rising(1), Lane(0.0)});
  EXPECT_EQ(packs.width(), 0U);
  EXPECT_EQ(packs.bytes(), 0U);
  expect_equal(packs[50].b, rising(1));
}

TEST(CommonPacks, GiveEveryPointItsOwnOnceOneDiffers) {
  CommonPacks<Three> packs(5);
  for (std::size_t i = 0; i < packs.size(); ++i) packs.set(i, {Lane(7.0), Lane(1.0), Lane(0.0)});
  Three other{Lane(7.0), Lane(1.0), Lane(0.0)};
  other.c.set(3, 1e-300);  // one lane is enough
  packs.set(4, other);
  packs.set(2, {Lane(8.0), Lane(1.0), Lane(2.0)});
  EXPECT_EQ(packs.width(), 2U);
  EXPECT_EQ(packs.bytes(), 5 * 2 * sizeof(Lane));
  expect_equal(packs[0].a, Lane(7.0));
  expect_equal(packs[2].a, Lane(8.0));
  expect_equal(packs[2].c, Lane(2.0));
  expect_equal(packs[3].c, Lane(0.0));
  EXPECT_EQ(packs[4].c[3], 1e-300);
  EXPECT_EQ(packs[4].b[0], 1.0);
}

TEST(CommonPacks, WhatIsNoNumberDiffers) {
  CommonPacks<Three> packs(2);
  packs.set(0, {Lane(1.0), Lane(1.0), Lane(1.0)});
  packs.set(1, {Lane(1.0), Lane(std::numeric_limits<double>::quiet_NaN()), Lane(1.0)});
  EXPECT_EQ(packs[0].b[0], 1.0);
  EXPECT_NE(packs[1].b[0], packs[1].b[0]);
}

}  // namespace
}  // namespace solidus
