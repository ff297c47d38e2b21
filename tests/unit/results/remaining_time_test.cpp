#include "results/remaining_time.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace solidus::results {
namespace {

TEST(RemainingTime, OfEqualStepsFollowsTheirNumber) {
  RemainingTime left(0, 0);
  left.step(0, 100);
  EXPECT_LT(left.seconds_until(10), 0);  // nothing is known
  left.step(1, 103);
  EXPECT_DOUBLE_EQ(left.seconds_until(10), 27);
  left.step(2, 104);
  EXPECT_DOUBLE_EQ(left.seconds_until(10), 16);
  EXPECT_EQ(left.seconds_until(2), 0);
}

TEST(RemainingTime, StepsThatGrowWithTheTimeAreFewer) {
  const RemainingTime left(0, 100);
  // dt = t/10: ln(10)/0.1 steps from 10 to 100
  EXPECT_NEAR(left.steps_left(10, 100, 1, 1), 10 * std::log(10), 1e-9);
  // dt = sqrt(t/10): ∫ sqrt(10/t) dt
  EXPECT_NEAR(left.steps_left(10, 1000, 1, 0.5), 2 * std::sqrt(10) * (std::sqrt(1000) - std::sqrt(10)), 1e-9);
  // at most 100 s each, from 1000 s on
  EXPECT_NEAR(left.steps_left(10, 6000, 1, 1), 10 * std::log(100) + 50, 1e-9);
}

/// Steps that grow by half to a tenth of the time, and then like √t, cut by output times, to the largest.
TEST(RemainingTime, OfACastingIsKnownAfterAFewSteps) {
  std::vector<double> times{0};
  double dt = 0.5;
  const double end = 3000, largest = 60, every = 250;
  while (times.back() < end) {
    const double t = times.back(), output = every * (std::floor(t / every * (1 + 1e-12)) + 1);
    times.push_back(std::min({t + dt, output, end}));
    dt = std::min({1.5 * dt, std::max(0.5, std::sqrt(times.back())), largest});
  }
  const auto n = times.size() - 1;
  RemainingTime left(0, largest);
  for (std::size_t i = 0; i <= n; ++i) {
    left.step(times[i], static_cast<double>(i));
    if (i < 5 || i + 5 > n) continue;
    const double expected = static_cast<double>(n - i);
    EXPECT_LT(left.seconds_until(end), 1.6 * expected) << "after " << i << " of " << n;
    EXPECT_GT(left.seconds_until(end), 0.6 * expected) << "after " << i << " of " << n;
  }
}

TEST(RemainingTime, AStageBeginsAnew) {
  RemainingTime left(0, 100);
  for (int i = 0; i <= 10; ++i) left.step(100.0 * i, i);
  left.begin_anew();
  left.step(1001, 11);
  EXPECT_LT(left.seconds_until(2000), 0);  // one step does not tell how they grow
  left.step(1003, 12);
  RemainingTime alone(0, 100);
  for (const int time : {0, 1, 3}) alone.step(time, time);
  EXPECT_DOUBLE_EQ(left.seconds_until(2000), alone.seconds_until(1000) * 2 / 3);  // 2 s of the clock, not 3
}

}  // namespace
}  // namespace solidus::results
