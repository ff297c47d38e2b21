/// Contact patch tests: a uniform pressure passes through meshes that do not match.
///
///          p                      upper block, E_2, ν_2
///   ↓ ↓ ↓ ↓ ↓ ↓ ↓
///   ┌───┬───┬───┐                 interface without friction, penalty ε_N: the blocks overlap by p/ε_N
///   ├─┬─┴┬──┴┬──┤
///   └─┴──┴───┴──┘                 lower block, E_1, ν_1, stands on its bottom
///   ///////////////
///
/// Closed form: σ_yy = −p everywhere (and zero laterally, where the sides are free), contact pressure p.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "contact_bodies.hpp"

namespace solidus {
namespace {

using contact::IntegrationRule;
using mesh::Shape;

struct Patch {
  Shape shape;
  AnalysisKind kind;
};

struct Deviation {
  double pressure = 0, stress = 0;  ///< largest relative deviation from p
  int iterations = 0;
};

Deviation press(const mesh::Mesh& mesh, AnalysisKind kind, contact::ContactSpec spec, double p) {
  const std::vector<material::Material> materials{test::elastic(70e9, 0.33), test::elastic(210e9, 0.3)};
  contact::ContactPair pair(mesh, kind, std::move(spec), std::vector<double>{70e9, 210e9});
  mechanics::Conditions conditions = test::symmetric_supports(mesh.dimension);
  conditions.pressures.push_back({mesh.dimension == 2 ? "upper_y_max" : "upper_z_max", p});
  const std::vector<double> temperature(mesh.x.size(), 300.0);
  mechanics::MechanicalPhase phase(mesh, kind, materials, temperature, conditions, test::strict_mechanics(),
                                   {&pair.mechanics()});
  const mechanics::MechanicalState start = phase.initial_state();
  mechanics::MechanicalState end = start;
  Deviation d;
  d.iterations = phase.solve(start, end, temperature, 1, 1).newton.iterations;
  pair.update(end.displacement);
  for (double t_n : pair.pressure()) d.pressure = std::max(d.pressure, std::abs(t_n / p - 1));
  const std::size_t axis = mesh.dimension == 2 ? 1 : 2;
  for (const auto& block : phase.element_fields())
    for (const auto& sigma : block.stress) d.stress = std::max(d.stress, std::abs(sigma[axis] / p + 1));
  d.pressure = algebra::global_max(d.pressure);
  d.stress = algebra::global_max(d.stress);
  return d;
}

class ContactPatch : public ::testing::TestWithParam<Patch> {};

TEST_P(ContactPatch, PassesAUniformPressureToSolverAccuracyWithSegments) {
  const auto [shape, kind] = GetParam();
  const mesh::Mesh mesh = test::two_blocks(shape);
  for (const bool swapped : {false, true}) {
    contact::ContactSpec spec = test::interface();
    if (swapped) std::swap(spec.slave, spec.master);
    const Deviation d = press(mesh, kind, spec, 5e7);
    RecordProperty(swapped ? "pressure_swapped" : "pressure", fmt::format("{:.1e}", d.pressure));
    EXPECT_LT(d.pressure, 1e-8);
    EXPECT_LT(d.stress, 1e-8);
    // One iteration from touching, one to clear the stabilisation of the tangent, one to see it.
    EXPECT_LE(d.iterations, 4);
  }
}

std::string patch_name(const ::testing::TestParamInfo<Patch>& patch) {
  constexpr std::array kinds{"PlaneStrain", "Axisymmetric", "Solid"};
  return std::string(mesh::name(patch.param.shape)) + kinds[static_cast<std::size_t>(patch.param.kind)];
}

INSTANTIATE_TEST_SUITE_P(Shapes, ContactPatch,
                         ::testing::Values(Patch{Shape::tri3, AnalysisKind::plane_strain},
                                           Patch{Shape::quad4, AnalysisKind::plane_strain},
                                           Patch{Shape::tri6, AnalysisKind::plane_strain},
                                           Patch{Shape::quad8, AnalysisKind::plane_strain},
                                           Patch{Shape::tri3, AnalysisKind::axisymmetric},
                                           Patch{Shape::quad4, AnalysisKind::axisymmetric},
                                           Patch{Shape::quad8, AnalysisKind::axisymmetric},
                                           Patch{Shape::tet4, AnalysisKind::solid},
                                           Patch{Shape::hex8, AnalysisKind::solid},
                                           Patch{Shape::tet10, AnalysisKind::solid},
                                           Patch{Shape::hex20, AnalysisKind::solid}),
                         patch_name);

TEST(ContactPatch, PassesOnFacesOfAnyForm) {
  // Nodes of the interface moved within it: general quads and triangles, no two sides alike.
  for (Shape shape : {Shape::tet4, Shape::hex8}) {
    SCOPED_TRACE(mesh::name(shape));
    mesh::RawMesh raw = test::raw_blocks(test::standard_blocks(shape), shape);
    for (auto& x : raw.x) {
      if (std::abs(x[2] - 0.1) > 1e-9) continue;
      const double bump = std::sin(std::numbers::pi * x[0] / 0.3) * std::sin(std::numbers::pi * x[1] / 0.2);
      x[0] += 0.02 * bump;
      x[1] -= 0.015 * bump;
    }
    const Deviation d = press(test::distribute_blocks(raw), AnalysisKind::solid, test::interface(), 5e7);
    RecordProperty(std::string(mesh::name(shape)), fmt::format("{:.1e}", d.stress));
    EXPECT_LT(d.pressure, 1e-8);
    EXPECT_LT(d.stress, 1e-8);
  }
}

TEST(ContactPatch, FailsWithoutSegmentsByTheErrorOfIntegratingAcrossTheMastersEdges) {
  // What segments are for: with points placed without regard to the master, its forces are not those of a
  // uniform pressure.
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4);
  for (auto rule : {IntegrationRule::nodal, IntegrationRule::gauss}) {
    contact::ContactSpec spec = test::interface();
    spec.integration = rule;
    const Deviation d = press(mesh, AnalysisKind::plane_strain, spec, 5e7);
    RecordProperty(rule == IntegrationRule::nodal ? "nodal" : "gauss", fmt::format("{:.1e}", d.stress));
    EXPECT_GT(d.stress, 1e-4);
    EXPECT_LT(d.stress, 0.5);
  }
}

TEST(ContactPatch, PassesThroughAGapThatTheLoadCloses) {
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4, 2e-5);
  mechanics::Conditions conditions = test::symmetric_supports(2);
  conditions.displacements.push_back({"upper_y_max", 1, -1e-4});
  contact::ContactPair pair(mesh, AnalysisKind::plane_strain, test::interface(),
                            std::vector<double>{70e9, 210e9});
  const std::vector<material::Material> materials{test::elastic(70e9, 0.33), test::elastic(210e9, 0.3)};
  const std::vector<double> temperature(mesh.x.size(), 300.0);
  mechanics::MechanicalPhase phase(mesh, AnalysisKind::plane_strain, materials, temperature, conditions,
                                   test::strict_mechanics(), {&pair.mechanics()});
  const mechanics::MechanicalState start = phase.initial_state();
  mechanics::MechanicalState end = start;
  phase.solve(start, end, temperature, 1, 1);
  pair.update(end.displacement);
  // In series: 0.1 m of E_1' , the penalty, 0.2 m of E_2', with E' = E/(1 − ν²) in plane strain, free sides.
  const double e1 = 70e9 / (1 - 0.33 * 0.33), e2 = 210e9 / (1 - 0.09);
  const double p = (1e-4 - 2e-5) / (0.1 / e1 + 0.2 / e2 + 1 / pair.penalty());
  for (double t_n : pair.pressure()) EXPECT_NEAR(t_n, p, 1e-8 * p);
  EXPECT_NEAR(pair.sums({}).energy, 0.3 * 0.5 * p * p / pair.penalty(), 1e-8 * 0.3 * p * p / pair.penalty());
}

