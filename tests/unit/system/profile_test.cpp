#include "system/profile.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <numeric>
#include <thread>

namespace solidus {
namespace {

void wait() {
  std::this_thread::sleep_for(std::chrono::milliseconds(2));
}

double seconds_of(const std::string& name) {
  for (const auto& [row, seconds] : profile::rows())
    if (row == name) return seconds;
  return -1;
}

TEST(Profile, TheRowsAddUpToTheWholeWhileAPartIsRunning) {
  profile::begin();
  const profile::Part outer("outer");
  wait();
  {
    const profile::Part inner("inner");
    wait();
  }
  const auto rows = profile::rows();
  const double sum = std::accumulate(rows.begin(), rows.end(), 0.0,
                                     [](double s, const auto& row) { return s + row.second; });
  const double since = profile::total() - sum;  // between the two calls
  EXPECT_GE(since, -1e-9);
  EXPECT_LT(since, 1e-3 + 0.5 * sum);
  EXPECT_GE(sum, 4e-3);
}

TEST(Profile, APartDoesNotCountTheTimeOfThoseWithin) {
  profile::begin();
  {
    const profile::Part outer("around");
    for (int i = 0; i < 3; ++i) {
      const profile::Part inner("within");
      wait();
    }
  }
  EXPECT_GE(seconds_of("around: within"), 6e-3);
  EXPECT_LT(seconds_of("around"), seconds_of("around: within"));
}

TEST(Profile, TheSamePartHasARowForEachPartAroundIt) {
  profile::begin();
  for (const char* phase : {"first phase", "second phase"}) {
    const profile::Part part(phase);
    const profile::Part solve("solve");
    wait();
  }
  EXPECT_GE(seconds_of("first phase: solve"), 2e-3);
  EXPECT_GE(seconds_of("second phase: solve"), 2e-3);
  EXPECT_NE(profile::text().find("first phase: solve"), std::string::npos);
}

TEST(Profile, AnExceptionEndsItsParts) {
  profile::begin();
  try {
    const profile::Part part("fails");
    throw 1;
  } catch (int) {
  }
  wait();
  EXPECT_GE(seconds_of("other"), 2e-3);
}

}  // namespace
}  // namespace solidus
