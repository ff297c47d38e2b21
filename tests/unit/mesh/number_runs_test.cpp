#include "mesh/number_runs.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace solidus::mesh {
namespace {

TEST(NumberRuns, ListsOfEveryKindAreReadAsTheyWereWritten) {
  std::vector<GlobalIndex> rising(1000);
  std::iota(rising.begin(), rising.end(), 17);
  std::vector<GlobalIndex> gaps = rising;
  for (std::size_t i = 300; i < gaps.size(); ++i) gaps[i] += i < 700 ? 5 : -400;
  std::vector<GlobalIndex> falling(rising.rbegin(), rising.rend());
  const std::vector<GlobalIndex> equal(40, 0);
  for (const auto& numbers : {rising, gaps, falling, equal, std::vector<GlobalIndex>{}}) {
    NumberRuns at_once(numbers), one_by_one;
    for (const GlobalIndex number : numbers) one_by_one.push_back(number);
    for (const NumberRuns& runs : {at_once, one_by_one}) {
      ASSERT_EQ(runs.size(), numbers.size());
      EXPECT_EQ(runs.empty(), numbers.empty());
      EXPECT_EQ(runs.first(numbers.size()), numbers);
    }
    at_once.push_back(3);
    EXPECT_EQ(at_once[numbers.size()], 3);
    EXPECT_EQ(at_once.first(numbers.size()), numbers);
    at_once.clear();
    EXPECT_TRUE(at_once.empty());
  }
}

TEST(NumberRuns, ConsecutiveNumbersTakeNoMemoryEachAndOthersAsMuchAsAList) {
  std::vector<GlobalIndex> numbers(10000);
  std::iota(numbers.begin(), numbers.end(), 1);
  EXPECT_LT(NumberRuns(numbers).bytes(), 100U);
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] *= 2;
  EXPECT_EQ(NumberRuns(numbers).bytes(), numbers.size() * sizeof(GlobalIndex));
}

}  // namespace
}  // namespace solidus::mesh