TEST(RestingBody, HeldOnlyByContactTakesItsWeightInOneStep) {
  // The upper block has no support but the lower one: symmetry at one side, gravity, nothing else.
  for (Shape shape : {Shape::quad4, Shape::hex8}) {
    SCOPED_TRACE(mesh::name(shape));
    const mesh::Mesh mesh = test::two_blocks(shape);
    const auto kind = mesh.dimension == 2 ? AnalysisKind::plane_strain : AnalysisKind::solid;
    mechanics::Conditions conditions = test::symmetric_supports(mesh.dimension);
    // Nothing holds the upper block sideways either.
    std::erase_if(conditions.displacements, [](const auto& d) { return d.node_set.rfind("upper", 0) == 0; });
    conditions.gravity[static_cast<std::size_t>(mesh.dimension - 1)] = -9.81;
    contact::ContactPair pair(mesh, kind, test::interface(), std::vector<double>{70e9, 210e9});
    const std::vector<material::Material> materials{test::elastic(70e9, 0.33), test::elastic(210e9, 0.3)};
    const std::vector<double> temperature(mesh.x.size(), 300.0);
    mechanics::MechanicsOptions options = test::strict_mechanics();
    options.newton.tolerance = 1e-9;
    mechanics::MechanicalPhase phase(mesh, kind, materials, temperature, conditions, options,
                                     {&pair.mechanics()});
    const mechanics::MechanicalState start = phase.initial_state();
    mechanics::MechanicalState end = start;
    phase.solve(start, end, temperature, 1, 1);
    pair.update(end.displacement);
    const double volume = 0.3 * 0.2 * (mesh.dimension == 2 ? 1 : 0.2);
    EXPECT_NEAR(pair.sums({}).force, 7800 * 9.81 * volume, 1e-7 * 7800 * 9.81 * volume);
  }
}

TEST(FallingBody, ThatNothingHoldsLandsOnItsSupportInOneStep) {
  // A gap of 10 µm all over: at the start the upper block has no support at all.
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4, 1e-5);
  mechanics::Conditions conditions = test::symmetric_supports(2);
  conditions.gravity[1] = -9.81;
  contact::ContactPair pair(mesh, AnalysisKind::plane_strain, test::interface(),
                            std::vector<double>{70e9, 210e9});
  const std::vector<material::Material> materials{test::elastic(70e9, 0.33), test::elastic(210e9, 0.3)};
  const std::vector<double> temperature(mesh.x.size(), 300.0);
  mechanics::MechanicsOptions options = test::strict_mechanics();
  options.newton.tolerance = 1e-9;
  mechanics::MechanicalPhase phase(mesh, AnalysisKind::plane_strain, materials, temperature, conditions,
                                   options, {&pair.mechanics()});
  const mechanics::MechanicalState start = phase.initial_state();
  mechanics::MechanicalState end = start;
  const auto report = phase.solve(start, end, temperature, 1, 1);
  RecordProperty("iterations", report.newton.iterations);
  pair.update(end.displacement);
  EXPECT_NEAR(pair.sums({}).force, 7800 * 9.81 * 0.06, 1e-6 * 7800 * 9.81 * 0.06);
}

}  // namespace
}  // namespace solidus
