// The built-in shapes have the groups and sizes they promise.
#include "mesh/making/parametric_meshes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

#include "mesh/quality.hpp"
#include "sample_mesh.hpp"

namespace {

using namespace solidus;
using namespace solidus::test;
using ::testing::UnorderedElementsAre;

std::set<std::string> group_names(const RawMesh& raw) {
  std::set<std::string> names;
  for (const auto& [name, group] : raw.groups) names.insert(name);
  return names;
}
const GroupReport& group(const QualityReport& report, const std::string& name) {
  for (const GroupReport& g : report.groups)
    if (g.name == name) return g;
  throw std::out_of_range(name);
}

// The measures of monograph 7.3, whose figure is missing, as cases/aluminium_cylinder/README.md has them.
const CylinderInMould k_cylinder{0.015, 0.07, 0.02, 0.02, 0.09, 0.001, 0.002};

TEST(CylinderInMould, HasTheGroupsAndLengthsOfItsDrawing) {
  for (const Shape shape : {Shape::tri3, Shape::tri6, Shape::quad4, Shape::quad8}) {
    RawMesh raw = make_cylinder_in_mould(k_cylinder, shape);
    validate_and_orient(raw, "cylinder");
    EXPECT_THAT(group_names(raw), UnorderedElementsAre("part", "mould", "part_surface", "mould_surface",
                                                       "part_top", "part_axis", "mould_axis", "mould_top",
                                                       "mould_bottom", "mould_outside"));
    const QualityReport report = assess(raw);
    EXPECT_NEAR(group(report, "part").measure, 0.015 * 0.07, 1e-15);
    EXPECT_NEAR(group(report, "mould").measure, 0.035 * 0.09 - 0.015 * 0.07, 1e-15);
    for (const char* side : {"part_surface", "mould_surface"})
      EXPECT_NEAR(group(report, side).measure, 0.07 + 0.015, 1e-14);
    EXPECT_NEAR(group(report, "part_top").measure, 0.015, 1e-15);
    EXPECT_NEAR(group(report, "part_axis").measure, 0.07, 1e-14);
    EXPECT_NEAR(group(report, "mould_axis").measure, 0.02, 1e-15);
    EXPECT_NEAR(group(report, "mould_top").measure, 0.02, 1e-15);
    EXPECT_NEAR(group(report, "mould_bottom").measure, 0.035, 1e-15);
    EXPECT_NEAR(group(report, "mould_outside").measure, 0.09, 1e-14);
    EXPECT_EQ(report.n_unused_nodes, 0u);
  }
}

TEST(CylinderInMould, AWallAboveTheCastingIsInside) {
  CylinderInMould c = k_cylinder;
  c.mould_height = 0.1;
  const QualityReport report = assess(make_cylinder_in_mould(c, Shape::quad4));
  EXPECT_NEAR(group(report, "mould_inside").measure, 0.01, 1e-15);
  EXPECT_NEAR(group(report, "mould_surface").measure, 0.085, 1e-14);
}

TEST(CylinderInMould, ElementsAreFinerAtTheInterface) {
  const RawMesh raw = make_cylinder_in_mould(k_cylinder, Shape::quad4);
  const QualityReport report = assess(raw);
  EXPECT_LT(group(report, "part").shortest_edge, 0.7 * k_cylinder.element_size);
  EXPECT_LT(group(report, "part").longest_edge, 1.3 * k_cylinder.element_size);
  EXPECT_LT(group(report, "mould").longest_edge, 1.3 * k_cylinder.mould_element_size);
}

TEST(CylinderInMould, AnInterfaceRatioMakesMeshesThatDoNotMatch) {
  CylinderInMould c = k_cylinder;
  const auto faces = [](const QualityReport& report, const char* side) {
    return static_cast<double>(group(report, side).shapes.at(0).n_elements);
  };
  const QualityReport matching = assess(make_cylinder_in_mould(c, Shape::tri3));
  EXPECT_EQ(faces(matching, "mould_surface"), faces(matching, "part_surface"));
  c.interface_ratio = 1.5;
  RawMesh raw = make_cylinder_in_mould(c, Shape::tri3);
  validate_and_orient(raw, "cylinder");
  const QualityReport report = assess(raw);
  EXPECT_NEAR(faces(report, "mould_surface") / faces(report, "part_surface"), 1.5, 0.05);  // whole elements
  EXPECT_NEAR(group(report, "mould_surface").measure, 0.085, 1e-14);
  EXPECT_NEAR(group(report, "mould").measure, 0.035 * 0.09 - 0.015 * 0.07, 1e-15);
}

TEST(CylinderInMould, LengthsThatDoNotFitTogetherAreRefused) {
  CylinderInMould c = k_cylinder;
  c.mould_height = 0.05;
  EXPECT_THROW(make_cylinder_in_mould(c, Shape::tri3), std::invalid_argument);
  c = k_cylinder;
  c.radius = -1;
  EXPECT_THROW(make_cylinder_in_mould(c, Shape::tri3), std::invalid_argument);
  EXPECT_THROW(make_cylinder_in_mould(k_cylinder, Shape::tet4), std::invalid_argument);
}

TEST(BlockShape, HasItsSidesAndCells) {
  for (const Shape shape : k_body_shapes) {
    RawMesh raw = sample_box(shape, -0.1);
    validate_and_orient(raw, "box");
    const QualityReport report = assess(raw);
    const bool solid = raw.dimension == 3;
    EXPECT_NEAR(report.lowest[0], -0.1, 1e-16);
    EXPECT_NEAR(report.highest[0], 0.4, 1e-15);
    EXPECT_NEAR(group(report, "y_max").measure, 0.5 * (solid ? 0.4 : 1), 1e-15);
    EXPECT_EQ(group_names(raw).size(), solid ? 7u : 5u);
  }
  EXPECT_THROW(make_block({{1, 1}, {}, {2, 0}}, Shape::tri3), std::invalid_argument);
  EXPECT_THROW(make_block({{1, 1}, {}, {2, 2}}, Shape::hex8), std::invalid_argument);
}

TEST(TwoBlocksShape, FaceEachOtherWithDivisionsOfTheirOwn) {
  const TwoBlocks b{{0.2, 0.1}, {0.2, 0.05}, {4, 2}, {7, 2}, 0.001};
  RawMesh raw = make_two_blocks(b, Shape::quad4);
  validate_and_orient(raw, "two blocks");
  const QualityReport report = assess(raw);
  EXPECT_EQ(group(report, "lower_top").shapes.at(0).n_elements, 4u);
  EXPECT_EQ(group(report, "upper_bottom").shapes.at(0).n_elements, 7u);
  EXPECT_NEAR(report.highest[1], 0.151, 1e-16);
  const Mesh m = distribute(raw, {"lower", "upper"}, {"lower_top", "upper_bottom"});
  for (const Index i : m.surfaces.at("lower_top").nodes)
    EXPECT_NEAR(m.x[static_cast<std::size_t>(i)][1], 0.1, 1e-16);
  for (const Index i : m.surfaces.at("upper_bottom").nodes)
    EXPECT_NEAR(m.x[static_cast<std::size_t>(i)][1], 0.101, 1e-16);
}

}  // namespace
