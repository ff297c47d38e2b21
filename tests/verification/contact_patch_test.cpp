/// Contact patch tests: a uniform pressure passes through meshes that match or not.
///
///          p                      upper block, E_2, ν_2
///   ↓ ↓ ↓ ↓ ↓ ↓ ↓
///   ┌───┬───┬───┐                 interface without friction, penalty ε_N: the blocks overlap by p/ε_N, with
///   ├─┬─┴┬──┴┬──┤                 the augmented Lagrangian not at all
///   └─┴──┴───┴──┘                 lower block, E_1, ν_1, stands on its bottom
///   ///////////////
///
/// Closed form: σ_yy = −p everywhere (and zero laterally, where the sides are free), contact pressure p.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "../unit/mechanics/element_fields.hpp"
#include "contact_steps.hpp"

namespace solidus {
namespace {

using contact::Formulation;
using contact::IntegrationRule;
using contact::NormalKind;
using mesh::Shape;

const std::vector<material::Material> k_materials{test::elastic(70e9, 0.33), test::elastic(210e9, 0.3)};

struct Patch {
  Shape shape;
  AnalysisKind kind;
};

struct Deviation {
  /// Largest deviations, relative: of t_N and σ from p, of g_N from p/ε_N.
  double pressure = 0, stress = 0, penetration = 0;
  double left = 0;  ///< largest |g_N| [m]
  int iterations = 0, turns = 0;
};

mechanics::MechanicsOptions newton_to(double tolerance) {
  mechanics::MechanicsOptions options = test::strict_mechanics();
  options.newton.tolerance = tolerance;
  return options;
}

enum class Sides { free, held };

Deviation press(const mesh::Mesh& mesh, AnalysisKind kind, contact::ContactParameters spec, double p,
                Sides sides = Sides::free, double tolerance = 1e-12) {
  mechanics::MechanicalConditions conditions = test::symmetric_supports(mesh.dimension);
  if (sides == Sides::held)
    for (const std::string body : {"lower", "upper"}) {
      conditions.displacements.push_back({body + "_x_max", 0, 0.0});
      if (mesh.dimension == 3) conditions.displacements.push_back({body + "_y_max", 1, 0.0});
    }
  conditions.pressures.push_back({mesh.dimension == 2 ? "upper_y_max" : "upper_z_max", p});
  test::ContactSteps run(mesh, kind, k_materials, std::move(spec), conditions, newton_to(tolerance));
  run.step(1);
  Deviation d;
  d.iterations = run.iterations();
  d.turns = static_cast<int>(run.turns.size());
  for (const contact::ContactPointState& point : run.points()) {
    d.pressure = std::max(d.pressure, std::abs(point.pressure / p - 1));
    d.penetration = std::max(
        d.penetration, std::abs(point.penetration * run.pair.parts().forces.law().normal.penalty / p - 1));
    d.left = std::max(d.left, std::abs(point.penetration));
  }
  const std::size_t axis = mesh.dimension == 2 ? 1 : 2;
  for (const auto& block : test::element_fields(mesh, run.state))
    for (const auto& sigma : block.stress) d.stress = std::max(d.stress, std::abs(sigma[axis] / p + 1));
  for (double* value : {&d.pressure, &d.stress, &d.penetration, &d.left})
    *value = parallel::global_max(*value);
  return d;
}

/// The upper block with the divisions of the lower one.
mesh::Mesh matching_blocks(Shape shape) {
  mesh::TwoBlocks blocks = test::standard_blocks(shape);
  blocks.upper_divisions = blocks.lower_divisions;
  return test::distribute_blocks(test::raw_blocks(blocks, shape));
}

contact::ContactParameters large_sliding(int gauss_degree) {
  contact::ContactParameters spec = test::interface();
  spec.formulation = Formulation::large_sliding;
  spec.integration = IntegrationRule::gauss;
  spec.gauss_degree = gauss_degree;
  return spec;
}

class ContactPatch : public ::testing::TestWithParam<Patch> {};

TEST_P(ContactPatch, PassesAUniformPressureToSolverAccuracyWithSegmentsAndTheirMeans) {
  const auto [shape, kind] = GetParam();
  const mesh::Mesh mesh = test::two_blocks(shape);
  for (const auto rule : {IntegrationRule::segments, IntegrationRule::mortar})
    for (const bool swapped : {false, true}) {
      contact::ContactParameters spec = test::interface();
      spec.integration = rule;
      if (swapped) std::swap(spec.slave, spec.master);
      const Deviation d = press(mesh, kind, spec, 5e7);
      RecordProperty(swapped ? "pressure_swapped" : "pressure", fmt::format("{:.1e}", d.pressure));
      EXPECT_LT(d.pressure, 1e-8);
      EXPECT_LT(d.stress, 1e-8);
      EXPECT_LT(d.penetration, 1e-8);
      // One iteration from touching, one to clear the stabilisation of the tangent, one to see it.
      EXPECT_LE(d.iterations, 4);
    }
}

TEST_P(ContactPatch, LeavesNoPenetrationWithTheAugmentedLagrangian) {
  const auto [shape, kind] = GetParam();
  const mesh::Mesh mesh = test::two_blocks(shape);
  contact::ContactParameters spec = test::interface();
  spec.normal = NormalKind::augmented_lagrangian;
  const Deviation d = press(mesh, kind, spec, 5e7);
  RecordProperty("pressure", fmt::format("{:.1e}", d.pressure));
  RecordProperty("turns", d.turns);
  EXPECT_LT(d.pressure, 1e-8);
  EXPECT_LT(d.stress, 1e-8);
  // The tolerance is a millionth of the mean face, 0.3/5 m in the plane and smaller in space.
  EXPECT_LT(d.left, 6e-8);
  // The first augmentation leaves p/ε_N, 7e-7 m here; under a given load the second one leaves nothing.
  EXPECT_LE(d.turns, 3);
}

TEST_P(ContactPatch, PassesOnMatchingMeshesInBothFormulations) {
  const auto [shape, kind] = GetParam();
  const mesh::Mesh mesh = matching_blocks(shape);
  contact::ContactParameters gauss = test::interface();
  gauss.integration = IntegrationRule::gauss;
  for (const contact::ContactParameters& spec : {test::interface(), gauss}) {
    const Deviation d = press(mesh, kind, spec, 5e7);
    EXPECT_LT(d.pressure, 1e-8);
    EXPECT_LT(d.stress, 1e-8);
  }
  // Between rigid walls, see SeesNominalPressuresInLargeSliding.
  for (const auto normal : {NormalKind::penalty, NormalKind::augmented_lagrangian}) {
    contact::ContactParameters spec = large_sliding(4);
    spec.normal = normal;
    const Deviation d = press(mesh, kind, spec, 5e7, Sides::held);
    RecordProperty(normal == NormalKind::penalty ? "penalty" : "augmented", fmt::format("{:.1e}", d.stress));
    EXPECT_LT(d.pressure, 1e-8);
    EXPECT_LT(d.stress, 1e-8);
    if (normal == NormalKind::penalty) {
      EXPECT_LT(d.penetration, 1e-8);
    } else {
      EXPECT_LT(d.left, 6e-8);
    }
  }
}

TEST_P(ContactPatch, IsMissedByTheErrorOfGaussPointsInLargeSlidingOnMeshesThatDoNotMatch) {
  const auto [shape, kind] = GetParam();
  const mesh::Mesh mesh = test::two_blocks(shape);
  std::string errors;
  std::vector<double> stress;
  // A point that lies on an edge between two faces of the master may turn its force to and fro with them.
  constexpr double k_tolerance = 1e-5;
  for (const int degree : {2, 4, 8, 16}) {
    const Deviation d = press(mesh, kind, large_sliding(degree), 5e7, Sides::held, k_tolerance);
    errors += fmt::format(" {:.1e}/{:.1e}", d.pressure, d.stress);
    stress.push_back(d.stress);
  }
  RecordProperty("errors", errors);
  // Points see the edges of the master somewhere between two of them: first order in their distance.
  EXPECT_LT(stress.back(), 0.75 * stress.front());
  EXPECT_LT(stress.back(), 4e-3);
}

TEST_P(ContactPatch, PassesAUniformPressureInLargeSlidingWithSegments) {
  const auto [shape, kind] = GetParam();
  const mesh::Mesh mesh = test::two_blocks(shape);
  for (const auto normal : {NormalKind::penalty, NormalKind::augmented_lagrangian})
    for (const bool swapped : {false, true}) {
      contact::ContactParameters spec = large_sliding(0);
      spec.integration = IntegrationRule::segments;
      spec.normal = normal;
      if (swapped) std::swap(spec.slave, spec.master);
      const Deviation d = press(mesh, kind, spec, 5e7, Sides::held);
      RecordProperty(fmt::format("{}{}", normal == NormalKind::penalty ? "penalty" : "augmented",
                                 swapped ? "_swapped" : ""),
                     fmt::format("{:.1e} {:.1e} {}", d.pressure, d.stress, d.iterations));
      EXPECT_LT(d.pressure, 1e-8);
      EXPECT_LT(d.stress, 1e-8);
      if (normal == NormalKind::penalty) {
        EXPECT_LT(d.penetration, 1e-8);
      } else {
        EXPECT_LT(d.left, 6e-8);
      }
    }
}

std::string patch_name(const ::testing::TestParamInfo<Patch>& patch) {
  constexpr std::array kinds{"PlaneStrain", "Axisymmetric", "Solid"};
  return std::string(mesh::name(patch.param.shape)) + kinds[static_cast<std::size_t>(patch.param.kind)];
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, ContactPatch,
    ::testing::Values(
        Patch{Shape::tri3, AnalysisKind::plane_strain}, Patch{Shape::quad4, AnalysisKind::plane_strain},
        Patch{Shape::tri6, AnalysisKind::plane_strain}, Patch{Shape::quad8, AnalysisKind::plane_strain},
        Patch{Shape::tri3, AnalysisKind::axisymmetric}, Patch{Shape::quad4, AnalysisKind::axisymmetric},
        Patch{Shape::tri6, AnalysisKind::axisymmetric}, Patch{Shape::quad8, AnalysisKind::axisymmetric},
        Patch{Shape::tet4, AnalysisKind::solid}, Patch{Shape::hex8, AnalysisKind::solid},
        Patch{Shape::tet10, AnalysisKind::solid}, Patch{Shape::hex20, AnalysisKind::solid}),
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
  // Segments are needed for this: with points placed without regard to the master, its forces are not those
  // of a uniform pressure.
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4);
  for (auto rule : {IntegrationRule::nodal, IntegrationRule::gauss}) {
    contact::ContactParameters spec = test::interface();
    spec.integration = rule;
    const Deviation d = press(mesh, AnalysisKind::plane_strain, spec, 5e7);
    RecordProperty(rule == IntegrationRule::nodal ? "nodal" : "gauss", fmt::format("{:.1e}", d.stress));
    EXPECT_GT(d.stress, 1e-4);
    EXPECT_LT(d.stress, 0.5);
  }
}

TEST(ContactPatch, SeesNominalPressuresInLargeSliding) {
  // Tractions are per reference area of the slave (3.6): where the master widens more, it feels less per area
  // of its own. The error is that of the areas, proportional to the load.
  const mesh::Mesh mesh = matching_blocks(Shape::quad4);
  const double at_5 = press(mesh, AnalysisKind::plane_strain, large_sliding(4), 5e6).stress;
  const double at_50 = press(mesh, AnalysisKind::plane_strain, large_sliding(4), 5e7).stress;
  RecordProperty("at_50_MPa", fmt::format("{:.1e}", at_50));
  EXPECT_NEAR(at_50 / at_5, 10, 0.5);
  EXPECT_LT(at_50, 1e-2);
}

TEST(ContactPatch, PassesThroughAGapThatTheLoadCloses) {
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4, 2e-5);
  mechanics::MechanicalConditions conditions = test::symmetric_supports(2);
  conditions.displacements.push_back({"upper_y_max", 1, -1e-4});
  test::ContactSteps run(mesh, AnalysisKind::plane_strain, k_materials, test::interface(), conditions);
  run.step(1);
  // In series: 0.1 m of E_1' , the penalty, 0.2 m of E_2', with E' = E/(1 − ν²) in plane strain, free sides.
  const double e1 = 70e9 / (1 - 0.33 * 0.33), e2 = 210e9 / (1 - 0.09),
               penalty = run.pair.parts().forces.law().normal.penalty;
  const double p = (1e-4 - 2e-5) / (0.1 / e1 + 0.2 / e2 + 1 / penalty);
  for (const contact::ContactPointState& point : run.points()) EXPECT_NEAR(point.pressure, p, 1e-8 * p);
  EXPECT_NEAR(contact::sums(run.pair.view(), {}).energy, 0.3 * 0.5 * p * p / penalty,
              1e-8 * 0.3 * p * p / penalty);
}

