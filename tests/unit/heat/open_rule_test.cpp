/// The open rule freezes whatever the step, and closes its balance.
#include <gtest/gtest.h>

#include "block.hpp"

namespace solidus {
namespace {

class OpenRule : public testing::TestWithParam<std::tuple<double, double>> {};

TEST_P(OpenRule, ConvergesAndConservesHeat) {
  const auto [range, dt] = GetParam();
  const mesh::Mesh strip = test::block_mesh(mesh::Shape::quad4, {0.1, 0.002}, {50, 1});
  heat::Conditions conditions;
  conditions.films.push_back({"chill", "x_min", {Table(2000.0), false}, Table(300.0)});
  heat::HeatOptions options;
  options.integration = heat::Integration::open;
  heat::ThermalPhase phase(strip, AnalysisKind::plane_strain, {test::metal(range)}, conditions, options);
  heat::ThermalState state = phase.initial_state(std::vector<double>{901.0});
  double moved = 0, stored = 0, in = 0;
  for (int i = 1; i <= (test::processes() == 1 ? 20 : 3); ++i) {
    const heat::PhaseReport report = phase.solve(state, state, i * dt, dt);
    moved += report.balance.exchanged;
    stored += report.balance.stored;
    in += report.balance.heat_in();
    RecordProperty("iterations", report.newton.iterations);
  }
  EXPECT_NEAR(stored, in, 1e-8 * moved);
}

INSTANTIATE_TEST_SUITE_P(RangesAndSteps, OpenRule,
                         testing::Combine(testing::Values(0.0, 1.0, 40.0),
                                          testing::Values(1e-3, 0.1, 1.0, 10.0, 100.0, 1e4, 1e6)));

}  // namespace
}  // namespace solidus
