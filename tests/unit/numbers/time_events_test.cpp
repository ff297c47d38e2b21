#include "numbers/time_events.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace solidus {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(TimeEvents, EveryCornerOfAPulseIsOneAndPointsOnALineAreNone) {
  const Table pulse({0, 10, 53.3, 53.301, 54, 54.3, 54.301, 300}, {0, 0, 0, 1e6, 1e6, 1e6, 0, 0});
  EXPECT_THAT(corners(pulse, 0, 200, 1e4), ElementsAre(53.3, 53.301, 54.3, 54.301));
  EXPECT_THAT(corners(pulse, 53.5, 54.2, 1e4), IsEmpty());
}

TEST(TimeEvents, ATableBeginsToBendAtItsFirstPoint) {
  EXPECT_THAT(corners(Table({5, 10}, {0, 1}), 0, 20, 0.01), ElementsAre(5, 10));
}

TEST(TimeEvents, AHundredThousandPointsOfASlowCurveWithNoiseBelowTheToleranceAreAFewCorners) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> noise(-0.004, 0.004);
  std::vector<double> x, y;
  for (int i = 0; i < 100000; ++i) {
    x.push_back(i * 0.01);
    y.push_back(std::exp(-x.back() / 300) + noise(random));
  }
  const Table table(x, y);
  const std::vector<double> found = corners(table, 0, 1000, 0.01);
  EXPECT_LT(found.size(), 30U);
  std::vector<double> ends = found, values;
  ends.insert(ends.begin(), 0);
  ends.push_back(x.back());
  for (const double end : ends) values.push_back(table.value(end));
  const Table lines(ends, values);
  for (std::size_t i = 0; i < x.size(); ++i) ASSERT_NEAR(lines.value(x[i]), y[i], 0.01) << x[i];
}

TEST(TimeEvents, AHundredThousandPulsesAreAThousandCornersAtMost) {
  std::vector<double> x, y;
  for (int i = 0; i < 100000; ++i) {
    x.push_back(i);
    y.push_back(i % 2);
  }
  EXPECT_EQ(corners(Table(x, y), 0, 1e5, 0.01).size(), static_cast<std::size_t>(k_most_events));
}

TEST(TimeEvents, JumpsOfAFormulaAreFoundToRounding) {
  const auto pulses = [](double t) { return t - 10 * std::rint(t / 10 - 0.5) < 1 ? 1e6 : 0.0; };
  const std::vector<TimeEvent> found = breaks(pulses, 0, 200, 0.125);
  ASSERT_GE(found.size(), 38U);
  for (const TimeEvent& event : found) {
    const double phase = std::fmod(event.time + 5, 10) - 5;
    EXPECT_NEAR(std::min(std::abs(phase), std::abs(phase - 1)), 0, 1e-9) << event.time;
    EXPECT_TRUE(event.jump);
  }
}

TEST(TimeEvents, AChangeOfSlopeIsFoundAndNoneOfASmoothFunctionIs) {
  const std::vector<TimeEvent> found = breaks([](double t) { return std::min(t, 3.3); }, 0, 10, 0.1);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].time, 3.3, 1e-5);
  EXPECT_FALSE(found[0].jump);
  EXPECT_THAT(breaks([](double t) { return std::sin(20 * t); }, 0, 10, 0.1), IsEmpty());
  EXPECT_THAT(breaks([](double t) { return std::exp(-t * t / 1e-2); }, -5, 5, 0.1), IsEmpty());
  EXPECT_THAT(breaks([](double) { return 7.0; }, 0, 10, 0.1), IsEmpty());
}

TEST(TimeEvents, OfTwoThatAreCloseTheSecondOneStaysOnlyWhereItsEndsCount) {
  const auto times = [](const std::vector<TimeEvent>& events) {
    std::vector<double> all;
    for (const TimeEvent& event : events) all.push_back(event.time);
    return all;
  };
  EXPECT_THAT(times(in_order({{2.0005, false, false}, {2, false, false}, {1, false, false}}, 1e-9, 1e-3)),
              ElementsAre(1, 2));
  EXPECT_THAT(times(in_order({{2, false, false}, {2.0005, true, false}}, 1e-9, 1e-3)),
              ElementsAre(2, 2.0005));
  EXPECT_THAT(times(in_order({{2, true, false}, {2 + 1e-12, true, true}}, 1e-9, 1e-3)), ElementsAre(2));
  EXPECT_TRUE(in_order({{2, true, false}, {2 + 1e-12, true, true}}, 1e-9, 1e-3).front().jump);
}

}  // namespace
}  // namespace solidus
