/// Adaptive steps on bodies whose exact solution is known: every node relaxes by itself,
///
///   T' = -r T,   u' = -r u,   r = 1/s,   by backward Euler,
///
/// so that a uniform body commits the local error y_n (1/(1 + rΔt) - exp(-rΔt)) in a step.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <set>
#include <utility>

#include "../mechanics/lattice.hpp"
#include "coupling/simulation.hpp"
#include "parallel/parallel.hpp"
#include "system/errors.hpp"
#include "system/log.hpp"

namespace solidus {
namespace {

using coupling::ErrorControl;
using coupling::LocalError;
using coupling::Outcome;
using coupling::RestartData;
using coupling::State;
using coupling::StepRecord;

constexpr double k_start = 100;         // [K]
constexpr double k_start_length = 2.0;  // [m]

double committed_by_backward_euler(double y, double dt) {
  return std::abs(y * (1 / (1 + dt) - std::exp(-dt)));
}

State uniform(const mesh::Mesh& mesh) {
  State state;
  state.heat.temperature.assign(mesh.x.size(), k_start);
  state.mechanics.displacement.assign(mesh.x.size() * 2, k_start_length / std::sqrt(2.0));
  return state;
}

double solid_fraction_of(const State& state) {
  return 1 - state.heat.temperature.front() / k_start;
}

/// Calls that the fake schemes have received, and their scripted behaviour.
struct Script {
  std::set<int> fail_at;             ///< calls of advance() that are rejected, from 1
  double jump_at = 1e300, jump = 0;  ///< a load that all nodes follow at once [s], [K]
  int iterations = 3;
  int calls = 0, synchronised = 0;
  std::vector<State> starts;  ///< the `old` of every call
};

class Relaxation : public coupling::CouplingScheme {
 public:
  explicit Relaxation(Script& script) : script_(script) {}
  void synchronise(const State&) override { ++script_.synchronised; }
  void forget() override {}
  coupling::StepEffort advance(const State& old, State& trial, double time, double dt) override {
    script_.starts.push_back(old);
    for (double& v : trial.heat.temperature) v = std::nan("");  // a trial that is left behind is no state
    if (script_.fail_at.contains(++script_.calls)) throw StepRejected("heat: as the script says", "");
    const auto relax = [dt](const std::vector<double>& from, std::vector<double>& to) {
      for (std::size_t i = 0; i < from.size(); ++i) to[i] = from[i] / (1 + dt);
    };
    relax(old.heat.temperature, trial.heat.temperature);
    relax(old.mechanics.displacement, trial.mechanics.displacement);
    if (old.time < script_.jump_at && time >= script_.jump_at)
      for (double& v : trial.heat.temperature) v += script_.jump;
    trial.time = time;
    coupling::StepEffort effort;
    effort.heat.iterations = script_.iterations;
    effort.solid_fraction = solid_fraction_of(trial);
    return effort;
  }

 private:
  Script& script_;
};

struct Diary : coupling::Observer {
  std::vector<StepRecord> steps;
  std::vector<State> states;
  std::vector<std::pair<RestartData, State>> checkpoints;
  void begin(const State& state) override { states.push_back(state); }
  void step(const StepRecord& record, const State& state) override {
    steps.push_back(record);
    states.push_back(state);
  }
  void checkpoint(const RestartData& continuation, const State& state) override {
    checkpoints.emplace_back(continuation, state);
  }
  void stopped(const coupling::Stop&, const State&) override {}
  void end(const State&) override {}
  int rejected() const {
    int sum = 0;
    for (const StepRecord& s : steps) sum += s.rejected;
    return sum;
  }
};

class Adaptive : public ::testing::TestWithParam<ErrorControl> {
 protected:
  const mesh::Mesh mesh_ = test::make_mesh(
      {.shape = mesh::Shape::quad4, .cells = {4, 3, 1}, .size = {2, 1, 1}, .distortion = 0.1});
  Script script_;
  Diary diary_;

