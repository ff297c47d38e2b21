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
  heat::Conditions conditions;
  conditions.films.push_back({"chill_x", "x_max", {Table(3000.0), false}, Table(293.0)});
  conditions.films.push_back({"chill_y", "y_max", {Table(3000.0), false}, Table(293.0)});
  heat::HeatOptions options;
  options.tolerance = tolerance;
  options.alone = true;
  heat::ThermalPhase phase(mesh, AnalysisKind::solid, {material}, conditions, options);
  Freezing run;
  run.state = phase.initial_state(std::vector<double>{start});
  for (int i = 1; i <= steps; ++i) {
    const heat::PhaseReport report = phase.solve(run.state, run.state, i * dt, dt);
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

// The materials and steps on which a tangent is worst: the front passes a third of the cube in one step, all
// that freezes freezes at one temperature or nearly so, melt that starts at the very end of a plateau, and a
// conductivity that jumps with the phase, either way.
TEST(TruncatedNewton, TakesAtMostTwelveIterationsForSteepCurvesAndLongSteps) {
  const int n = test::processes() == 1 ? 12 : 8;
  for (const double dt : {0.2, 2.0, 20.0, 2e3})
    for (const double range : {0.0, 1.0, 37.0})
      for (const double liquid : {65.0, 14.5, 1450.0}) {
        material::Material m = with_range(range);
        m.conductivity = Table({298, 886, 888}, {159, 145, liquid});
        for (const double start : {973.0, 887.0}) {
          const Freezing run = freeze(m, n, dt, 3, 0, start);
          EXPECT_LE(run.worst, 12) << dt << " s, range " << range << " K, k " << liquid << ", " << start;
        }
      }
}

// 1000 cells of 0.1 mm, of which hundreds freeze in one step of 10 s. At one temperature it can take more
// iterations than are allowed (docs/verification/heat.md).
TEST(TruncatedNewton, FollowsAFrontThroughHundredsOfCellsInOneStep) {
  if (test::processes() > 1) return;  // the serial run proves it
  const mesh::Mesh strip = test::block_mesh(mesh::Shape::quad4, {0.1, 0.001}, {1000, 1});
  for (const double range : {0.1, 1.0}) {
    heat::Conditions conditions;
    conditions.temperatures.push_back({"chill", "x_min", Table(300.0)});
    heat::ThermalPhase phase(strip, AnalysisKind::plane_strain, {test::metal(range)}, conditions);
    heat::ThermalState state = phase.initial_state(std::vector<double>{901.0});
    int worst = 0;
    double mean = 0;
    for (int i = 1; i <= 8; ++i) {
      const int iterations = phase.solve(state, state, 10.0 * i, 10.0).newton.iterations;
      worst = std::max(worst, iterations);
      mean += iterations / 8.0;
    }
    EXPECT_LE(worst, 15) << range;
    RecordProperty("mean_" + std::to_string(range), std::to_string(mean));
    RecordProperty("worst_" + std::to_string(range), worst);
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
