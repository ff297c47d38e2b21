/// Steps whose temperatures cannot follow from those at their start are given up and cut.
#include "coupling/guarded_scheme.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "../heat/block.hpp"
#include "coupling/simulation.hpp"
#include "system/errors.hpp"

namespace solidus {
namespace {

using coupling::State;
using ::testing::HasSubstr;

/// Warms every node by one kelvin a second; in steps longer than `true_up_to` it finds another solution.
class TwoRoots final : public coupling::CouplingScheme {
 public:
  TwoRoots(double true_up_to, double false_change) : true_up_to_(true_up_to), false_change_(false_change) {}
  void synchronise(const State&) override {}
  void forget() override {}
  coupling::StepEffort advance(const State& old, State& trial, double time, double dt) override {
    trial = old;
    trial.time = time;
    for (double& t : trial.heat.temperature) t += dt > true_up_to_ ? false_change_ : dt;
    return {};
  }

 private:
  double true_up_to_, false_change_;
};

class Guard : public ::testing::Test {
 protected:
  Guard() {
    phases_.heat = &phase_;
    start_.heat = phase_.states().initial(std::vector<double>{500});
    start_.heat.temperature.front() = 600;  // the range of what follows is 100 K
  }
  std::unique_ptr<coupling::CouplingScheme> guarded(double true_up_to, double false_change) const {
    return std::make_unique<coupling::GuardedScheme>(std::make_unique<TwoRoots>(true_up_to, false_change),
                                                     phases_);
  }

  mesh::Mesh mesh_ = test::block_mesh(mesh::Shape::quad4, {1, 1}, {3, 3});
  heat::ThermalPhase phase_{mesh_, AnalysisKind::plane_strain, {test::metal(50)}, {}};
  coupling::Phases phases_;
  State start_;
};

TEST_F(Guard, LetsTemperaturesPassThatIntegrationInSpaceMayOvershootBy) {
  State trial;
  EXPECT_NO_THROW(guarded(0, 109)->advance(start_, trial, 1, 1));  // 100 K, and 10 K
  EXPECT_NO_THROW(guarded(0, -109)->advance(start_, trial, 1, 1));
}

TEST_F(Guard, RejectsWhatDoesNotFollowAndNamesTheRange) {
  for (const double change : {111.0, 2700.0, -111.0}) {
    State trial;
    try {
      guarded(0, change)->advance(start_, trial, 1, 1);
      ADD_FAILURE() << "a change by " << change << " K passed";
    } catch (const StepRejected& rejected) {
      EXPECT_THAT(rejected.reason(), HasSubstr("226.9 to 326.9 degC")) << rejected.reason();
      EXPECT_THAT(rejected.where(), HasSubstr("node"));
    }
  }
}

TEST_F(Guard, CutsTheStepUntilTheSolutionIsTheOneThatContinuesTheStart) {
  coupling::TimeOptions times;
  times.end = 8;
  times.step.step = 2;
  times.step.min_step = 0.01;
  coupling::Simulation simulation(guarded(0.3, 2700), times);
  struct Watch final : coupling::Observer {
    double highest = 0;
    int rejected = 0;
    void begin(const State&) override {}
    void step(const coupling::StepRecord& record, const State& state) override {
      rejected += record.rejected;
      for (const double t : state.heat.temperature) highest = std::max(highest, t);
    }
    void stopped(const coupling::Stop&, const State&) override {}
    void end(const State&) override {}
  } watch;
  simulation.add(watch);
  EXPECT_EQ(simulation.run(start_, [](const State&) { return 1.0; }), coupling::Outcome::finished);
  EXPECT_NEAR(watch.highest, 608, 1e-9);
  EXPECT_GE(watch.rejected, 3);
}

}  // namespace
}  // namespace solidus