  /// Bounded by the temperature alone unless a test says otherwise.
  coupling::TimeOptions options(double temperature_error = 0.2) const {
    coupling::TimeOptions o;
    o.end = 8;
    o.output_times = {1, 2.5};
    o.step.step = 0.5;
    o.step.adaptive = true;
    o.step.limits = {GetParam(), temperature_error, 1e9, 1e9};
    return o;
  }
  Outcome run(const coupling::TimeOptions& o) {
    coupling::Simulation simulation(
        std::make_unique<Relaxation>(script_), o,
        coupling::ErrorEstimate(coupling::BodyNorm(mesh_, AnalysisKind::plane_strain)));
    simulation.add(diary_);
    return simulation.run(uniform(mesh_), &solid_fraction_of);
  }
  double before(std::size_t step) const { return diary_.states[step].heat.temperature.front(); }
};

TEST_P(Adaptive, TheEstimateIsTheErrorThatAStepCommits) {
  run(options());
  // Doubling keeps the halves, each of which commits a quarter: half the error together.
  const double share = GetParam() == ErrorControl::doubling ? 0.5 : 1.0;
  for (std::size_t n = 1; n < diary_.steps.size(); ++n) {
    const double exact = share * committed_by_backward_euler(before(n), diary_.steps[n].dt);
    // The part that the estimate neglects is of third order in the step.
    EXPECT_NEAR(diary_.steps[n].temperature_error, exact, diary_.steps[n].dt * exact) << "step " << n + 1;
  }
}

TEST_P(Adaptive, TheErrorOfEveryStepStaysWithinTheTolerance) {
  for (const double tolerance : {1.0, 0.2, 0.02}) {
    script_ = {}, diary_ = {};
    ASSERT_EQ(run(options(tolerance)), Outcome::finished);
    for (std::size_t n = 0; n < diary_.steps.size(); ++n) {
      EXPECT_LE(diary_.steps[n].temperature_error, 1.5 * tolerance);
      EXPECT_LE(committed_by_backward_euler(before(n), diary_.steps[n].dt), 3.0 * tolerance);
    }
  }
}

TEST_P(Adaptive, AHundredthOfTheToleranceTakesTenTimesTheSteps) {
  run(options(0.5));
  const auto few = static_cast<double>(diary_.steps.size());
  script_ = {}, diary_ = {};
  run(options(0.005));
  const auto many = static_cast<double>(diary_.steps.size());
  // The local error is of second order; landings and the first steps blur the few.
  EXPECT_GT(many / few, 6.5);
  EXPECT_LT(many / few, 11);
}

TEST_P(Adaptive, FewerStepsThanEqualOnesOfTheSameLocalError) {
  run(options(0.02));
  double worst = 0;
  for (std::size_t n = 0; n < diary_.steps.size(); ++n)
    worst = std::max(worst, committed_by_backward_euler(before(n), diary_.steps[n].dt));
  const double equal_step = std::sqrt(2 * worst / k_start);  // ½ Δt² T'' at the start
  EXPECT_LT(static_cast<double>(diary_.steps.size()), 0.5 * 8 / equal_step);
}

TEST_P(Adaptive, OutputTimesAreMetExactly) {
  run(options());
  std::set<double> times;
  for (const StepRecord& s : diary_.steps) times.insert(s.time);
  for (const double landing : {1.0, 2.5, 8.0}) EXPECT_TRUE(times.contains(landing)) << landing;
  for (const StepRecord& s : diary_.steps)
    EXPECT_EQ(s.output, s.time == 1.0 || s.time == 2.5 || s.time == 8.0) << s.time;
}

TEST_P(Adaptive, EveryStepSaysWhyItHasItsSize) {
  run(options());
  std::set<std::string> reasons;
  for (const StepRecord& s : diary_.steps) {
    EXPECT_FALSE(s.reason.empty());
    reasons.insert(s.reason);
  }
  EXPECT_EQ(diary_.steps.front().reason, "rejected: temperature error");  // half a second is too long
  EXPECT_GT(diary_.steps.front().rejected, 0);
  EXPECT_EQ(diary_.steps.front().rejection.rfind("temperature error ", 0), 0U);
  EXPECT_TRUE(reasons.contains("temperature error"));
  EXPECT_TRUE(reasons.contains("output time") || reasons.contains("output time ahead"));
}

TEST_P(Adaptive, DisplacementAndSolidFractionBoundTheStepToo) {
  coupling::TimeOptions o = options(1e9);
  o.step.limits.displacement = 0.002;
  run(o);
  for (const StepRecord& s : diary_.steps) EXPECT_LE(s.displacement_error, 3 * 0.002);
  EXPECT_TRUE(std::any_of(diary_.steps.begin(), diary_.steps.end(),
                          [](const StepRecord& s) { return s.reason == "displacement error"; }));

  script_ = {}, diary_ = {};
  o.step.limits = {ErrorControl::none, 1e9, 1e9, 0.05};
  run(o);
  double fraction = 0;
  for (const StepRecord& s : diary_.steps) {
    EXPECT_LE(s.solid_fraction - fraction, 1.5 * 0.05);
    fraction = s.solid_fraction;
  }
  EXPECT_TRUE(std::any_of(diary_.steps.begin(), diary_.steps.end(),
                          [](const StepRecord& s) { return s.reason == "solid fraction"; }));
}

TEST_P(Adaptive, ARepeatedStepStartsFromTheSameBits) {
  script_.fail_at = {6, 7, 15, 23};
  ASSERT_EQ(run(options(0.05)), Outcome::finished);
  EXPECT_GE(diary_.rejected(), 4);
  // Every call but that of the second half of a doubled step starts from a committed state.
  for (const State& start : script_.starts) {
    const bool committed = std::any_of(diary_.states.begin(), diary_.states.end(), [&](const State& s) {
      return s.time == start.time && s.heat.temperature == start.heat.temperature &&
             s.mechanics.displacement == start.mechanics.displacement;
    });
    const bool half = std::none_of(diary_.states.begin(), diary_.states.end(),
                                   [&](const State& s) { return s.time == start.time; });
    EXPECT_TRUE(committed || half) << "t = " << start.time;
  }
  // Quantities that follow from the state were restored each time.
  EXPECT_GE(script_.synchronised, 1 + diary_.rejected());
}

TEST_P(Adaptive, RejectionsLeaveNoTraceInWhatFollows) {
  // Steps that the limits do not bound: the same steps with and without a rejection between them.
  coupling::TimeOptions o = options(1e9);
  o.step.max_step = o.step.step;
  o.step.cut = 0.5;
  run(o);
  const State undisturbed = diary_.states.at(1);
  script_ = {}, diary_ = {};
  script_.fail_at = {1};
  o.step.step = o.step.max_step = 1.0;  // cut to the half second of the first run
  run(o);
  EXPECT_EQ(diary_.steps.front().reason, "rejected: heat: as the script says");
  EXPECT_EQ(diary_.states.at(1).time, undisturbed.time);
  EXPECT_EQ(diary_.states.at(1).heat.temperature, undisturbed.heat.temperature);
}

TEST_P(Adaptive, GoesOnFromACheckpointWithTheSameBits) {
  coupling::TimeOptions o = options(0.05);
  o.checkpoint_every = 1;
  run(o);
  const Diary whole = diary_;
  ASSERT_GT(whole.checkpoints.size(), 10U);
  for (const std::size_t k : {0U, 3U, 9U}) {
    script_ = {}, diary_ = {};
    coupling::Simulation simulation(
        std::make_unique<Relaxation>(script_), o,
        coupling::ErrorEstimate(coupling::BodyNorm(mesh_, AnalysisKind::plane_strain)));
    simulation.add(diary_);
    const auto& [continuation, state] = whole.checkpoints[k];
    simulation.run(state, &solid_fraction_of, continuation);
    ASSERT_EQ(diary_.steps.size() + k + 1, whole.steps.size());
    for (std::size_t n = 0; n < diary_.steps.size(); ++n) {
      EXPECT_EQ(diary_.steps[n].time, whole.steps[n + k + 1].time);
      EXPECT_EQ(diary_.steps[n].reason, whole.steps[n + k + 1].reason);
      EXPECT_EQ(diary_.steps[n].temperature_error, whole.steps[n + k + 1].temperature_error);
    }
    EXPECT_EQ(diary_.states.back().heat.temperature, whole.states.back().heat.temperature);
  }
}

TEST_P(Adaptive, AJumpThatNoStepResolvesIsTakenWithAWarningAndSlowsNothingBehindIt) {
  logging::clear_warnings();
  const auto level = logging::level();
  logging::set_level(logging::Level::silent);
  coupling::TimeOptions o = options(0.2);
  script_.jump_at = 4.0;
  script_.jump = 50;
  EXPECT_EQ(run(o), Outcome::finished);
  const auto jump = std::find_if(diary_.steps.begin(), diary_.steps.end(),
                                 [](const StepRecord& s) { return s.time >= 4.0; });
  const bool predicted = GetParam() == ErrorControl::predictor;  // doubling finds it in whole and halves
  EXPECT_EQ(jump->temperature_error > 20, predicted);
  EXPECT_EQ(jump->rejected > 0, predicted);
  EXPECT_LT(diary_.rejected(), 30);
  EXPECT_EQ((jump + 1)->reason.find("smallest"), std::string::npos);
  EXPECT_LT((jump + 1)->temperature_error, 0.3);
  ASSERT_EQ(logging::warnings().size(), predicted ? 1U : 0U);
  if (predicted) {
    EXPECT_NE(logging::warnings().front().find("temperature error"), std::string::npos);
  }
  logging::set_level(level);
  logging::clear_warnings();
}

TEST_P(Adaptive, AStateThatIsNotANumberIsNeverCommitted) {
  script_.jump_at = 4.0;
  script_.jump = std::nan("");
  EXPECT_EQ(run(options()), Outcome::stuck);
  EXPECT_LT(diary_.steps.back().time, 4.0);
  for (const State& state : diary_.states) EXPECT_TRUE(std::isfinite(state.heat.temperature.front()));
}

INSTANTIATE_TEST_SUITE_P(By, Adaptive, ::testing::Values(ErrorControl::predictor, ErrorControl::doubling),
                         [](const auto& instance) {
                           return instance.param == ErrorControl::predictor ? "Predictor" : "Doubling";
                         });

TEST_P(Adaptive, AStepThatIsDiscardedLeavesNoTraceInARunThatIsDrivenFromOutside) {
  const coupling::TimeOptions o = options(0.05);
  ASSERT_EQ(run(o), Outcome::finished);
  const Diary whole = diary_;
  script_ = {}, diary_ = {};
  coupling::Simulation simulation(
      std::make_unique<Relaxation>(script_), o,
      coupling::ErrorEstimate(coupling::BodyNorm(mesh_, AnalysisKind::plane_strain)));
  simulation.add(diary_);
  simulation.begin(uniform(mesh_), &solid_fraction_of);
  std::optional<Outcome> outcome;
  while (!(outcome = simulation.take_step())) {
    const std::size_t known = diary_.steps.size();
    ASSERT_TRUE(simulation.present().pending);
    EXPECT_EQ(simulation.present().state.time, simulation.present().record.time);
    if (known % 3 == 1) {  // observers have not heard of the step: take it again, as it was
      simulation.discard_step();
      ASSERT_FALSE(simulation.present().pending);
      EXPECT_EQ(simulation.present().state.time, diary_.states.back().time);
      ASSERT_FALSE(simulation.take_step());
      EXPECT_EQ(simulation.present().record.rejected, whole.steps[known].rejected + 1);
      EXPECT_EQ(simulation.present().record.rejection, "repeated as asked");
    }
    ASSERT_EQ(diary_.steps.size(), known);
    simulation.commit_step();
    ASSERT_EQ(diary_.steps.size(), known + 1);
  }
  EXPECT_EQ(*outcome, Outcome::finished);
  EXPECT_EQ(simulation.take_step(), Outcome::finished);  // and again
  ASSERT_EQ(diary_.steps.size(), whole.steps.size());
  for (std::size_t n = 0; n < diary_.states.size(); ++n) {
    EXPECT_EQ(diary_.states[n].time, whole.states[n].time);
    EXPECT_EQ(diary_.states[n].heat.temperature, whole.states[n].heat.temperature);
  }
}

TEST(Simulation, AdaptiveStepsWithoutAnEstimateAreAProgrammersMistake) {
  Script script;
  coupling::TimeOptions o;
  o.end = 1;
  o.step.adaptive = true;
  o.step.limits.control = ErrorControl::predictor;
  EXPECT_THROW(coupling::Simulation(std::make_unique<Relaxation>(script), o), std::invalid_argument);
}

}  // namespace
}  // namespace solidus
