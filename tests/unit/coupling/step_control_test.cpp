#include "coupling/step_control.hpp"

#include <gtest/gtest.h>

using solidus::coupling::PlannedStep;
using solidus::coupling::StepControl;
using solidus::coupling::StepOptions;

namespace {

StepOptions step_of(double step) {
  StepOptions options;
  options.step = step;
  return options;
}

TEST(StepControl, FixedStepsMeetTheEndExactly) {
  StepControl control(step_of(0.1), 0, {1.0});
  double time = 0;
  int n = 0;
  while (!control.finished(time)) {
    time = control.plan(time).time;
    control.accepted(3);
    ++n;
  }
  EXPECT_EQ(time, 1.0);  // the very bits, although 0.1 has none
  EXPECT_EQ(n, 10);
}

TEST(StepControl, OutputTimesAreMetExactly) {
  StepControl control(step_of(0.4), 0, {1.0, 2.0});
  double time = 0;
  std::vector<double> times;
  while (!control.finished(time)) times.push_back(time = control.plan(time).time);
  EXPECT_TRUE(std::find(times.begin(), times.end(), 1.0) != times.end());
  EXPECT_EQ(times.back(), 2.0);
  EXPECT_TRUE(control.is_landing(1.0));
  EXPECT_FALSE(control.is_landing(0.4));
}

TEST(StepControl, ARejectedStepIsHalvedAndGrowsBackToWhatWasAsked) {
  StepControl control(step_of(1), 0, {100});
  PlannedStep step = control.plan(0);
  ASSERT_TRUE(control.rejected(step));
  step = control.plan(0);
  EXPECT_DOUBLE_EQ(step.dt, 0.5);
  EXPECT_EQ(step.reason, "cut after a rejected step");
  control.accepted(3);
  EXPECT_DOUBLE_EQ(control.plan(0.5).dt, 0.75);
  control.accepted(20);  // hard, yet it comes back
  EXPECT_DOUBLE_EQ(control.plan(1.25).dt, 1.0);
}

TEST(StepControl, CutsEndAtTheSmallestStep) {
  StepOptions options = step_of(1);
  options.min_step = 0.25;
  StepControl control(options, 0, {100});
  EXPECT_TRUE(control.rejected(control.plan(0)));
  EXPECT_TRUE(control.rejected(control.plan(0)));
  EXPECT_FALSE(control.rejected(control.plan(0)));
}

TEST(StepControl, AdaptiveStepsGrowWhenEasyAndStayBelowTheLargest) {
  StepOptions options = step_of(1);
  options.adaptive = true;
  options.max_step = 2;
  StepControl control(options, 0, {100});
  control.accepted(3);
  EXPECT_DOUBLE_EQ(control.plan(1).dt, 1.5);
  control.accepted(20);
  EXPECT_DOUBLE_EQ(control.plan(2.5).dt, 1.5);
  control.accepted(3);
  EXPECT_DOUBLE_EQ(control.plan(4).dt, 2.0);
}

TEST(StepControl, AdaptiveStepsLeaveNoSliverBeforeALanding) {
  StepOptions options = step_of(1);
  options.adaptive = true;
  StepControl control(options, 0, {1.2});
  EXPECT_DOUBLE_EQ(control.plan(0).dt, 0.6);
}

TEST(StepControl, ContradictorySizesAreRefused) {
  StepOptions options = step_of(1);
  options.min_step = 2;
  EXPECT_THROW(StepControl(options, 0, {10}), std::invalid_argument);
  EXPECT_THROW(StepControl(step_of(0), 0, {10}), std::invalid_argument);
  EXPECT_THROW(StepControl(step_of(1), 10, {10}), std::invalid_argument);
}

}  // namespace
