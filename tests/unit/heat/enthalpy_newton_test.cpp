/// Freezing in steps of every size: the enthalpy iteration converges, conserves heat and needs few solves.
#include <gtest/gtest.h>

#include <random>

#include "block.hpp"
#include "system/errors.hpp"

namespace solidus {
namespace {

using test::block_mesh;
using test::metal;

struct Freezing {
  int worst = 0;      ///< linear solves of the worst step
  double solves = 0;  ///< mean over the steps in which anything moved
  double defect = 0;  ///< worst |defect| over the heat moved so far
  heat::ThermalState state;
};

/// A chill with h = 2000 W/(m² K) at x_min freezes the block from 901 K.
Freezing freeze(const mesh::Mesh& mesh, const material::Material& material, double dt, int steps) {
  heat::ThermalConditions conditions;
  conditions.films.push_back({"chill", "x_min", {Table(2000.0), false}, Table(300.0)});
  heat::ThermalPhase phase(mesh, AnalysisKind::plane_strain, {material}, conditions);
  Freezing run;
  run.state = phase.states().initial(std::vector<double>{901.0});
  double time = 0, moved = 0;
  int busy = 0;
  for (int i = 0; i < steps; ++i) {
    time += dt;
    const heat::ThermalReport report = phase.solve(run.state, run.state, time, dt);
    run.worst = std::max(run.worst, report.newton.iterations);
    run.solves += report.newton.iterations;
    busy += report.newton.iterations > 0 ? 1 : 0;
    moved += report.balance.exchanged;
    run.defect = std::max(run.defect, std::abs(report.balance.defect()) / moved);
  }
  run.solves /= std::max(busy, 1);
  return run;
}

class EveryStep : public testing::TestWithParam<std::tuple<double, double>> {};

TEST_P(EveryStep, ConvergesAndConservesHeatWhateverTheFreezingRange) {
  const auto [range, dt] = GetParam();
  // Up to 100 cells freeze in the first step; latent heat 280 times the sensible heat of a kelvin.
  const mesh::Mesh strip = block_mesh(mesh::Shape::quad4, {0.1, 0.001}, {100, 1});
  const mesh::Mesh plate = block_mesh(mesh::Shape::tri3, {0.1, 0.1}, {24, 24});
  for (const mesh::Mesh* mesh : {&strip, &plate}) {
    const Freezing run = freeze(*mesh, metal(range), dt, test::processes() == 1 ? 30 : 4);
    EXPECT_LE(run.defect, 1e-8);
    EXPECT_LE(run.worst, 40);
    for (double t : run.state.temperature) {
      EXPECT_GE(t, 300.0 - 1e-6);
      EXPECT_LE(t, 901.0 + 1e-6);
    }
    RecordProperty("worst", run.worst);
  }
}

INSTANTIATE_TEST_SUITE_P(RangesAndSteps, EveryStep,
                         testing::Combine(testing::Values(0.0, 1.0, 40.0),
                                          testing::Values(1e-3, 1e-1, 1.0, 10.0, 100.0, 1e4, 1e6)));

// Half of the matrix, with factors of our own, or the whole of it with PETSc's; a long step's takes the
// strong solver.
TEST(EnthalpyIteration, HalfTheMatrixGivesTheSameTemperatures) {
  for (const mesh::Shape shape : {mesh::Shape::quad4, mesh::Shape::tet4, mesh::Shape::hex8}) {
    const bool solid = test::is_3d(shape);
    const mesh::Mesh mesh =
        block_mesh(shape, std::vector<double>(solid ? 3 : 2, 0.1), std::vector<int>(solid ? 3 : 2, 8));
    const AnalysisKind kind = solid ? AnalysisKind::solid : AnalysisKind::plane_strain;
    heat::ThermalConditions conditions;
    conditions.films.push_back({"chill", "x_min", {Table(2000.0), false}, Table(300.0)});
    conditions.temperatures.push_back({"hot", "y_max", Table(901.0)});
    for (const double dt : {0.5, 20.0, 1e5}) {
      heat::ThermalState ends[2];
      std::size_t bytes[2];
      for (const bool alone : {false, true}) {
        heat::HeatOptions options;
        options.alone = alone;
        options.tolerance = 1e-9;
        heat::ThermalPhase phase(mesh, kind, {metal(20)}, conditions, options);
        heat::ThermalState state = phase.states().initial(std::vector<double>{901.0});
        for (int i = 1; i <= 3; ++i) ASSERT_TRUE(phase.solve(state, state, i * dt, dt).newton.converged);
        ends[alone] = state;
        bytes[alone] = heat::bytes(phase);
      }
      EXPECT_LT(bytes[1], bytes[0]);
      // The tolerance leaves 1e-9 of the heat moved, which is a few hundred kelvin's.
      for (std::size_t i = 0; i < ends[0].temperature.size(); ++i)
        EXPECT_NEAR(ends[1].temperature[i], ends[0].temperature[i], 1e-4) << dt;
    }
  }
}

TEST(EnthalpyIteration, NeedsAboutTwoSolvesWhileTheFrontPassesANodePerStep) {
  // A casting's usual step: 1.5 mm cells, 0.5 s; the front moves about one cell per step.
  const mesh::Mesh plate = block_mesh(mesh::Shape::tri3, {0.06, 0.0015}, {40, 1});
  const int steps = test::processes() == 1 ? 60 : 10;
  for (double range : {0.0, 1.0, 40.0})
    EXPECT_LE(freeze(plate, metal(range), 0.5, steps).solves, 3.0) << range;
}

TEST(EnthalpyIteration, ConvergesFromRandomTemperaturesOnBothSidesOfTheChange) {
  const mesh::Mesh plate = block_mesh(mesh::Shape::quad4, {0.1, 0.1}, {20, 20});
  std::mt19937 random(7);
  std::uniform_real_distribution<double> spread(300.0, 1500.0);
  for (double range : {0.0, 1.0, 40.0})
    for (double dt : {1e-3, 1.0, 1e3, 1e6}) {
      heat::ThermalPhase phase(plate, AnalysisKind::plane_strain, {metal(range)}, {});
      std::vector<double> start(plate.x.size());
      for (std::size_t i = 0; i < start.size(); ++i) {
        random.seed(static_cast<unsigned>(plate.input_node[i]));  // the same whatever the partition
        start[i] = spread(random);
      }
      const heat::ThermalState old = phase.states().initial_at_nodes(start);
      heat::ThermalState state;
      const heat::ThermalReport report = phase.solve(old, state, dt, dt);
      EXPECT_LE(std::abs(report.balance.defect()), 1e-8 * report.balance.exchanged) << range << " " << dt;
    }
}

TEST(EnthalpyIteration, ReleasesTheLatentHeatToRoundingForEveryStep) {
  if (test::processes() > 1) return;  // the serial run proves it; thousands of small steps take long on two
  const mesh::Mesh plate = block_mesh(mesh::Shape::tri3, {0.05, 0.05}, {10, 10});
  const double latent = 280 * 2500.0 * 1000.0 * 0.05 * 0.05;  // L rho V
  for (double range : {0.0, 1.0, 40.0})
    for (double dt : {0.1, 7.0, 1e3, 1e5}) {
      heat::ThermalConditions conditions;
      conditions.films.push_back({"chill", "x_min", {Table(5000.0), false}, Table(300.0)});
      heat::HeatOptions options;
      options.tolerance = 1e-12;
      heat::ThermalPhase phase(plate, AnalysisKind::plane_strain, {metal(range)}, conditions, options);
      heat::ThermalState state = phase.states().initial(std::vector<double>{950.0});
      double released = 0, stored = 0, in = 0, time = 0;
      for (int i = 0; phase.states().mean_solid_fraction(state) < 1.0 && i < 2000; ++i) {
        time += dt;
        const heat::ThermalReport report = phase.solve(state, state, time, dt);
        released -= report.balance.latent;
        stored += report.balance.stored;
        in += report.balance.heat_in();
      }
      EXPECT_NEAR(released / latent, 1.0, 1e-10) << range << " " << dt;
      EXPECT_NEAR(in / stored, 1.0, 1e-10) << range << " " << dt;  // twelve digits per step
    }
}

TEST(EnthalpyIteration, FollowsATemperatureThatIsPrescribedWithinTheChange) {
  const mesh::Mesh strip = block_mesh(mesh::Shape::quad4, {0.02, 0.001}, {20, 1});
  heat::ThermalConditions conditions;  // liquid first, then exactly the melting temperature, then cold
  conditions.temperatures.push_back({"side", "x_min", Table({0, 10, 20, 30}, {950, 900, 900, 700})});
  heat::ThermalPhase phase(strip, AnalysisKind::plane_strain, {metal(0)}, conditions);
  heat::ThermalState state = phase.states().initial(std::vector<double>{950.0});
  double stored = 0, in = 0;
  for (int i = 1; i <= 30; ++i) {
    const heat::ThermalReport report = phase.solve(state, state, i, 1.0);
    stored += report.balance.stored;
    in += report.balance.heat_in();
    if (i == 15) {
      EXPECT_EQ(phase.states().mean_solid_fraction(state), 0.0);  // nothing takes the latent heat away
    }
  }
  EXPECT_GT(phase.states().mean_solid_fraction(state), 0.01);
  EXPECT_NEAR(in, stored, 1e-8 * std::abs(stored));
}

TEST(EnthalpyIteration, ReportsAStepThatCannotConvergeWithItsPlace) {
  const mesh::Mesh strip = block_mesh(mesh::Shape::quad4, {0.02, 0.001}, {20, 1});
  heat::HeatOptions options;
  options.max_iterations = 1;
  heat::ThermalConditions conditions;
  conditions.temperatures.push_back({"side", "x_min", Table(300.0)});
  heat::ThermalPhase phase(strip, AnalysisKind::plane_strain, {metal(0)}, conditions, options);
  const heat::ThermalState old = phase.states().initial(std::vector<double>{950.0});
  heat::ThermalState trial = old;
  try {
    phase.solve(old, trial, 10.0, 10.0);
    FAIL();
  } catch (const StepRejected& rejected) {
    EXPECT_EQ(rejected.reason(), "heat: no convergence in 1 iterations");
    EXPECT_NE(rejected.where().find("node"), std::string::npos);
  }
  EXPECT_EQ(trial.enthalpy, old.enthalpy);
}

}  // namespace
}  // namespace solidus
