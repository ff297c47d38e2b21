/// The coherent share of the skins of castings.
#include "coupling/skin_share.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "../mechanics/lattice.hpp"
#include "numbers/table.hpp"

namespace solidus {
namespace {

material::Material metal(bool freezes) {
  material::Material m;
  m.young_modulus = Table(70e9);
  m.poisson_ratio = Table(0.3);
  if (freezes)
    m.phase_changes = {{"solidification", material::PhaseFraction::linear(800, 900), 4e5, 0, true}};
  m.casting.coherency_fraction = 0.5;
  return m;
}

/// Four quads along x, whose bottom every process has.
mesh::Mesh whole_bottom() {
  mesh::RawMesh raw = test::make_raw({.shape = mesh::Shape::quad4, .cells = {4, 1, 1}, .size = {4, 1, 1}});
  mesh::validate_and_orient(raw, "lattice");
  return mesh::distribute(raw, {"body"}, {"bottom"});
}

/// A strip whose bottom is in contact.
struct Strip {
  mesh::Mesh mesh = whole_bottom();
  std::vector<material::Material> materials;
  coupling::Coherency coherency;
  std::vector<std::string> surfaces{"bottom"};

  explicit Strip(bool freezes)
      : materials{metal(freezes)}, coherency(mesh, materials, linear::ActiveSet(mesh, {})) {}
  /// 2 at nodes left of a border, zero behind it.
  std::vector<double> coherent_up_to(double border) const {
    std::vector<double> of_nodes;
    for (const mesh::Point& x : mesh.x) of_nodes.push_back(x[0] < border ? 2.0 : 0.0);
    return of_nodes;
  }
};

TEST(SkinShare, IsAMeanOverTheAreaOfWhatMeltsAndNoMoreThanOneIsCoherent) {
  const Strip strip(true);
  const coupling::SkinShare skin(strip.mesh, AnalysisKind::plane_strain, strip.surfaces, strip.coherency);
  ASSERT_TRUE(skin.any());
  // Nodes at the ends have an eighth of the length of 4, those between a quarter.
  EXPECT_DOUBLE_EQ(skin.change(strip.coherent_up_to(-1), strip.coherent_up_to(9)), 1);
  EXPECT_DOUBLE_EQ(skin.change(strip.coherent_up_to(-1), strip.coherent_up_to(0.5)), 0.125);
  EXPECT_DOUBLE_EQ(skin.change(strip.coherent_up_to(2.5), strip.coherent_up_to(0.5)), 0.5);  // it melts again
  EXPECT_EQ(skin.change(strip.coherent_up_to(9), strip.coherent_up_to(9)), 0);
  EXPECT_EQ(skin.change({}, {}), 0);
}

TEST(SkinShare, OfARevolutionCountsWhatFacesSweep) {
  const Strip strip(true);
  const coupling::SkinShare skin(strip.mesh, AnalysisKind::axisymmetric, strip.surfaces, strip.coherency);
  // Radii 0 to 4: shares 0, 1, 2, 3 and 2 of 8, the last of half a length.
  EXPECT_DOUBLE_EQ(skin.change(strip.coherent_up_to(-1), strip.coherent_up_to(1.5)), 0.125);
  EXPECT_DOUBLE_EQ(skin.change(strip.coherent_up_to(3.5), strip.coherent_up_to(9)), 0.25);
}

TEST(SkinShare, OfWhatDoesNotMeltIsNone) {
  const Strip strip(false);
  EXPECT_FALSE(
      coupling::SkinShare(strip.mesh, AnalysisKind::plane_strain, strip.surfaces, strip.coherency).any());
}

}  // namespace
}  // namespace solidus
