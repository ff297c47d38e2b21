// Large pages are advice: whatever the system answers, the vector holds its values.
#include <gtest/gtest.h>

#include <algorithm>

#include "system/large_pages.hpp"

namespace {

using namespace solidus;

TEST(LargePages, HoldTheValuesAskedForWhateverTheSize) {
  std::vector<double> v{1, 2, 3};
  for (const std::size_t n : {std::size_t{0}, std::size_t{5}, std::size_t{1} << 19, std::size_t{7}}) {
    assign_in_large_pages(v, n, 2.5);
    EXPECT_EQ(v.size(), n);
    EXPECT_EQ(std::count(v.begin(), v.end(), 2.5), static_cast<std::ptrdiff_t>(n));
  }
}

TEST(LargePages, LeaveMemoryBetweenPagesAlone) {
  const double one = 1;
  ask_for_large_pages(&one, sizeof one);
  ask_for_large_pages(nullptr, 0);
  EXPECT_EQ(one, 1);
}

}  // namespace
