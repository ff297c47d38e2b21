#include "coupling/step_control.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using solidus::coupling::ErrorControl;
using solidus::coupling::PlannedStep;
using solidus::coupling::StepControl;
using solidus::coupling::StepMeasure;
using solidus::coupling::StepOptions;

namespace {

StepOptions step_of(double step) {
  StepOptions options;
  options.step = step;
  return options;
}

StepOptions adaptive(double step, double max_step) {
  StepOptions options = step_of(step);
  options.adaptive = true;
  options.max_step = max_step;
  return options;
}

StepMeasure iterations(int n) {
  StepMeasure measure;
  measure.iterations = n;
  return measure;
}

TEST(StepControl, TurnsMayEndEarlyAfterThreeFailuresUntilAStepSettles) {
  StepControl control(step_of(1.6), 0, {100.0});
  for (int cut = 0; cut < 3; ++cut) {
    EXPECT_FALSE(control.may_end_early()) << "after " << cut;
    ASSERT_TRUE(control.rejected(control.plan(0), "contact"));
  }
  EXPECT_TRUE(control.may_end_early());
  StepMeasure unsettled = iterations(3);
  unsettled.ended_early = true;
  control.accepted(control.plan(0), unsettled);
  EXPECT_TRUE(control.may_end_early()) << "steps that follow need not fail again";
  control.accepted(control.plan(0.2), iterations(3));
  EXPECT_FALSE(control.may_end_early());
}

std::vector<double> ends_of_steps(StepControl& control, double time = 0) {
  std::vector<double> ends;
  while (!control.finished(time)) {
    const PlannedStep step = control.plan(time);
    ends.push_back(time = step.time);
    control.accepted(step, iterations(3));
  }
  return ends;
}

TEST(StepControl, FixedStepsEndAtEventsAndGoOnFromThereWithWholeSteps) {
  StepControl control(step_of(1), 0, {5.0}, {{2.25, false, false}, {2.75, true, false}});
  EXPECT_THAT(ends_of_steps(control), ::testing::ElementsAre(1, 2, 2.25, 2.75, 3.75, 4.75, 5));
}

TEST(StepControl, AdaptiveStepsEndAtEventsAndHaveTheirSizeBackBehindThem) {
  StepControl control(adaptive(1, 10), 0, {100.0}, {{53.3, false, false}, {53.31, false, false}});
  const std::vector<double> ends = ends_of_steps(control);
  const auto event = std::find(ends.begin(), ends.end(), 53.31);
  ASSERT_NE(event, ends.end());
  EXPECT_EQ(*(event - 1), 53.3);
  EXPECT_NEAR(*(event + 1) - *event, 10, 1e-9);
}

TEST(StepControl, EventsWithinRoundingAreOneAndThoseOfMeansNoCloserThanTheSmallestStep) {
  StepControl same(step_of(1), 0, {5.0}, {{2.5, true, false}, {2.5 + 1e-12, true, false}});
  EXPECT_THAT(ends_of_steps(same), ::testing::ElementsAre(1, 2, 2.5, 3.5, 4.5, 5));
  StepControl close(step_of(1), 0, {5.0},
                    {{2.5, false, false}, {2.5001, false, false}, {5 - 1e-5, false, false}});
  EXPECT_THAT(ends_of_steps(close), ::testing::ElementsAre(1, 2, 2.5, 3.5, 4.5, 5));
  StepControl exact(step_of(1), 0, {5.0}, {{2.5, false, false}, {2.5001, true, false}});
  EXPECT_THAT(ends_of_steps(exact), ::testing::ElementsAre(1, 2, 2.5, 2.5001, 3.5001, 4.5001, 5));
}

TEST(StepControl, ARunThatGoesOnFromAnOutputHasTheEventsOfOneThatHasNotStopped) {
  const std::vector<solidus::TimeEvent> events{{2.00001, false, true}, {3.5, false, true}};
  StepControl whole(step_of(1), 0, {2.0, 5.0}, events), rest(step_of(1), 2, {2.0, 5.0}, events);
  const std::vector<double> all = ends_of_steps(whole);
  EXPECT_EQ(std::vector<double>(all.begin() + 2, all.end()), ends_of_steps(rest, 2));
  EXPECT_TRUE(whole.jumps_at(2)) << "an output replaces it";
  EXPECT_TRUE(whole.jumps_at(3.5));
  EXPECT_FALSE(whole.jumps_at(5));
}

TEST(StepControl, ALoadThatMovesShortensAdaptiveStepsAlone) {
  const StepControl fixed(step_of(1), 0, {5.0}), control(adaptive(1, 10), 0, {5.0});
  EXPECT_EQ(fixed.plan(0, {0.25, "load moves"}).dt, 1);
  EXPECT_EQ(control.plan(0, {0.25, "load moves"}).dt, 0.25);
  EXPECT_EQ(control.plan(0, {0.25, "load moves"}).reason, "load moves");
  EXPECT_EQ(control.plan(0, {1e-9, "load moves"}).dt, 1.0 / 1024);
}

TEST(StepControl, FixedStepsMeetTheEndExactly) {
  StepControl control(step_of(0.1), 0, {1.0});
  double time = 0;
  int n = 0;
  while (!control.finished(time)) {
    const PlannedStep step = control.plan(time);
    time = step.time;
    control.accepted(step, iterations(3));
    ++n;
  }
  EXPECT_EQ(time, 1.0);  // the very bits, although 0.1 has none
  EXPECT_EQ(n, 10);
}

// The times of 30 000 steps of 0.01 s add up to less than 300 s by 1.3e-10 s.
TEST(StepControl, RoundingOfManyStepsLeavesNoSliverBeforeALanding) {
  StepControl control(step_of(0.01), 0, {100.0, 300.0});
  double time = 0, shortest = 1;
  int n = 0;
  while (!control.finished(time)) {
    const PlannedStep step = control.plan(time);
    shortest = std::min(shortest, step.dt);
    time = step.time;
    control.accepted(step, iterations(3));
    ++n;
  }
  EXPECT_EQ(time, 300.0);
  EXPECT_EQ(n, 30000);
  EXPECT_NEAR(shortest, 0.01, 1e-8);
}

TEST(StepControl, AStretchedStepThatIsTooLongIsShortenedOrTheSmallest) {
  StepOptions options = adaptive(1, 1);
  options.min_step = 1;
  StepControl control(options, 0, {1.0005});
  const PlannedStep step = control.plan(0);
  EXPECT_DOUBLE_EQ(step.dt, 1.0005);
  StepMeasure measure = iterations(3);
  measure.solid_fraction_change = 1;
  EXPECT_FALSE(control.too_long(step, measure));  // there is none shorter
  options.min_step = 0.1;
  options.cut = 0.9995;
  StepControl other(options, 0, {1.0005});
  ASSERT_TRUE(other.rejected(other.plan(0), "physics"));
  EXPECT_LT(other.plan(0).dt, 1.0005);
}

TEST(StepLimits, WhatIsNotANumberExceedsThem) {
  StepMeasure measure = iterations(3);
  measure.temperature_error = std::nan("");
  measure.solid_fraction_change = 0.01;
  solidus::coupling::StepLimits limits;
  limits.control = ErrorControl::predictor;
  const auto worst = strictest(limits, measure);
  EXPECT_TRUE(worst.exceeded);
  EXPECT_EQ(worst.name, "temperature error");
}

TEST(StepLimits, ASkinThatLetsGoBoundsAStepInProportion) {
  solidus::coupling::StepMeasure measure;
  solidus::coupling::StepLimits limits;
  limits.control = solidus::coupling::ErrorControl::none;  // it is no error
  limits.skin = 0.08;
  measure.skin_change = 0.16;
  const auto worst = strictest(limits, measure);
  EXPECT_EQ(worst.name, "coherent skin");
  EXPECT_TRUE(worst.exceeded);
  EXPECT_DOUBLE_EQ(worst.factor, 0.4);  // a fifth below the limit
  measure.skin_change = 0.1;
  EXPECT_FALSE(strictest(limits, measure).exceeded);
}

TEST(StepLimits, TheGapThatASkinOpensAsItLetsGoBoundsAStepInProportion) {
  StepMeasure measure;
  measure.skin_opening = 20e-6;
  solidus::coupling::StepLimits limits;
  EXPECT_FALSE(strictest(limits, measure).exceeded);  // unless a displacement bounds it
  limits.opening = 5e-6;
  EXPECT_TRUE(strictest(limits, measure).exceeded);
  EXPECT_EQ(strictest(limits, measure).name, "opening skin");
  EXPECT_DOUBLE_EQ(strictest(limits, measure).factor, 0.2);
}

TEST(StepLimits, TheLastMeltFreezesInStepsOfAHundredthOfItsTime) {
  using solidus::coupling::longest_before_solid;
  EXPECT_EQ(longest_before_solid(0.2, 30, 0.01), HUGE_VAL);
  EXPECT_DOUBLE_EQ(longest_before_solid(0.1, 30, 0.01), 1.5);  // half of what is left at the mean rate
  EXPECT_DOUBLE_EQ(longest_before_solid(0.02, 30, 0.01), 0.3);
  EXPECT_DOUBLE_EQ(longest_before_solid(1e-9, 30, 0.01), 0.3);
  EXPECT_DOUBLE_EQ(longest_before_solid(1e-9, 30, 0.004), 0.12);
  EXPECT_EQ(longest_before_solid(0, 30, 0.01), HUGE_VAL);
  EXPECT_EQ(longest_before_solid(0.1, 0, 0.01), HUGE_VAL);  // what begins as mush has no rate yet
}

TEST(StepLimits, TheHeatOfACastingThatDeformsIsPlannedATenthShort) {
  // Its repetition costs no mechanics.
  StepMeasure measure = iterations(3);
  solidus::coupling::StepLimits limits;
  limits.control = ErrorControl::predictor;
  measure.temperature_error = limits.temperature;
  EXPECT_DOUBLE_EQ(strictest(limits, measure).factor, 0.8);
  limits.last_melt = 0.01;
  EXPECT_DOUBLE_EQ(strictest(limits, measure).factor, 0.9);
}

TEST(StepLimits, ADisplacementThatIsNotIntegratedInTimeMayMissMoreBeforeItsStepIsRepeated) {
  StepMeasure measure = iterations(3);
  solidus::coupling::StepLimits limits;
  limits.control = ErrorControl::predictor;
  measure.displacement_error = 2.5 * limits.displacement;
  EXPECT_FALSE(strictest(limits, measure).exceeded);
  EXPECT_LT(strictest(limits, measure).factor, 0.6);  // the next step is shorter all the same
  limits.inertia = true;
  EXPECT_TRUE(strictest(limits, measure).exceeded);
  limits.inertia = false;
  measure.displacement_error = 4 * limits.displacement;
  EXPECT_TRUE(strictest(limits, measure).exceeded);
  limits.last_melt = 0.01;  // of a casting it is that of the worst node
  EXPECT_FALSE(strictest(limits, measure).exceeded);
  measure.displacement_error = 13 * limits.displacement;
  EXPECT_TRUE(strictest(limits, measure).exceeded);
}

TEST(StepControl, OutputTimesAreMetExactly) {
  StepControl control(step_of(0.4), 0, {1.0, 2.0});
  double time = 0;
  std::vector<double> times;
  while (!control.finished(time)) times.push_back(time = control.plan(time).time);
  EXPECT_TRUE(std::find(times.begin(), times.end(), 1.0) != times.end());
  EXPECT_EQ(times.back(), 2.0);
}

TEST(StepControl, ARejectedStepIsHalvedAndGrowsBackToWhatWasAsked) {
  StepControl control(step_of(1), 0, {100});
  PlannedStep step = control.plan(0);
  ASSERT_TRUE(control.rejected(step, "mechanics: no convergence in 25 iterations"));
  step = control.plan(0);
  EXPECT_DOUBLE_EQ(step.dt, 0.5);
  EXPECT_EQ(step.reason, "rejected: mechanics: no convergence in 25 iterations");
  control.accepted(step, iterations(3));
  step = control.plan(0.5);
  EXPECT_DOUBLE_EQ(step.dt, 0.75);
  EXPECT_EQ(step.reason, "growing after a cut");
  control.accepted(step, iterations(20));  // hard, yet it comes back
  EXPECT_DOUBLE_EQ(control.plan(1.25).dt, 1.0);
  EXPECT_EQ(control.plan(1.25).reason, "as asked");
}

TEST(StepControl, CutsEndAtTheSmallestStep) {
  StepOptions options = step_of(1);
  options.min_step = 0.25;
  StepControl control(options, 0, {100});
  EXPECT_TRUE(control.rejected(control.plan(0), "physics"));
  EXPECT_TRUE(control.rejected(control.plan(0), "physics"));
  EXPECT_FALSE(control.rejected(control.plan(0), "physics"));
}

TEST(StepControl, AStepThatDoesNotConvergeIsCutBelowTheSmallestForErrorsAndGrowsAgain) {
  for (const bool is_adaptive : {false, true}) {
    StepControl control(is_adaptive ? adaptive(1, 2) : step_of(1), 0, {100});
    for (int k = 1; k <= 20; ++k) {
      EXPECT_TRUE(control.rejected(control.plan(0), "physics"));
      EXPECT_DOUBLE_EQ(control.plan(0).dt, std::ldexp(1.0, -k));
    }
    control.accepted(control.plan(0), iterations(3));
    EXPECT_DOUBLE_EQ(control.plan(0).dt, 1.5 * std::ldexp(1.0, -20));
    EXPECT_FALSE(control.rejected(control.plan(0), "physics"));
  }
}

TEST(StepControl, AdaptiveStepsGrowWhenEasyAndStayBelowTheLargest) {
  StepControl control(adaptive(1, 2), 0, {100});
  EXPECT_EQ(control.plan(0).reason, "as asked");
  control.accepted(control.plan(0), iterations(3));
  EXPECT_DOUBLE_EQ(control.plan(1).dt, 1.5);
  EXPECT_EQ(control.plan(1).reason, "growth limit");
  control.accepted(control.plan(1), iterations(18));  // three times as many as are easy
  EXPECT_DOUBLE_EQ(control.plan(2.5).dt, 1.5);
  EXPECT_EQ(control.plan(2.5).reason, "newton effort");
  control.accepted(control.plan(2.5), iterations(3));
  EXPECT_DOUBLE_EQ(control.plan(4).dt, 2.0);
  EXPECT_EQ(control.plan(4).reason, "largest allowed");
}

TEST(StepControl, GrowsTheLessTheMoreIterationsThereAre) {
  StepControl control(adaptive(1, 10), 0, {100});
  control.accepted(control.plan(0), iterations(12));  // twice as many as are easy: half of 50 %
  EXPECT_DOUBLE_EQ(control.plan(1).dt, 1.25);
  EXPECT_EQ(control.plan(1).reason, "newton effort");
  control.accepted(control.plan(1), iterations(24));
  EXPECT_DOUBLE_EQ(control.plan(2.25).dt, 1.25);
}

TEST(StepControl, ManyIterationsShrinkTheStepButNotBelowWhatWasAsked) {
  StepControl control(adaptive(1, 10), 0, {100});
  for (int i = 0; i < 4; ++i) control.accepted(control.plan(0), iterations(3));
  ASSERT_DOUBLE_EQ(control.plan(0).dt, std::pow(1.5, 4));
  control.accepted(control.plan(0), iterations(48));  // eight times as many as are easy
  EXPECT_DOUBLE_EQ(control.plan(0).dt, std::pow(1.5, 4) / 2);
  control.accepted(control.plan(0), iterations(1000));
  EXPECT_DOUBLE_EQ(control.plan(0).dt, 1);
  control.accepted(control.plan(0), iterations(1000));
  EXPECT_DOUBLE_EQ(control.plan(0).dt, 1);
}

TEST(StepControl, AdaptiveStepsLeaveNoSliverBeforeALanding) {
  StepControl control(adaptive(1, 10), 0, {1.2});
  EXPECT_DOUBLE_EQ(control.plan(0).dt, 0.6);
}

TEST(StepControl, AStepShortenedToLandDoesNotShortenThoseBehindIt) {
  StepControl control(adaptive(1, 10), 0, {0.1, 100});
  const PlannedStep step = control.plan(0);
  EXPECT_EQ(step.reason, "output time");
  EXPECT_EQ(step.time, 0.1);
  control.accepted(step, iterations(1));
  EXPECT_DOUBLE_EQ(control.plan(0.1).dt, 1);
}

TEST(StepControl, TheStrictestLimitSetsTheStepAndGivesTheReason) {
  StepOptions options = adaptive(1, 10);
  options.limits = {
      .control = ErrorControl::predictor, .temperature = 2.0, .displacement = 1e-6, .solid_fraction = 0.1};
  const auto next = [&](const StepMeasure& measure) {
    StepControl control(options, 0, {100});
    control.accepted(control.plan(0), measure);
    return control.plan(0);
  };
  // Errors go with the square of the step, changes with the step; a fifth is kept back.
  PlannedStep step = next(
      {.iterations = 1, .temperature_error = 2.5, .displacement_error = 1e-7, .solid_fraction_change = 0.01});
  EXPECT_DOUBLE_EQ(step.dt, 0.8 * std::sqrt(2.0 / 2.5));
  EXPECT_EQ(step.reason, "temperature error");
  step = next({.iterations = 1,
               .temperature_error = 0.1,
               .displacement_error = 1.2e-6,
               .solid_fraction_change = 0.01});
  EXPECT_DOUBLE_EQ(step.dt, 0.8 * std::sqrt(1 / 1.2));
  EXPECT_EQ(step.reason, "displacement error");
  step = next(
      {.iterations = 1, .temperature_error = 0.1, .displacement_error = 1e-7, .solid_fraction_change = 0.12});
  EXPECT_DOUBLE_EQ(step.dt, 0.8 * 0.1 / 0.12);
  EXPECT_EQ(step.reason, "solid fraction");
  step = next({.iterations = 1, .stress_error = 0.02});
  EXPECT_DOUBLE_EQ(step.dt, 0.8 * std::sqrt(options.limits.stress / 0.02));
  EXPECT_EQ(step.reason, "stress error");
}

TEST(StepControl, AStepFarBeyondALimitIsRepeatedUnlessItIsTheSmallest) {
  StepOptions options = adaptive(1, 10);
  options.min_step = 0.5;
  options.limits = {ErrorControl::predictor, 1.0, 1e-6, 0.1};
  StepControl control(options, 0, {100});
  const StepMeasure good{1, 1.4, 0, 0}, bad{1, 1.6, 0, 0}, awful{1, 1e4, 0, 0};
  EXPECT_FALSE(control.too_long(control.plan(0), good));
  EXPECT_TRUE(control.too_long(control.plan(0), bad));
  control.shortened(control.plan(0), bad);
  EXPECT_DOUBLE_EQ(control.plan(0).dt, 0.8 / std::sqrt(1.6));
  EXPECT_EQ(control.plan(0).reason, "rejected: temperature error");
  control.shortened(control.plan(0), awful);
  EXPECT_DOUBLE_EQ(control.plan(0).dt, 0.5);
  EXPECT_EQ(control.plan(0).reason, "smallest allowed");
  EXPECT_FALSE(control.too_long(control.plan(0), awful));
}

TEST(StepControl, ContradictorySizesAreRefused) {
  StepOptions options = step_of(1);
  options.min_step = 2;
  EXPECT_THROW(StepControl(options, 0, {10}), std::invalid_argument);
  EXPECT_THROW(StepControl(step_of(0), 0, {10}), std::invalid_argument);
  EXPECT_THROW(StepControl(step_of(1), 10, {10}), std::invalid_argument);
}

}  // namespace
