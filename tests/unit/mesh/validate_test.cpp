// Meshes with a mistake in them, and mirrored elements that are turned around.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "sample_mesh.hpp"
#include "system/errors.hpp"

namespace {

using namespace solidus;
using namespace solidus::test;
using ::testing::AllOf;
using ::testing::HasSubstr;

std::string complaint_of(RawMesh raw) {
  try {
    validate_and_orient(raw, "sample.msh");
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

class EveryShapeChecked : public ::testing::TestWithParam<Shape> {};
INSTANTIATE_TEST_SUITE_P(Shapes, EveryShapeChecked, ::testing::ValuesIn(k_body_shapes),
                         [](const auto& tested) { return std::string(name(tested.param)); });

TEST_P(EveryShapeChecked, AMirroredMeshIsTurnedAroundAndHasItsVolumeAndItsNormals) {
  RawMesh raw = sample_box(GetParam());
  for (Point& x : raw.x) x[0] = -x[0];
  validate_and_orient(raw, "mirrored");
  const Mesh m = distribute(raw, {"block"}, {});
  const AnalysisKind kind = m.dimension == 3 ? AnalysisKind::solid : AnalysisKind::plane_strain;
  EXPECT_NEAR(volume(m, kind), m.dimension == 3 ? 0.06 : 0.15, 1e-14);
  double flux = 0;  // ∮ x·n dA = dim V holds with outward normals only
  for (const auto& [side, surface] : m.surfaces)
    for (const ElementBlock& faces : surface.faces) {
      const FaceGeometry g(m, faces, kind, gauss_rule(faces.shape, 4));
      for (Index f = 0; f < g.n_counted; ++f)
        for (int p = 0; p < g.n_points; ++p)
          for (int a = 0; a < g.n_nodes; ++a)
            for (std::size_t i = 0; i < 3; ++i)
              flux += g.weight[static_cast<std::size_t>(f * g.n_points + p)] *
                      g.normal[static_cast<std::size_t>(f * g.n_points + p)][i] *
                      g.values[static_cast<std::size_t>(p * g.n_nodes + a)] *
                      m.x[static_cast<std::size_t>(faces.element(f)[a])][i];
    }
  EXPECT_NEAR(global_sum(flux), m.dimension == 3 ? 0.18 : 0.3, 1e-13);
}

TEST(Validate, AnElementFoldedIntoItselfIsNamedWithItsPlace) {
  // linear simplices cannot fold: they have one orientation only, and are turned around
  for (const Shape shape :
       {Shape::tri6, Shape::quad4, Shape::quad8, Shape::tet10, Shape::hex8, Shape::hex20}) {
    RawMesh raw = sample_box(shape);
    Point& x = raw.x[static_cast<std::size_t>(raw.groups.at("block").blocks.at(0).nodes[0])];
    x[0] += 0.4;  // the corner, pulled through the other side of its element
    x[1] += 0.35;
    EXPECT_THAT(complaint_of(raw),
                AllOf(HasSubstr("sample.msh"), HasSubstr("inverted element"), HasSubstr("'block'")))
        << name(shape);
  }
}

TEST_P(EveryShapeChecked, AFlatElementIsCalledDegenerate) {
  RawMesh raw = sample_box(GetParam());
  for (Point& x : raw.x) x[1] = 0.5 * x[0];
  EXPECT_THAT(complaint_of(raw),
              AllOf(HasSubstr("degenerate element"), HasSubstr(std::string(name(GetParam())))));
}

TEST(Validate, CoordinatesThatAreNoNumbersAreNamedByTheirNode) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e300}) {
    RawMesh raw = sample_box(Shape::tri3);
    raw.x[3][1] = bad;
    EXPECT_THAT(complaint_of(raw), HasSubstr("node " + std::to_string(raw.input_node[3])));
  }
}

TEST(Validate, ATwoDimensionalMeshOutOfItsPlaneIsRefused) {
  RawMesh raw = sample_box(Shape::quad4);
  raw.x[5][2] = 0.01;
  EXPECT_THAT(complaint_of(raw), HasSubstr("plane z = 0"));
}

TEST(Validate, AMeshWithoutBodiesSaysHowToNameThem) {
  RawMesh raw = sample_box(Shape::tri3);
  raw.groups.erase("block");
  EXPECT_THAT(complaint_of(raw), AllOf(HasSubstr("no body"), HasSubstr("Physical")));
}

}  // namespace
