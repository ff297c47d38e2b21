/// A step whose heat is beyond its limit ends before deformation is solved.
#include "coupling/measured_step.hpp"

#include <gtest/gtest.h>

#include "../mechanics/lattice.hpp"
#include "coupling/simulation.hpp"

namespace solidus {
namespace {

using coupling::State;

constexpr double k_rate = 50;      ///< of heating [K/s]
constexpr double k_by_work = 0.5;  ///< what deformation warms in a step [K]

/// Heats all nodes at a rate that jumps once, then deforms and warms them a little.
class HeatThenDeform final : public coupling::CouplingScheme {
 public:
  double jump_at = 1e300;    ///< [s], from when on the rate is twice as large
  int heats = 0, forms = 0;  ///< phases solved

  void synchronise(const State&) override {}
  void forget() override {}
  coupling::StepEffort advance(const State& old, State& trial, double time, double dt) override {
    return *advance_unless(old, trial, time, dt, {});
  }
  std::optional<coupling::StepEffort> advance_unless(const State& old, State& trial, double time, double dt,
                                                     const coupling::HeatJudge& stop) override {
    ++heats;
    State warm = old;
    for (double& v : warm.heat.temperature) v += dt * k_rate * (old.time >= jump_at ? 2 : 1);
    if (stop && stop(warm, {})) return {};
    ++forms;
    trial = warm;
    trial.time = time;
    for (double& v : trial.heat.temperature) v += k_by_work;
    return coupling::StepEffort{};
  }
};

struct Body {
  mesh::Mesh mesh = test::make_mesh({.shape = mesh::Shape::quad4, .cells = {2, 2, 1}, .size = {1, 1, 1}});
  HeatThenDeform scheme;
  coupling::ErrorEstimate estimate{coupling::BodyNorm(mesh, AnalysisKind::plane_strain)};

  State start() const {
    State state;
    state.heat.temperature.assign(mesh.x.size(), 300);
    state.mechanics.displacement.assign(mesh.x.size() * 2, 0);
    return state;
  }
};

TEST(MeasuredStep, AStepThatIsTooLongByItsHeatCostsNoMechanics) {
  Body body;
  coupling::Rates rates;
  rates.temperature.assign(body.mesh.x.size(), k_rate);
  rates.displacement.assign(body.mesh.x.size() * 2, 0);
  coupling::MeasuredStep step(body.scheme, coupling::ErrorControl::predictor, body.estimate, rates);
  State old = body.start(), trial;
  const auto beyond_one_kelvin = [](const coupling::LocalError& e) { return e.temperature > 1; };

  // As predicted. What deformation warms is no error of the integration in time.
  coupling::MeasuredStep::Taken taken = step.take(old, trial, 0.1, 0.1, beyond_one_kelvin);
  ASSERT_TRUE(taken.effort);
  EXPECT_NEAR(taken.error.temperature, 0, 1e-12);
  EXPECT_EQ(body.scheme.forms, 1);

  // Twice the rate that was predicted: half of dt × rate is left.
  body.scheme.jump_at = 0;
  taken = step.take(old, trial, 0.1, 0.1, beyond_one_kelvin);
  EXPECT_FALSE(taken.effort);
  EXPECT_NEAR(taken.error.temperature, 0.5 * 0.1 * k_rate, 1e-12);
  EXPECT_EQ(body.scheme.heats, 2);
  EXPECT_EQ(body.scheme.forms, 1) << "deformation was solved for a step that is repeated";
}

struct Diary : coupling::Observer {
  std::vector<coupling::StepRecord> steps;
  void begin(const State&) override {}
  void step(const coupling::StepRecord& record, const State&) override { steps.push_back(record); }
  void stopped(const coupling::Stop&, const State&) override {}
  void end(const State&) override {}
};

TEST(MeasuredStep, ARunCountsSuchTriesApart) {
  Body body;
  auto scheme = std::make_unique<HeatThenDeform>();
  HeatThenDeform& counted = *scheme;
  counted.jump_at = 1;
  coupling::TimeOptions options;
  options.end = 3;
  options.step.step = 0.25;
  options.step.adaptive = true;
  options.step.limits = {coupling::ErrorControl::predictor, 2, 1e9, 1e9};
  coupling::Simulation simulation(std::move(scheme), options, body.estimate);
  Diary diary;
  simulation.add(diary);
  simulation.run(body.start(), [](const State&) { return 1.0; });
  int rejected = 0, shortened = 0;
  for (const coupling::StepRecord& s : diary.steps) rejected += s.rejected, shortened += s.shortened;
  EXPECT_EQ(rejected, 0);
  ASSERT_GT(shortened, 0);
  // Where no rate predicts a step it is doubled: two solutions of each phase more.
  EXPECT_EQ(counted.heats - counted.forms, shortened);
  const auto jump = std::find_if(diary.steps.begin(), diary.steps.end(),
                                 [](const coupling::StepRecord& s) { return s.shortened > 0; });
  EXPECT_EQ(jump->reason, "shortened: temperature error");
  EXPECT_NE(jump->rejection.find("temperature error"), std::string::npos) << jump->rejection;
}

}  // namespace
}  // namespace solidus
