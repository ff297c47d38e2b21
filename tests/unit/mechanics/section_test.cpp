/// Volume over cooling surface of bodies: the same for a piece between planes of symmetry and the whole.
#include "mechanics/loads/section.hpp"

#include <gtest/gtest.h>

#include "lattice.hpp"

namespace solidus {
namespace {

/// Marks the nodes of a face of the block, component `component` at `place`, and holds them there.
void hold(mesh::Mesh& mesh, mechanics::MechanicalConditions& conditions, int component, double place) {
  const std::string name = "plane " + std::to_string(component);
  std::vector<Index>& nodes = mesh.node_sets[name];
  for (std::size_t i = 0; i < mesh.x.size(); ++i)
    if (std::abs(mesh.x[i][static_cast<std::size_t>(component)] - place) < 1e-12)
      nodes.push_back(static_cast<Index>(i));
  conditions.displacements.push_back({name, component, TimeFunction(0.0)});
}

TEST(Section, OfABlockIsItsVolumeOverItsSkin) {
  for (const mesh::Shape shape : {mesh::Shape::hex8, mesh::Shape::tet4, mesh::Shape::tet10}) {
    const mesh::Mesh mesh = test::make_mesh({.shape = shape, .cells = {3, 2, 2}, .size = {3, 2, 1}});
    EXPECT_NEAR(mechanics::sections(mesh, AnalysisKind::solid, {}, linear::ActiveSet(mesh, {}))[0], 6.0 / 22,
                1e-9);
  }
  const mesh::Mesh flat =
      test::make_mesh({.shape = mesh::Shape::tri3, .cells = {4, 3, 1}, .size = {2, 1, 1}});
  EXPECT_NEAR(mechanics::sections(flat, AnalysisKind::plane_strain, {}, linear::ActiveSet(flat, {}))[0],
              2.0 / 6, 1e-9);
}

TEST(Section, OfAnEighthBetweenPlanesOfSymmetryIsThatOfTheWhole) {
  mesh::Mesh eighth =
      test::make_mesh({.shape = mesh::Shape::tet4, .cells = {2, 2, 2}, .size = {1.5, 1, 0.5}});
  mechanics::MechanicalConditions planes;
  for (int i = 0; i < 3; ++i) hold(eighth, planes, i, 0);
  EXPECT_NEAR(mechanics::sections(eighth, AnalysisKind::solid, planes, linear::ActiveSet(eighth, {}))[0],
              6.0 / 22, 1e-9);
}

TEST(Section, OfACylinderCountsItsWholeTurn) {
  mesh::Mesh cylinder =
      test::make_mesh({.shape = mesh::Shape::quad4, .cells = {4, 4, 1}, .size = {0.02, 0.1, 1}});
  // π r² h / (2 π r h + 2 π r²)
  EXPECT_NEAR(
      mechanics::sections(cylinder, AnalysisKind::axisymmetric, {}, linear::ActiveSet(cylinder, {}))[0],
      0.02 * 0.1 / (2 * (0.1 + 0.02)), 1e-9);
}

}  // namespace
}  // namespace solidus
