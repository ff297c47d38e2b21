/// Faces that stay plane: one common displacement, found by equilibrium, exactly eliminated.
#include <gtest/gtest.h>

#include "body.hpp"
#include "system/errors.hpp"

namespace solidus {
namespace {

using mesh::Shape;
using test::Body;
using test::Solved;

constexpr double k_young = 2e11, k_poisson = 0.3, k_alpha = 1e-5;

/// A distorted cube on three symmetry planes with uneven warmth.
Body warm_cube(Shape shape, AnalysisKind kind) {
  Body body({.shape = shape, .cells = {3, 3, 3}, .distortion = 0.1}, kind,
            test::elastic_material(k_young, k_poisson, k_alpha));
  if (kind != AnalysisKind::axisymmetric) body.hold("left", 0);
  body.hold("bottom", 1);
  if (kind == AnalysisKind::solid) body.hold("back", 2);
  for (std::size_t i = 0; i < body.temperature.size(); ++i) {
    const mesh::Point& x = body.mesh.x[i];
    body.temperature[i] += 100 * x[0] * x[0] + 30 * x[1] - 50 * x[0] * x[2];
  }
  return body;
}

/// The common displacement of a group, after a check that it is common.
double common(const Body& body, const Solved& solved, const std::string& group, int component) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const Index node : body.mesh.node_sets.at(group)) {
    low = std::min(low, solved.u(body, node, component));
    high = std::max(high, solved.u(body, node, component));
  }
  low = parallel::global_min(low);
  high = parallel::global_max(high);
  EXPECT_EQ(low, high);
  return high;
}

double reaction(const Body& body, const Solved& solved, const std::string& group, int component) {
  double sum = 0;
  for (const Index node : body.mesh.node_sets.at(group))
    if (node < body.mesh.n_owned_nodes)
      sum += solved.report
                 .reactions[static_cast<std::size_t>(node * displacement_components(body.kind) + component)];
  return parallel::global_sum(sum);
}

TEST(PlaneFace, MovesAsASupportThatCarriesNoForceWould) {
  const std::vector<std::pair<Shape, AnalysisKind>> bodies{{Shape::quad4, AnalysisKind::plane_strain},
                                                           {Shape::tri6, AnalysisKind::axisymmetric},
                                                           {Shape::hex8, AnalysisKind::solid},
                                                           {Shape::tet10, AnalysisKind::solid}};
  for (const auto& [shape, kind] : bodies) {
    const std::string face = kind == AnalysisKind::solid ? "front" : "top";
    const int normal = kind == AnalysisKind::solid ? 2 : 1;
    Body plane = warm_cube(shape, kind);
    plane.conditions.plane_faces.push_back({face});
    const Solved free(plane);
    const double motion = common(plane, free, face, normal);

    Body prescribed = warm_cube(shape, kind);
    prescribed.hold(face, normal, motion);
    const Solved held(prescribed);
    // rounding of a direct solve, with the stress α E ΔT and the size of the cube as units
    EXPECT_NEAR(reaction(prescribed, held, face, normal), 0, 1e-9 * k_young * k_alpha * 100)
        << mesh::name(shape);
    for (std::size_t i = 0; i < free.state.displacement.size(); ++i)
      EXPECT_NEAR(free.state.displacement[i], held.state.displacement[i], 1e-9 * 100 * k_alpha)
          << mesh::name(shape);
  }
}

TEST(PlaneFace, CarriesThePressureOnIt) {
  Body body = warm_cube(Shape::hex8, AnalysisKind::solid);
  body.conditions.plane_faces.push_back({"front"});
  body.conditions.plane_faces.push_back({"right"});
  body.conditions.pressures.push_back({"front", 3e7});
  const Solved solved(body);
  EXPECT_NEAR(reaction(body, solved, "back", 2), 3e7, 1e-2);
  EXPECT_NEAR(reaction(body, solved, "left", 0), 0, 1e-2);
  common(body, solved, "right", 0);
}

// Elements of a linear displacement meet the mean of the closed form, E α/(1 − ν) times the warmth missing.
TEST(PlaneFace, APlateThatCannotBendHasTheThermalStressOfTheClosedForm) {
  constexpr int n = 8;
  Body body({.shape = Shape::hex8, .cells = {n, 1, 1}, .size = {1, 0.1, 0.1}}, AnalysisKind::solid,
            test::elastic_material(k_young, k_poisson, k_alpha));
  body.hold("left", 0);
  body.hold("bottom", 1);
  body.hold("back", 2);
  body.conditions.plane_faces = {{"top"}, {"front"}};
  for (std::size_t i = 0; i < body.temperature.size(); ++i) body.temperature[i] += 80 * body.mesh.x[i][0];
  const Solved solved(body);
  const auto fields = test::element_fields(solved);
  for (Index e = 0; e < body.mesh.blocks[0].size(); ++e) {
    double x = 0;
    for (int a = 0; a < 8; ++a)
      x += body.mesh.x[static_cast<std::size_t>(body.mesh.blocks[0].element(e)[a])][0] / 8;
    const double exact = k_young * k_alpha / (1 - k_poisson) * 80 * (0.5 - x);
    const auto& stress = fields[0].stress[static_cast<std::size_t>(e)];
    EXPECT_NEAR(stress[0], 0, 1.0);  // [Pa]
    EXPECT_NEAR(stress[1], exact, 1.0);
    EXPECT_NEAR(stress[2], exact, 1.0);
  }
}

TEST(PlaneFace, WorksWithMultigridToo) {
  Body body = warm_cube(Shape::hex8, AnalysisKind::solid);
  body.conditions.plane_faces = {{"front"}, {"right"}};
  const Solved direct(body);
  body.options.solver = linear::SolverKind::multigrid;
  body.options.newton.tolerance = 1e-10;
  const Solved iterative(body);
  EXPECT_NEAR(common(body, iterative, "front", 2), common(body, direct, "front", 2), 1e-8 * k_alpha * 100);
}

void expect_refused(const Body& body, const std::string& words) {
  try {
    body.phase();
    FAIL() << words;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

TEST(PlaneFace, ContradictionsAreTheUsersError) {
  Body curved({.shape = Shape::quad4,
               .cells = {3, 3, 1},
               .map =
                   [](const mesh::Point& x) {
                     return mesh::Point{x[0], x[1] * (1 + x[0]), 0};
                   }},
              AnalysisKind::plane_strain, test::elastic_material(k_young, k_poisson));
  curved.conditions.plane_faces = {{"top"}};
  expect_refused(curved, "not normal to a coordinate");

  Body twice = warm_cube(Shape::quad4, AnalysisKind::plane_strain);
  twice.conditions.plane_faces = {{"top"}, {"top"}};
  expect_refused(twice, "shares nodes");

  Body held = warm_cube(Shape::quad4, AnalysisKind::plane_strain);
  held.conditions.plane_faces = {{"bottom"}};
  expect_refused(held, "prescribed");
}

}  // namespace
}  // namespace solidus
