/// The open rule freezes whatever the step, and closes its balance.
#include <gtest/gtest.h>

#include "../contact/bodies.hpp"
#include "block.hpp"

namespace solidus {
namespace {

class OpenRule : public testing::TestWithParam<std::tuple<double, double>> {};

TEST_P(OpenRule, ConvergesAndConservesHeat) {
  const auto [range, dt] = GetParam();
  const mesh::Mesh strip = test::block_mesh(mesh::Shape::quad4, {0.1, 0.002}, {50, 1});
  heat::ThermalConditions conditions;
  conditions.films.push_back({"chill", "x_min", {Table(2000.0), false}, Table(300.0)});
  heat::HeatOptions options;
  options.integration = heat::HeatIntegration::open;
  heat::ThermalPhase phase(strip, AnalysisKind::plane_strain, {test::metal(range)}, conditions, options);
  heat::ThermalState state = phase.states().initial(std::vector<double>{901.0});
  double moved = 0, stored = 0, in = 0;
  for (int i = 1; i <= (test::processes() == 1 ? 20 : 3); ++i) {
    const heat::ThermalReport report = phase.solve(state, state, i * dt, dt);
    moved += report.balance.exchanged;
    stored += report.balance.stored;
    in += report.balance.heat_in();
    RecordProperty("iterations", report.newton.iterations);
  }
  EXPECT_NEAR(stored, in, 1e-8 * moved);
}

/// Nodes freeze at the very temperature of an isothermal change, whatever the rule.
TEST(OpenRuleBesides, HoldsAnIsothermalChangeAtItsTemperature) {
  const mesh::Mesh strip = test::block_mesh(mesh::Shape::quad4, {0.1, 0.002}, {50, 1});
  heat::ThermalConditions conditions;
  conditions.films.push_back({"chill", "x_min", {Table(2000.0), false}, Table(300.0)});
  heat::HeatOptions options;
  options.integration = heat::HeatIntegration::open;
  heat::ThermalPhase phase(strip, AnalysisKind::plane_strain, {test::metal(0)}, conditions, options);
  heat::ThermalState state = phase.states().initial(std::vector<double>{901.0});
  int freezing = 0;
  for (int i = 1; i <= 20; ++i) {
    phase.solve(state, state, i, 1.0);
    const std::vector<double> fraction = phase.states().solid_fraction(state);
    for (std::size_t node = 0; node < fraction.size(); ++node) {
      if (fraction[node] == 0) {
        EXPECT_GE(state.temperature[node], 900);
      }
      if (fraction[node] == 1) {
        EXPECT_LE(state.temperature[node], 900);
      }
      if (fraction[node] == 0 || fraction[node] == 1) continue;
      ++freezing;
      EXPECT_EQ(state.temperature[node], 900);
    }
  }
  EXPECT_TRUE(parallel::any_process(freezing > 0));
}

/// A body next to another one, unconnected: it stores its heat at Gauss points as before when the other one
/// has an isothermal change and the unknown is the enthalpy of the nodes.
TEST(OpenRuleBesides, StoresOtherBodiesAtGaussPointsBesideOneThatFreezesIsothermally) {
  for (const mesh::Shape shape : {mesh::Shape::quad4, mesh::Shape::tri6, mesh::Shape::hex8})
    for (const auto stepping : {heat::ThermalStepping::backward_euler, heat::ThermalStepping::sdirk2}) {
      for (const double dt : {0.2, 2.0, 20.0, 100.0}) {
        const mesh::Mesh mesh = test::two_blocks(shape, 0.01);
        heat::ThermalConditions conditions;
        for (const char* side : {"lower_x_min", "upper_x_min"})
          conditions.films.push_back({side, side, {Table(2000.0), false}, Table(300.0)});
        conditions.sources.push_back({"source", "lower", Table(-1e6)});
        heat::HeatOptions options;
        options.integration = heat::HeatIntegration::open;
        options.tolerance = 1e-12;
        options.solver = linear::SolverKind::direct;
        const AnalysisKind kind = test::is_3d(shape) ? AnalysisKind::solid : AnalysisKind::plane_strain;
        std::vector<std::vector<double>> lower;
        for (const double range : {0.0, 20.0}) {
          heat::ThermalPhase phase(mesh, kind, {test::metal(40), test::metal(range)}, conditions, options);
          heat::ThermalState state = phase.states().initial(std::vector<double>{905.0, 905.0});
          EXPECT_EQ(state.enthalpy.empty(), range > 0);
          for (int i = 1; i <= 5; ++i) {
            const heat::ThermalReport report =
                phase.solve(state, state, {.time = dt * i, .dt = dt, .stepping = stepping});
            EXPECT_NEAR(report.balance.stored, report.balance.heat_in(), 1e-10 * report.balance.exchanged);
          }
          std::vector<double>& temperature = lower.emplace_back();
          for (const mesh::ElementBlock& block : mesh.blocks)
            if (block.body == 0)
              for (const Index node : block.nodes)
                temperature.push_back(state.temperature[static_cast<std::size_t>(node)]);
        }
        for (std::size_t i = 0; i < lower[0].size(); ++i) EXPECT_NEAR(lower[0][i], lower[1][i], 1e-7) << dt;
      }
    }
}

INSTANTIATE_TEST_SUITE_P(RangesAndSteps, OpenRule,
                         testing::Combine(testing::Values(0.0, 1.0, 40.0),
                                          testing::Values(1e-3, 0.1, 1.0, 10.0, 100.0, 1e4, 1e6)));

}  // namespace
}  // namespace solidus
