/// Faces of bodies that face each other, nodes that bodies share, groups of faces by rule, and what is
/// measured on geometries: thickness, inscribed spheres, sizes.
#include "mesh/making/body_interfaces.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "mesh/making/hot_spots.hpp"
#include "mesh/making/parametric_meshes.hpp"
#include "mesh/making/size_field.hpp"
#include "mesh/surfaces/face_rules.hpp"
#include "mesh/surfaces/skin.hpp"
#include "split_block.hpp"
#include "system/errors.hpp"
#include "system/log.hpp"

namespace solidus::mesh {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

double area(const RawMesh& mesh, const std::string& group) {
  double sum = 0;
  for (const RawBlock& block : mesh.groups.at(group).blocks) {
    const auto n = static_cast<std::size_t>(node_count(block.shape));
    for (std::size_t f = 0; f < block.nodes.size(); f += n) {
      const Point& a = mesh.x[static_cast<std::size_t>(block.nodes[f])];
      const Point& b = mesh.x[static_cast<std::size_t>(block.nodes[f + 1])];
      if (n == 2) {
        sum += std::hypot(a[0] - b[0], a[1] - b[1]);
        continue;
      }
      const Point& c = mesh.x[static_cast<std::size_t>(block.nodes[f + 2])];
      const Point u{b[0] - a[0], b[1] - a[1], b[2] - a[2]}, v{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
      const double twice =
          std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]);
      sum += vertex_count(block.shape) == 4 ? twice : twice / 2;
    }
  }
  return sum;
}

// A block of 3 x 2 x 1 whose left third is one body, the rest another.
TEST(BodyInterfaces, BodiesThatShareNodesAreSplitAndTheGroupsOfTheirFacesStayWithTheFirst) {
  for (const Shape shape : {Shape::hex8, Shape::tet4, Shape::tet10}) {
    RawMesh mesh = test::split_block(shape, {3, 2, 1}, {3, 2, 1}, 1);
    const std::vector<std::string> bodies = {"left", "right"};
    const std::size_t before = mesh.x.size();
    const std::vector<SplitNodes> shared = shared_by(mesh, bodies);
    ASSERT_EQ(shared.size(), 1U);
    split_nodes(mesh, bodies, {{0, 1}});
    EXPECT_EQ(mesh.x.size(), before + shared[0].nodes);
    EXPECT_TRUE(shared_by(mesh, bodies).empty());
    const std::vector<Facing> found = find_facing(mesh, bodies, {"a", "b"}, {{{0, 1}, 0}}, {}, "block");
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NEAR(found[0].covered_a, 2, 1e-12);
    EXPECT_NEAR(found[0].covered_b, 2, 1e-12);
    EXPECT_NEAR(found[0].largest_gap, 0, 1e-12);
    EXPECT_NEAR(area(mesh, "a_to_b"), 2, 1e-12);
    EXPECT_NEAR(area(mesh, "b_to_a"), 2, 1e-12);
    EXPECT_NEAR(area(mesh, "a_free"), 2 + 2 * (2 + 1), 1e-12);
    EXPECT_NEAR(area(mesh, "b_free"), 2 + 2 * 2 * (2 + 1), 1e-12);
    // The group that was there before is one of the first body's faces.
    for (const Index node : mesh.groups.at("between").blocks[0].nodes)
      EXPECT_LT(static_cast<std::size_t>(node), before);
    EXPECT_NO_THROW(validate_and_orient(mesh, "block"));
  }
}

// A casting and its riser share nodes and stay one: no film is meant for the joint within the metal.
TEST(BodyInterfaces, TheJointOfBodiesThatStayOneIsNoFreeSkin) {
  RawMesh mesh = test::split_block(Shape::hex8, {3, 2, 1}, {3, 2, 1}, 1);
  EXPECT_TRUE(find_facing(mesh, {"left", "right"}, {"a", "b"}, {}, {}, "block").empty());
  EXPECT_NEAR(area(mesh, "a_free"), 2 + 2 * (2 + 1), 1e-12);
  EXPECT_NEAR(area(mesh, "b_free"), 2 + 2 * 2 * (2 + 1), 1e-12);
}

