#include "coupling/largest_difference.hpp"

#include <gtest/gtest.h>

#include <array>

namespace solidus {
namespace {

TEST(LargestDifference, IsThatOfAnyEntry) {
  const std::array<double, 3> a{1, -2, 3}, b{1, 5, 2};
  EXPECT_EQ(coupling::largest_difference(a, b), 7);
  EXPECT_EQ(coupling::largest_difference(a, a), 0);
}

TEST(LargestDifference, IsInfiniteWhereAnEntryIsNotANumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t at = 0; at < 3; ++at) {
    const std::array<double, 3> a{1, -2, 3};
    std::array<double, 3> b = a;
    b[at] = nan;
    EXPECT_EQ(coupling::largest_difference(a, b), std::numeric_limits<double>::infinity()) << at;
  }
}

}  // namespace
}  // namespace solidus
