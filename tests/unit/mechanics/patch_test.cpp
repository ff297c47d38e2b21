/// Patch tests: a homogeneous state is reproduced exactly on distorted meshes of every shape.
#include <gtest/gtest.h>

#include "body.hpp"
#include "material/elasticity.hpp"

namespace solidus {
namespace {

using mesh::Shape;
using test::Body;
using test::Lattice;
using test::Solved;

struct Patch {
  Shape shape;
  AnalysisKind kind;
  bool b_bar;
};

std::string name(const Patch& p) {
  const char* kinds[] = {"PlaneStrain", "Axisymmetric", "Solid"};
  return std::string(mesh::name(p.shape)) + kinds[static_cast<int>(p.kind)] + (p.b_bar ? "BBar" : "");
}

std::vector<Patch> patches() {
  std::vector<Patch> all;
  for (AnalysisKind kind : {AnalysisKind::plane_strain, AnalysisKind::axisymmetric}) {
    for (Shape shape : {Shape::tri3, Shape::tri6, Shape::quad4, Shape::quad8})
      all.push_back({shape, kind, false});
    for (Shape shape : {Shape::quad4, Shape::quad8}) all.push_back({shape, kind, true});
  }
  for (Shape shape : {Shape::tet4, Shape::tet10, Shape::hex8, Shape::hex20})
    all.push_back({shape, AnalysisKind::solid, false});
  for (Shape shape : {Shape::hex8, Shape::hex20}) all.push_back({shape, AnalysisKind::solid, true});
  return all;
}

/// The displacement gradient: u_i = Σ_j h_ij x_j. Axisymmetric homogeneous states are u_r = a r, u_z = b z +
/// c with no shear.
std::array<std::array<double, 3>, 3> gradient(AnalysisKind kind) {
  switch (kind) {
    case AnalysisKind::plane_strain:
      return {{{1e-3, 4e-4, 0}, {-2e-4, 7e-4, 0}, {0, 0, 0}}};
    case AnalysisKind::axisymmetric:
      return {{{1e-3, 0, 0}, {0, -6e-4, 0}, {0, 0, 0}}};
    default:
      return {{{1e-3, 4e-4, -3e-4}, {-2e-4, 7e-4, 5e-4}, {6e-4, 1e-4, -9e-4}}};
  }
}

class PatchTest : public ::testing::TestWithParam<Patch> {};

TEST_P(PatchTest, ALinearDisplacementGivesTheExactConstantStress) {
  const Patch patch = GetParam();
  Lattice lattice{.shape = patch.shape, .cells = {3, 3, 3}, .size = {1.0, 1.2, 0.8}, .distortion = 0.15};
  if (patch.kind == AnalysisKind::axisymmetric)
    lattice.map = [](const mesh::Point& x) { return mesh::Point{x[0] + 0.5, x[1], 0}; };
  Body body(lattice, patch.kind, test::elastic_material(2e11, 0.3));
  body.options.b_bar = patch.b_bar;
  const auto h = gradient(patch.kind);
  const auto exact = [&](const mesh::Point& x) {
    mesh::Point u{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) u[i] += h[i][j] * x[j];
    return u;
  };
  body.hold_boundary(exact);
  const Solved solved(body);

  Sym<double> strain{
      {h[0][0], h[1][1], h[2][2], (h[0][1] + h[1][0]) / 2, (h[1][2] + h[2][1]) / 2, (h[0][2] + h[2][0]) / 2}};
  if (patch.kind == AnalysisKind::axisymmetric) strain[2] = h[0][0];  // the hoop strain u_r/r
  const double bulk = 2e11 / (3 * (1 - 0.6)), shear = 2e11 / 2.6;
  Sym<double> stress = 2 * shear * dev(strain);
  for (int i = 0; i < 3; ++i) stress[i] += bulk * trace(strain);

  for (const auto& fields : test::element_fields(solved))
    for (std::size_t e = 0; e < fields.stress.size(); ++e) {
      for (std::size_t i = 0; i < 6; ++i) {
        // 1e-10 of the stress: the residual's criterion is 1e-11 of the forces
        EXPECT_NEAR(fields.stress[e][i], stress[static_cast<int>(i)], 1e-10 * norm(stress));
        EXPECT_NEAR(fields.strain[e][i], strain[static_cast<int>(i)], 1e-10 * norm(strain));
      }
      EXPECT_NEAR(fields.von_mises[e], von_mises(stress), 1e-10 * norm(stress));
      EXPECT_NEAR(fields.pressure[e], -trace(stress) / 3, 1e-10 * norm(stress));
    }
  for (Index node = 0; node < body.mesh.n_nodes(); ++node)
    for (int i = 0; i < solved.phase->bodies().components; ++i)
      EXPECT_NEAR(solved.u(body, node, i),
                  exact(body.mesh.x[static_cast<std::size_t>(node)])[static_cast<std::size_t>(i)], 1e-13);
}

TEST_P(PatchTest, RigidBodyMotionGivesNoStress) {
  const Patch patch = GetParam();
  Lattice lattice{.shape = patch.shape, .cells = {2, 2, 2}, .distortion = 0.15};
  if (patch.kind == AnalysisKind::axisymmetric)
    lattice.map = [](const mesh::Point& x) { return mesh::Point{x[0] + 0.5, x[1], 0}; };
  Body body(lattice, patch.kind, test::elastic_material(2e11, 0.3));
  body.options.b_bar = patch.b_bar;
  // Infinitesimal rotations; only the axial translation is rigid in axisymmetry.
  body.hold_boundary([&](const mesh::Point& x) -> mesh::Point {
    switch (patch.kind) {
      case AnalysisKind::plane_strain:
        return {0.3 - 0.01 * x[1], -0.2 + 0.01 * x[0], 0};
      case AnalysisKind::axisymmetric:
        return {0, 0.25, 0};
      default:
        return {0.3 - 0.01 * x[1] + 0.02 * x[2], -0.2 + 0.01 * x[0] - 0.03 * x[2],
                0.1 - 0.02 * x[0] + 0.03 * x[1]};
    }
  });
  const Solved solved(body);
  for (const auto& fields : test::element_fields(solved))
    for (const auto& stress : fields.stress)
      for (double s : stress) EXPECT_NEAR(s, 0.0, 2e11 * 1e-13);  // round-off of the strain
}

TEST(MixedPatch, TrianglesAndQuadsTogetherReproduceAConstantStress) {
  mesh::RawMesh raw = test::make_raw({.shape = Shape::quad4, .cells = {4, 4, 1}, .distortion = 0.15});
  auto& blocks = raw.groups["body"].blocks;
  const mesh::RawBlock quads = blocks[0];
  mesh::RawBlock kept{Shape::quad4, {}, {}}, split{Shape::tri3, {}, {}};
  for (std::size_t e = 0; e < quads.input_element.size(); ++e) {
    const Index* n = quads.nodes.data() + 4 * e;
    if (e % 3 == 0) {
      split.nodes.insert(split.nodes.end(), {n[0], n[1], n[2], n[0], n[2], n[3]});
      for (int half = 0; half < 2; ++half) split.input_element.push_back(quads.input_element[e]);
    } else {
      kept.nodes.insert(kept.nodes.end(), n, n + 4);
      kept.input_element.push_back(quads.input_element[e]);
    }
  }
  blocks = {kept, split};
  Body body(test::distributed(raw), AnalysisKind::plane_strain, test::elastic_material(2e11, 0.3));
  body.hold_boundary([](const mesh::Point& x) {
    return mesh::Point{1e-3 * x[0] + 4e-4 * x[1], -2e-4 * x[0], 0};
  });
  const Solved solved(body);
  const double lambda = 2e11 * 0.3 / (1.3 * 0.4), shear = 2e11 / 2.6;
  for (const auto& fields : test::element_fields(solved))
    for (const auto& stress : fields.stress) {
      EXPECT_NEAR(stress[0], (lambda + 2 * shear) * 1e-3, 1e-10 * 2e8);
      EXPECT_NEAR(stress[1], lambda * 1e-3, 1e-10 * 2e8);
      EXPECT_NEAR(stress[3], shear * 2e-4, 1e-10 * 2e8);
    }
}

INSTANTIATE_TEST_SUITE_P(EveryShape, PatchTest, ::testing::ValuesIn(patches()),
                         [](const auto& test) { return name(test.param); });

}  // namespace
}  // namespace solidus