// Three slabs in a row, the middle one thinner than the distance that is looked within: the outer ones do not
// face each other through it, for each of their faces is one with a face of the middle.
TEST(BodyInterfaces, AFaceThatIsOneWithAnothersFacesNoThirdBody) {
  RawMesh mesh = test::split_block(Shape::hex8, {3, 2, 1}, {30, 2, 1}, 1);
  RawBlock& rest = mesh.groups.at("right").blocks[0];
  RawGroup thin = mesh.groups.at("right");
  thin.blocks[0].nodes.clear();
  std::vector<Index> kept;
  for (std::size_t e = 0; e < rest.nodes.size(); e += 8) {
    double x = 0;
    for (std::size_t k = 0; k < 8; ++k) x += mesh.x[static_cast<std::size_t>(rest.nodes[e + k])][0] / 8;
    std::vector<Index>& to = x < 1.1 ? thin.blocks[0].nodes : kept;
    to.insert(to.end(), rest.nodes.begin() + static_cast<long>(e),
              rest.nodes.begin() + static_cast<long>(e) + 8);
  }
  rest.nodes = kept;
  mesh.groups["thin"] = thin;
  const std::vector<std::string> bodies = {"left", "thin", "right"};
  split_nodes(mesh, bodies, {{0, 1}, {1, 2}, {0, 2}});
  const std::vector<Facing> found =
      find_facing(mesh, bodies, bodies, {{{0, 1}, 0.3}, {{0, 2}, 0.3}, {{1, 2}, 0.3}}, {}, "block");
  ASSERT_EQ(found.size(), 2U);
  for (const Facing& facing : found) {
    EXPECT_NE(facing.bodies, (BodyPair{0, 2}));
    EXPECT_NEAR(facing.area_a, 2, 1e-12);
    EXPECT_NEAR(facing.area_b, 2, 1e-12);
    EXPECT_NEAR(facing.covered_a, 2, 1e-12);
  }
}

TEST(BodyInterfaces, FacesOfMeshesThatDoNotMatchAreFoundAcrossAGap) {
  RawMesh mesh = make_two_blocks({{4, 4, 1}, {2, 2, 1}, {3, 3, 1}, {5, 5, 1}, 0.05}, Shape::hex8);
  const std::vector<std::string> bodies = {"lower", "upper"};
  EXPECT_TRUE(find_facing(mesh, bodies, {"p", "q"}, {{{0, 1}, 0.04}}, {}, "two blocks").empty());
  const std::vector<Facing> found = find_facing(mesh, bodies, bodies, {{{0, 1}, 0.1}}, {}, "two blocks");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].covered_b, 4, 1e-12);  // the upper one's whole foot
  EXPECT_NEAR(found[0].area_b, 4, 1e-12);
  EXPECT_NEAR(found[0].covered_a, 4, 2);  // of coarse faces by points on them
  EXPECT_NEAR(found[0].mean_gap, 0.05, 1e-12);
  EXPECT_NEAR(area(mesh, "upper_to_lower"), 4, 1e-12);
}

TEST(BodyInterfaces, InThePlaneFacesAreLines) {
  RawMesh mesh = make_two_blocks({{4, 1}, {4, 1}, {4, 1}, {3, 1}, 0}, Shape::quad4);
  const std::vector<Facing> found =
      find_facing(mesh, {"lower", "upper"}, {"lower", "upper"}, {{{0, 1}, 0}}, {}, "two blocks");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].covered_a, 4, 1e-12);
  EXPECT_NEAR(found[0].covered_b, 4, 1e-12);
}

TEST(BodyInterfaces, WhatLiesInThePlaneOfACutIsNoFreeSkin) {
  RawMesh mesh = test::split_block(Shape::hex8, {2, 1, 1}, {2, 1, 1}, 1);
  split_nodes(mesh, {"left", "right"}, {{0, 1}});
  find_facing(mesh, {"left", "right"}, {"left", "right"}, {{{0, 1}, 0}}, HalfSpace{1, 1.0}, "block");
  EXPECT_NEAR(area(mesh, "left_symmetry"), 1, 1e-12);
  EXPECT_NEAR(area(mesh, "left_free"), 4, 1e-12);
}