TEST(RestingBody, HeldOnlyByContactTakesItsWeightInOneStep) {
  // The upper block has no support but the lower one: symmetry at one side, gravity, nothing else.
  for (Shape shape : {Shape::quad4, Shape::hex8}) {
    SCOPED_TRACE(mesh::name(shape));
    const mesh::Mesh mesh = test::two_blocks(shape);
    const auto kind = mesh.dimension == 2 ? AnalysisKind::plane_strain : AnalysisKind::solid;
    mechanics::MechanicalConditions conditions = test::symmetric_supports(mesh.dimension);
    // Nothing holds the upper block sideways either.
    std::erase_if(conditions.displacements, [](const auto& d) { return d.node_set.rfind("upper", 0) == 0; });
    conditions.gravity[static_cast<std::size_t>(mesh.dimension - 1)] = -9.81;
    test::ContactSteps run(mesh, kind, k_materials, test::interface(), conditions, newton_to(1e-9));
    run.step(1);
    const double volume = 0.3 * 0.2 * (mesh.dimension == 2 ? 1 : 0.2);
    EXPECT_NEAR(contact::sums(run.pair.view(), {}).force, 7800 * 9.81 * volume, 1e-7 * 7800 * 9.81 * volume);
  }
}

TEST(FallingBody, ThatNothingHoldsLandsOnItsSupportInOneStep) {
  // A gap of 10 µm all over: at the start the upper block has no support at all.
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4, 1e-5);
  mechanics::MechanicalConditions conditions = test::symmetric_supports(2);
  conditions.gravity[1] = -9.81;
  test::ContactSteps run(mesh, AnalysisKind::plane_strain, k_materials, test::interface(), conditions,
                         newton_to(1e-9));
  run.step(1);
  RecordProperty("iterations", run.iterations());
  EXPECT_NEAR(contact::sums(run.pair.view(), {}).force, 7800 * 9.81 * 0.06, 1e-6 * 7800 * 9.81 * 0.06);
}

}  // namespace
}  // namespace solidus
