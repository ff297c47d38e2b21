/// The nonlinear solver of the thermal phase where the nodes hold the heat: how many iterations a step takes
/// on any mesh, and that no heat is lost whatever the tolerance.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "block.hpp"

namespace solidus {
namespace {

struct Freezing {
  double mean = 0;    ///< iterations a step
  int worst = 0;      ///< iterations of the worst step
  double defect = 0;  ///< worst |stored − heat in| of a step over the heat exchanged in it
  heat::ThermalState state;
};

/// An aluminium alloy with 7 % silicon: Scheil's equation down to its eutectic, which takes half of the
/// latent heat at one temperature, and a conductivity that halves on melting.
material::Material alloy() {
  material::Material m;
  m.name = "alloy";
  m.density = 2685;
  m.conductivity = Table({298, 823, 850, 887}, {159, 150, 145, 65});
  m.specific_heat = Table({373, 850}, {963, 1160});
  m.phase_changes = {
      {"solidification", material::PhaseFraction::scheil(933, 887, 850, 0.13), 3.89e5, 0.0, true}};
  return m;
}

/// The same latent heat over another range below 887 K; zero: at one temperature.
material::Material with_range(double range) {
  material::Material m = alloy();
  m.phase_changes[0].fraction = material::PhaseFraction::linear(887 - range, 887);
  return m;
}

/// A cube of 100 mm freezes in films of 3000 W/(m² K) on two of its faces.
Freezing freeze(const material::Material& material, int divisions, double dt, int steps, double tolerance = 0,
                double start = 973, mesh::Shape shape = mesh::Shape::tet4) {
  const mesh::Mesh mesh = test::block_mesh(shape, {0.1, 0.1, 0.1}, {divisions, divisions, divisions});
  heat::ThermalConditions conditions;
  conditions.films.push_back({"chill_x", "x_max", {Table(3000.0), false}, Table(293.0)});
  conditions.films.push_back({"chill_y", "y_max", {Table(3000.0), false}, Table(293.0)});
  heat::HeatOptions options;
  options.tolerance = tolerance;
  options.alone = true;
  heat::ThermalPhase phase(mesh, AnalysisKind::solid, {material}, conditions, options);
  Freezing run;
  run.state = phase.states().initial(std::vector<double>{start});
  for (int i = 1; i <= steps; ++i) {
    const heat::ThermalReport report = phase.solve(run.state, run.state, i * dt, dt);
    run.mean += static_cast<double>(report.newton.iterations) / steps;
    run.worst = std::max(run.worst, report.newton.iterations);
    run.defect = std::max(run.defect, std::abs(report.balance.defect()) / report.balance.exchanged);
  }
  return run;
}

TEST(TruncatedNewton, TakesFiveIterationsAStepForAnAlloyOnEveryMesh) {
  if (test::processes() > 1) return;  // the same problem as in the other tests, larger
  const Freezing coarse = freeze(alloy(), 10, 2, 10), fine = freeze(alloy(), 20, 2, 10);
  EXPECT_LE(coarse.mean, 5.0);
  EXPECT_LE(fine.mean, 5.0);
  EXPECT_LE(fine.worst, 9);
  RecordProperty("coarse", std::to_string(coarse.mean));
  RecordProperty("fine", std::to_string(fine.mean));
}

/// A layer of the cube, which freezes as the cube does, by two stages and steps of 2 s; iterations a step.
double freeze_layer(int divisions, int steps) {
  const mesh::Mesh layer =
      test::block_mesh(mesh::Shape::tet4, {0.1, 0.1, 0.1 / divisions}, {divisions, divisions, 1});
  heat::ThermalConditions conditions;
  conditions.films.push_back({"chill_x", "x_max", {Table(3000.0), false}, Table(293.0)});
  conditions.films.push_back({"chill_y", "y_max", {Table(3000.0), false}, Table(293.0)});
  heat::HeatOptions options;
  options.alone = true;
  options.stepping = heat::ThermalStepping::sdirk2;
  heat::ThermalPhase phase(layer, AnalysisKind::solid, {alloy()}, conditions, options);
  heat::ThermalState state = phase.states().initial(std::vector<double>{973.0});
  double mean = 0;
  for (int i = 1; i <= steps; ++i) {
    const heat::ThermalReport report =
        phase.solve(state, state, {.time = 2.0 * i, .dt = 2, .stepping = options.stepping.value()});
    mean += static_cast<double>(report.newton.iterations) / steps;
  }
  ::testing::Test::RecordProperty("mean", std::to_string(mean));
  return mean;
}

// Sweeps over the nodes of the front alone find out which of them freeze. Without them it takes nine
// iterations a step, and sixteen in the worst.
TEST(TruncatedNewton, TakesSixIterationsForTwoStagesOnAFineMesh) {
  if (test::processes() > 1) return;  // the serial run proves it
  EXPECT_LE(freeze_layer(60, 8), 6.5);
}

// Linear systems near the solution are solved as far as the iteration goes: 5.4 iterations a step. Where they
// go only as far as the last iteration lets expect, 6.1.
TEST(TruncatedNewton, LosesNoIterationsToItsLinearSystemsNearTheSolution) {
  if (test::processes() > 1) return;  // the serial run proves it
  EXPECT_LE(freeze_layer(70, 20), 5.8);
}

// The materials and steps on which a tangent is worst: the front passes a third of the cube in one step, all
// that freezes freezes at one temperature or nearly so, melt that starts at the very end of a plateau, and a
// conductivity that jumps with the phase, either way.
TEST(TruncatedNewton, TakesAtMostTwelveIterationsForSteepCurvesAndLongSteps) {
  constexpr int n = 12;
  int worst = 0;
  double mean = 0;
  constexpr int k_problems = 72;
  for (const double dt : {0.2, 2.0, 20.0, 2e3})
    for (const double range : {0.0, 1.0, 37.0})
      for (const double liquid : {65.0, 14.5, 1450.0}) {
        material::Material m = with_range(range);
        m.conductivity = Table({298, 886, 888}, {159, 145, liquid});
        for (const double start : {973.0, 887.0}) {
          const Freezing run = freeze(m, n, dt, 3, 0, start);
          EXPECT_LE(run.worst, 12) << dt << " s, range " << range << " K, k " << liquid << ", " << start;
          worst = std::max(worst, run.worst);
          mean += run.mean / k_problems;
        }
      }
  RecordProperty("worst", worst);
  RecordProperty("mean", std::to_string(mean));
}

// 1000 cells of 0.1 mm, of which hundreds freeze in one step of 10 s: at one temperature or nearly so, melt
// that starts above that temperature or at it, a front that runs against the numbering of the nodes, and a
// conductivity that jumps tenfold on melting, either way.
TEST(TruncatedNewton, FollowsAFrontThroughHundredsOfCellsInOneStep) {
  if (test::processes() > 1) return;  // the serial run proves it
  const mesh::Mesh strip = test::block_mesh(mesh::Shape::quad4, {0.1, 0.001}, {1000, 1});
  const auto follow = [&](double range, double start, double liquid, const char* side) {
    material::Material metal = test::metal(range);
    metal.conductivity = Table({300, 899, 901}, {100, 100, liquid});
    heat::ThermalConditions conditions;
    conditions.temperatures.push_back({"chill", side, Table(300.0)});
    heat::ThermalPhase phase(strip, AnalysisKind::plane_strain, {metal}, conditions);
    heat::ThermalState state = phase.states().initial(std::vector<double>{start});
    int worst = 0;
    double mean = 0;
    for (int i = 1; i <= 8; ++i) {
      const int iterations = phase.solve(state, state, 10.0 * i, 10.0).newton.iterations;
      worst = std::max(worst, iterations);
      mean += iterations / 8.0;
    }
    EXPECT_LE(worst, 12) << range << " K, " << start << " K, " << liquid << " W/(m K), " << side;
    RecordProperty("mean_" + std::to_string(range), std::to_string(mean));
    RecordProperty("worst_" + std::to_string(range), worst);
  };
  for (const double range : {0.0, 0.1, 1.0}) follow(range, 901, 100, "x_min");
  follow(0, 900, 100, "x_min");
  follow(0, 901, 100, "x_max");
  follow(0, 901, 10, "x_min");
  follow(0, 901, 1000, "x_min");
}

// A front that passes many layers of nodes of triangles and tetrahedra in one step.
TEST(TruncatedNewton, FollowsAFrontThroughManyLayersInTheSolid) {
  if (test::processes() > 1) return;  // the serial run proves it
  for (const mesh::Shape shape : {mesh::Shape::tri3, mesh::Shape::tet4}) {
    const bool solid = test::is_3d(shape);
    const mesh::Mesh mesh = solid ? test::block_mesh(shape, {0.1, 0.1, 0.1}, {16, 16, 16})
                                  : test::block_mesh(shape, {0.1, 0.1}, {80, 80});
    heat::ThermalConditions conditions;
    conditions.temperatures.push_back({"chill", "x_min", Table(300.0)});
    conditions.films.push_back({"chill_y", "y_max", {Table(3e4), false}, Table(293.0)});
    // The default tolerance, and one ten times as large.
    for (const auto& [tolerance, most] : {std::pair(0.0, 24), std::pair(1e-5, 12)})
      for (const double start : {900.0, 910.0}) {
        heat::HeatOptions options;
        options.tolerance = tolerance;
        heat::ThermalPhase phase(mesh, solid ? AnalysisKind::solid : AnalysisKind::plane_strain,
                                 {test::metal(0)}, conditions, options);
        heat::ThermalState state = phase.states().initial(std::vector<double>{start});
        for (int i = 1; i <= 5; ++i)
          EXPECT_LE(phase.solve(state, state, 20.0 * i, 20.0).newton.iterations, most)
              << mesh::name(shape) << " " << start << " K, step " << i << ", tolerance " << tolerance;
      }
  }
}

TEST(TruncatedNewton, TakesFewIterationsWithEveryElement) {
  using mesh::Shape;
  for (const Shape shape : {Shape::tet4, Shape::tet10, Shape::hex8, Shape::hex20}) {
    const int n = mesh::order(shape) == 1 ? 8 : 4;
    EXPECT_LE(freeze(alloy(), n, 2, 5, 0, 973, shape).worst, 12) << mesh::name(shape);
  }
}

TEST(TruncatedNewton, LosesNoHeatWhateverTheTolerance) {
  for (const double tolerance : {1e-1, 1e-3, 1e-9}) {
    const Freezing run = freeze(alloy(), 8, 5, 6, tolerance);
    EXPECT_LE(run.defect, 1e-13) << tolerance;
  }
}

TEST(TruncatedNewton, FindsWithItsDefaultToleranceTheTemperaturesOfATightOne) {
  const Freezing loose = freeze(alloy(), 10, 2, 10), tight = freeze(alloy(), 10, 2, 10, 1e-11);
  double worst = 0;
  for (std::size_t i = 0; i < loose.state.temperature.size(); ++i)
    worst = std::max(worst, std::abs(loose.state.temperature[i] - tight.state.temperature[i]));
  EXPECT_LE(worst, 0.05);  // kelvins; the metal has cooled by hundreds
  RecordProperty("difference", std::to_string(worst));
}

TEST(TruncatedNewton, GivesTheSameBitsAgainFromAStoredState) {
  const Freezing whole = freeze(alloy(), 6, 2, 4), again = freeze(alloy(), 6, 2, 4);
  EXPECT_EQ(whole.state.temperature, again.state.temperature);
  EXPECT_EQ(whole.state.enthalpy, again.state.enthalpy);
}

}  // namespace
}  // namespace solidus