TEST(FaceRules, ChooseByOwnerNormalPlaneBoxAndNearestPlace) {
  RawMesh mesh = make_two_blocks({{4, 4, 1}, {2, 2, 1}, {4, 4, 1}, {2, 2, 1}, 0.5}, Shape::tet4);
  const std::vector<std::string> bodies = {"lower", "upper"};
  const auto chosen = [&](FaceRule rule) {
    rule.name = "chosen";
    mesh.groups.erase("chosen");
    add_faces_by_rule(mesh, bodies, rule, "two blocks");
    return area(mesh, "chosen");
  };
  constexpr double k_degree = std::numbers::pi / 180;
  EXPECT_NEAR(chosen({.name = "", .owner = "upper"}), 2 * 4 + 4 * 2, 1e-12);
  EXPECT_NEAR(chosen({.name = "", .normal = Point{0, 0, 2}, .angle = 10 * k_degree}), 16 + 4, 1e-12);
  EXPECT_NEAR(chosen({.name = "", .normal = Point{0, 0, 1}, .angle = 10 * k_degree, .plane = Point{9, 9, 1}}),
              16, 1e-12);
  EXPECT_NEAR(chosen({.name = "", .owner = "lower", .box = {{Point{0, 0, 0}, Point{4, 0, 1}}}}), 4, 1e-12);
  EXPECT_NEAR(chosen({.name = "", .nearest = Point{2, 2, -3}}), 16, 1e-12);
  try {
    chosen({.name = "", .normal = Point{1, 1, 1}, .angle = k_degree});
    FAIL() << "no face looks there";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("no face of the mesh fits the rule of the group 'chosen'"));
  }
  EXPECT_THROW(chosen({.name = "", .owner = "uper"}), InputError);
}

/// A prism of six sides about z as tetrahedra of one body 'bar': its sides meet at 60 degrees, as the facets
/// of a round in coarse elements do.
RawMesh prism_of_six_sides() {
  RawMesh mesh;
  mesh.dimension = 3;
  for (const double z : {0.0, 1.0}) {
    mesh.x.push_back({0, 0, z});
    for (int i = 0; i < 6; ++i)
      mesh.x.push_back({std::cos(i * std::numbers::pi / 3), std::sin(i * std::numbers::pi / 3), z});
  }
  RawBlock block{Shape::tet4, {}, {}};
  for (Index i = 0; i < 6; ++i) {
    const Index a = 1 + i, b = 1 + (i + 1) % 6, low = std::min(a, b), high = std::max(a, b);
    // The diagonal of each side begins at its lower number, so that neighbours fit.
    for (const std::array<Index, 4>& nodes :
         {std::array<Index, 4>{0, low, high, static_cast<Index>(high + 7)},
          {0, low, static_cast<Index>(low + 7), static_cast<Index>(high + 7)},
          {0, 7, static_cast<Index>(low + 7), static_cast<Index>(high + 7)}})
      block.nodes.insert(block.nodes.end(), nodes.begin(), nodes.end());
  }
  for (std::size_t n = 0; n < mesh.x.size(); ++n) mesh.input_node.push_back(static_cast<GlobalIndex>(n + 1));
  for (std::size_t e = 0; e < block.nodes.size() / 4; ++e)
    block.input_element.push_back(static_cast<GlobalIndex>(e + 1));
  mesh.groups["bar"] = {3, {block}};
  validate_and_orient(mesh, "prism");
  return mesh;
}

TEST(FaceRules, AStripOfACurvedFaceTellsItsShare) {
  RawMesh mesh = prism_of_six_sides();
  logging::clear_warnings();
  add_faces_by_rule(mesh, {"bar"}, {.name = "round", .nearest = Point{5, 3, 0.5}}, "prism");
  EXPECT_NEAR(area(mesh, "round"), 1, 1e-9);
  EXPECT_THAT(
      logging::warnings(),
      ElementsAre(HasSubstr("the group 'round' takes 1e+04 of the 6e+04 cm2 of a curved face (17 %)")));
}

TEST(FaceRules, ASideOfABlockIsTakenWholeAndNothingIsSaid) {
  RawMesh mesh = make_block({{3, 2, 1}, {}, {1, 1, 1}}, Shape::tet4);
  logging::clear_warnings();
  add_faces_by_rule(mesh, {"block"}, {.name = "side", .nearest = Point{9, 1, 0.5}}, "block");
  EXPECT_THAT(logging::warnings(), IsEmpty());
}

