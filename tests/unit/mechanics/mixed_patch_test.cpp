/// Mixed triangles and tetrahedra reproduce a homogeneous state, a hydrostatic column and a nearly
/// incompressible one exactly, on distorted meshes.
#include <gtest/gtest.h>

#include <cmath>

#include "body.hpp"

namespace solidus {
namespace {

using mechanics::Simplices;
using mechanics::Stabilisation;
using mesh::Shape;
using test::Body;
using test::Lattice;
using test::Solved;

struct Patch {
  AnalysisKind kind;
  double poisson;
  Stabilisation stabilisation;
};

std::string name(const Patch& p) {
  const char* kinds[] = {"PlaneStrain", "Axisymmetric", "Solid"};
  return std::string(kinds[static_cast<int>(p.kind)]) +
         (p.poisson > 0.4 ? "Incompressible" : "Compressible") +
         (p.stabilisation == Stabilisation::orthogonal ? "Orthogonal" : "Algebraic");
}

std::vector<Patch> patches() {
  std::vector<Patch> all;
  for (AnalysisKind kind : {AnalysisKind::plane_strain, AnalysisKind::axisymmetric, AnalysisKind::solid})
    for (double poisson : {0.3, 0.4999})
      for (Stabilisation s : {Stabilisation::orthogonal, Stabilisation::algebraic})
        all.push_back({kind, poisson, s});
  return all;
}

/// The displacement gradient; axisymmetric homogeneous states have no shear.
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

Body body_of(const Patch& patch) {
  Lattice lattice{.shape = patch.kind == AnalysisKind::solid ? Shape::tet4 : Shape::tri3,
                  .cells = {3, 3, 3},
                  .size = {1.0, 1.2, 0.8},
                  .distortion = 0.15};
  if (patch.kind == AnalysisKind::axisymmetric)
    lattice.map = [](const mesh::Point& x) { return mesh::Point{x[0] + 0.5, x[1], 0}; };
  Body body(lattice, patch.kind, test::elastic_material(2e11, patch.poisson));
  body.options.simplices = Simplices::mixed;
  body.options.stabilisation = patch.stabilisation;
  body.options.linear_tolerance = 1e-12;
  return body;
}

class MixedSimplices : public ::testing::TestWithParam<Patch> {};

TEST_P(MixedSimplices, ALinearDisplacementGivesTheExactConstantStress) {
  const Patch patch = GetParam();
  Body body = body_of(patch);
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
  const double bulk = 2e11 / (3 * (1 - 2 * patch.poisson)), shear = 2e11 / (2 + 2 * patch.poisson);
  Sym<double> stress = 2 * shear * dev(strain);
  for (int i = 0; i < 3; ++i) stress[i] += bulk * trace(strain);
  for (const auto& fields : test::element_fields(solved))
    for (std::size_t e = 0; e < fields.stress.size(); ++e)
      for (std::size_t i = 0; i < 6; ++i) {
        // 1e-9: the residual's criterion is 1e-11 of the forces, the bulk modulus 1e3 times the shear modulus
        EXPECT_NEAR(fields.stress[e][i], stress[static_cast<int>(i)], 1e-9 * norm(stress));
        EXPECT_NEAR(fields.strain[e][i], strain[static_cast<int>(i)], 1e-9 * norm(strain));
      }
}

INSTANTIATE_TEST_SUITE_P(EveryKind, MixedSimplices, ::testing::ValuesIn(patches()),
                         [](const auto& test) { return name(test.param); });

}  // namespace
}  // namespace solidus
