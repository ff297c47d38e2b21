/// Bodies that burn: all of their heat and no more, whatever the steps and the rule are, and where it is hot
/// enough alone.
#include "heat/loads/exothermic.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "block.hpp"

namespace solidus {
namespace {

constexpr double k_capacity = 2.5e6;  ///< of test::metal [J/(m³ K)]
constexpr double k_heat = 4e8;        ///< [J/m³]

material::Material sleeve() {
  material::Material m = test::metal(40);
  m.phase_changes.clear();
  return m;
}

heat::ThermalConditions burning(double ignition, double duration) {
  heat::ThermalConditions conditions;
  conditions.exothermics.push_back({"burning", "block", k_heat, ignition, duration});
  return conditions;
}

TEST(BurningState, IgnitesWhereATemperatureIsPassedWithinTheStep) {
  const std::vector<double> ignition = {500, 500, HUGE_VAL, 500};
  const heat::BurningState once =
      heat::burn(heat::unlit(4), ignition, {400, 300, 400, 600}, {600, 450, 900, 600}, 10, 14);
  EXPECT_DOUBLE_EQ(once.lit[0], 12);
  EXPECT_TRUE(std::isinf(once.lit[1]));
  EXPECT_TRUE(std::isinf(once.lit[2]));
  EXPECT_DOUBLE_EQ(once.lit[3], 10);  // hot from the start
  // What is lit stays lit when it cools, and its heat has been given off up to the end of the next step.
  const heat::BurningState twice =
      heat::burn(once, ignition, {600, 450, 900, 600}, {20, 500, 20, 20}, 14, 15);
  EXPECT_DOUBLE_EQ(twice.lit[0], 12);
  EXPECT_DOUBLE_EQ(twice.released[0], 15);
  EXPECT_DOUBLE_EQ(twice.lit[1], 15);
  heat::BurningState fresh = twice;
  heat::renew({1, 0, 0, 0}, fresh);
  EXPECT_TRUE(std::isinf(fresh.lit[0]));
  EXPECT_DOUBLE_EQ(fresh.lit[1], 15);
}

struct Case {
  mesh::Shape shape;
  heat::HeatIntegration integration;
  heat::ThermalStepping stepping;
};
class Burning : public ::testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Rules, Burning,
                         ::testing::Values(Case{mesh::Shape::quad4, heat::HeatIntegration::closed,
                                                heat::ThermalStepping::sdirk2},
                                           Case{mesh::Shape::tet4, heat::HeatIntegration::closed,
                                                heat::ThermalStepping::backward_euler},
                                           Case{mesh::Shape::tri6, heat::HeatIntegration::open,
                                                heat::ThermalStepping::backward_euler}));

/// Temperatures after each of these steps, and the sum of the heat that the balances say.
struct Outcome {
  heat::ThermalState state;
  double released = 0, defect = 0;
};

Outcome burn_through(heat::ThermalPhase& phase, const Case& p, heat::ThermalState start,
                     const std::vector<double>& steps) {
  Outcome r{std::move(start)};
  heat::BurningState burnt = heat::unlit(r.state.temperature.size());
  double time = 0;
  for (const double dt : steps) {
    heat::begin_burning(phase, burnt, time, time + dt);
    const heat::ThermalState before = r.state;
    const heat::ThermalReport report =
        phase.solve(before, r.state, {.time = time + dt, .dt = dt, .stepping = p.stepping});
    burnt = heat::burnt(phase, burnt, before, r.state, time, time + dt);
    for (const heat::ConditionHeat& c : report.balance.conditions)
      if (c.name == "burning") r.released += c.heat;
    r.defect += std::abs(report.balance.defect());
    time += dt;
  }
  return r;
}

/// Temperatures follow their heat to rounding.
heat::HeatOptions options_of(const Case& p) {
  heat::HeatOptions options;
  options.integration = p.integration;
  options.tolerance = 1e-13;
  return options;
}

mesh::Mesh block(mesh::Shape shape) {
  return test::is_3d(shape) ? test::block_mesh(shape, {0.03, 0.02, 0.02}, {3, 2, 2})
                            : test::block_mesh(shape, {0.03, 0.02}, {3, 2});
}

// c ΔT = Q: from 500 K, where it ignites at once, to 660 K, in steps that fit into the 7 s of burning or not.
TEST_P(Burning, AnAdiabaticSleeveWarmsByItsHeatOverItsCapacity) {
  const Case& p = GetParam();
  const mesh::Mesh mesh = block(p.shape);
  const heat::HeatOptions options = options_of(p);
  heat::ThermalPhase phase(mesh, AnalysisKind::plane_strain, {sleeve()}, burning(500, 7), options);
  for (const std::vector<double>& steps :
       {std::vector<double>(12, 1.0), std::vector<double>{0.3, 0.9, 2.7, 8.1}, std::vector<double>{50, 50}}) {
    const Outcome r = burn_through(phase, p, phase.states().initial(std::vector<double>{500.0}), steps);
    for (const double temperature : r.state.temperature)
      EXPECT_NEAR(temperature, 500 + k_heat / k_capacity, 1e-7);
  }
}

// A body that rests at its temperature of ignition but for rounding is lit.
TEST(Burn, LightsWhatIsAtItsIgnitionButForRounding) {
  const std::vector<double> ignition{500, 500}, at{std::nextafter(500.0, 0.0), 499.9};
  const heat::BurningState state = heat::burn(heat::unlit(2), ignition, at, at, 1, 2);
  EXPECT_EQ(state.lit[0], 1);
  EXPECT_TRUE(std::isinf(state.lit[1]));
}

// Half of the duration of burning gives half of the heat.
TEST_P(Burning, HeatComesEvenly) {
  const Case& p = GetParam();
  const mesh::Mesh mesh = block(p.shape);
  const heat::HeatOptions options = options_of(p);
  heat::ThermalPhase phase(mesh, AnalysisKind::plane_strain, {sleeve()}, burning(500, 20), options);
  const Outcome r = burn_through(phase, p, phase.states().initial(std::vector<double>{500.0}), {2, 3, 5});
  for (const double temperature : r.state.temperature)
    EXPECT_NEAR(temperature, 500 + 0.5 * k_heat / k_capacity, 1e-7);
}

// A wall that is heated from one side ignites place after place; what stays cold does not burn, and all that
// does gives off the heat of its share of the volume.
TEST_P(Burning, PlacesThatStayColdKeepTheirHeat) {
  const Case& p = GetParam();
  const mesh::Mesh mesh = block(p.shape);
  const heat::HeatOptions options = options_of(p);
  const double volume = test::is_3d(p.shape) ? 0.03 * 0.02 * 0.02 : 0.03 * 0.02;
  heat::ThermalPhase cold(mesh, AnalysisKind::plane_strain, {sleeve()}, burning(2000, 5), options);
  EXPECT_EQ(burn_through(cold, p, cold.states().initial(std::vector<double>{500.0}), {1, 5, 20}).released, 0);
  heat::ThermalConditions heated = burning(600, 5);
  heated.fluxes.push_back({"burner", "x_min", 1e6});
  heat::ThermalPhase phase(mesh, AnalysisKind::plane_strain, {sleeve()}, heated, options);
  const Outcome first = burn_through(phase, p, phase.states().initial(std::vector<double>{500.0}),
                                     std::vector<double>(16, 0.5));
  EXPECT_GT(first.released, 0);
  EXPECT_LT(first.released, 0.999 * k_heat * volume);
  const Outcome all = burn_through(phase, p, phase.states().initial(std::vector<double>{500.0}),
                                   std::vector<double>(120, 0.5));
  EXPECT_NEAR(all.released, k_heat * volume, 1e-9 * k_heat * volume);
  EXPECT_LT(all.defect, 1e-6 * k_heat * volume);
}

}  // namespace
}  // namespace solidus