TEST(FaceRules, PatchesTellAreaNormalAndNeighbours) {
  const RawMesh mesh = make_block({{3, 2, 1}, {}, {3, 2, 1}}, Shape::hex8);
  const std::vector<SkinPatch> patches = skin_patches(mesh, {"block"}, std::numbers::pi / 6);
  ASSERT_EQ(patches.size(), 6U);
  EXPECT_NEAR(patches[0].area, 6, 1e-12);
  EXPECT_NEAR(std::abs(patches[0].normal[2]), 1, 1e-12);
  EXPECT_EQ(patches[0].neighbours.size(), 4U);
  EXPECT_THAT(to_text(patches), HasSubstr("block"));
}

TEST(HotSpots, ABlockHoldsASphereOfItsLeastSideAndItsWallsAreAsThickAsItsSides) {
  const RawMesh mesh = make_block({{3, 2, 1}, {}, {9, 6, 3}}, Shape::tet4);
  const std::vector<InscribedSphere> spheres = inscribed_spheres(mesh, {"block"}, 3);
  ASSERT_FALSE(spheres.empty());
  EXPECT_NEAR(spheres[0].radius, 0.5, 0.01);
  const std::vector<double> thickness = thickness_by_area(mesh, "block");
  EXPECT_NEAR(thickness.front(), 1, 1e-9);  // 12 of 22 of its skin
  EXPECT_NEAR(thickness[50], 1, 1e-9);
  EXPECT_NEAR(thickness.back(), 3, 1e-9);
  const BodyExtent extent = extent_of(mesh, "block");
  EXPECT_NEAR(extent.volume, 6, 1e-12);
  EXPECT_NEAR(extent.area, 22, 1e-12);
  EXPECT_NEAR(extent.centre[0], 1.5, 1e-12);
  EXPECT_NEAR(ViewFromAbove(mesh, {"block"}).top({1.5, 1, 0.2}), 1, 1e-12);
}

TEST(HotSpots, OnAPlaneTheCentreLiesThereThoughTheBodyIsThickerBesideIt) {
  const RawMesh mesh = make_block({{3, 2, 1}, {}, {9, 6, 3}}, Shape::tet4);
  // 0.2 from the side x = 0, which is nearer than top and bottom are from the middle.
  const std::vector<InscribedSphere> spheres = inscribed_spheres(mesh, {"block"}, 3, HalfSpace{0, 0.2});
  ASSERT_FALSE(spheres.empty());
  for (const InscribedSphere& sphere : spheres) {
    EXPECT_EQ(sphere.centre[0], 0.2);
    EXPECT_NEAR(sphere.radius, 0.2, 1e-9);
  }
  const std::vector<InscribedSphere> middle = inscribed_spheres(mesh, {"block"}, 3, HalfSpace{1, 1});
  ASSERT_FALSE(middle.empty());
  EXPECT_EQ(middle.front().centre[1], 1);
  EXPECT_NEAR(middle.front().radius, 0.5, 0.01);
  EXPECT_TRUE(inscribed_spheres(mesh, {"block"}, 3, HalfSpace{2, 5}).empty());
}

TEST(SizeField, GrowsWithTheDistanceFromSmallElements) {
  const std::array<Point, 3> corner = {Point{0, 0, 0}, Point{0, 0, 0}, Point{0, 0, 0}};
  const SizeField field({0, 0, 0}, {10, 10, 10}, {{corner, 0.1}}, 0.5, 50);
  EXPECT_NEAR(field.at({0.05, 0.05, 0.05}), 0.1, 1e-12);
  for (const double d : {2.0, 5.0, 9.0}) {
    EXPECT_NEAR(field.at({d, 0, 0}), 0.1 + 0.5 * d, 0.15);
    // Along the axes and the diagonals of cells distances are exact, between them 9 % too long at most.
    EXPECT_NEAR(field.at({d, d / 2, 0}), 0.1 + 0.5 * d * std::sqrt(1.25), 0.05 * d + 0.2);
  }
}

}  // namespace
}  // namespace solidus::mesh
