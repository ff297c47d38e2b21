// Meshes in which things are twice, inside, not joined or in one place.
#include "mesh/surfaces/soundness.hpp"

#include <gtest/gtest.h>

#include "sample_mesh.hpp"

namespace {

using namespace solidus;
using namespace solidus::test;

/// Two boxes of 4 x 3 x 2 cells side by side, or plates of 4 x 3, as one body of two halves whose nodes are
/// not merged.
RawMesh two_halves(Shape shape, double shift = 0.5) {
  RawMesh mesh = sample_box(shape);
  const RawMesh other = sample_box(shape, shift);
  const auto n = static_cast<Index>(mesh.x.size());
  mesh.x.insert(mesh.x.end(), other.x.begin(), other.x.end());
  for (std::size_t i = 0; i < other.x.size(); ++i) mesh.input_node.push_back(n + static_cast<Index>(i) + 1);
  RawBlock& block = mesh.groups.at("block").blocks[0];
  for (const Index node : other.groups.at("block").blocks[0].nodes) block.nodes.push_back(n + node);
  const std::size_t n_elements = other.groups.at("block").blocks[0].input_element.size();
  for (std::size_t e = 0; e < n_elements; ++e)
    block.input_element.push_back(static_cast<GlobalIndex>(n_elements + e + 1));
  return mesh;
}

std::vector<char> none(const RawMesh& mesh) {
  return std::vector<char>(mesh.x.size(), 0);
}

TEST(Soundness, HalvesWhoseFacesLieOnEachOtherAreFoundAndJoined) {
  for (const Shape shape : k_body_shapes) {
    SCOPED_TRACE(name(shape));
    RawMesh mesh = two_halves(shape);
    EXPECT_EQ(n_pieces(mesh, "block"), 2u);
    const std::size_t before = faces_on_skin(mesh, "block").size();
    const Crack crack = find_crack(mesh, faces_on_skin(mesh, "block"), none(mesh));
    const bool triangles = shape == Shape::tet4 || shape == Shape::tet10;
    ASSERT_EQ(crack.n_pairs, mesh.dimension == 2 ? 3u : triangles ? 12u : 6u);
    EXPECT_NEAR(crack.where[0], 0.5, 1e-12);
    replace_nodes(mesh, crack.replaced);
    EXPECT_EQ(n_pieces(mesh, "block"), 1u);
    EXPECT_EQ(faces_on_skin(mesh, "block").size(), before - 2 * crack.n_pairs);
    EXPECT_EQ(find_crack(mesh, faces_on_skin(mesh, "block"), none(mesh)).n_pairs, 0u);
    validate_and_orient(mesh, "joined");
  }
}

TEST(Soundness, ASoundMeshHasNoCrackAndNoHangingNode) {
  for (const Shape shape : k_body_shapes) {
    RawMesh mesh = sample_box(shape);
    distort(mesh, 0.02);
    const auto skin = faces_on_skin(mesh, "block");
    EXPECT_EQ(find_crack(mesh, skin, none(mesh)).n_pairs, 0u) << name(shape);
    EXPECT_EQ(hanging_nodes(mesh, skin, none(mesh)).n, 0u) << name(shape);
    EXPECT_EQ(n_pieces(mesh, "block"), 1u);
  }
}

TEST(Soundness, FacesOfAContactAreMeantToBeApart) {
  const RawMesh mesh = two_halves(Shape::hex8);
  EXPECT_EQ(find_crack(mesh, faces_on_skin(mesh, "block"), std::vector<char>(mesh.x.size(), 1)).n_pairs, 0u);
}

TEST(Soundness, PartsThatTouchAtADistanceAreNotJoined) {
  const RawMesh mesh = two_halves(Shape::hex8, 0.501);
  EXPECT_EQ(find_crack(mesh, faces_on_skin(mesh, "block"), none(mesh)).n_pairs, 0u);
  EXPECT_EQ(hanging_nodes(mesh, faces_on_skin(mesh, "block"), none(mesh)).n, 0u);
}

TEST(Soundness, NodesThatHangInFacesOfTheCoarserSideAreFound) {
  for (const Shape shape : {Shape::quad4, Shape::hex8, Shape::tet4}) {
    RawMesh mesh = two_halves(shape);
    // The second half slides along the joint by a third of a cell: its corners lie within faces.
    const std::size_t half = mesh.x.size() / 2;
    for (std::size_t i = half; i < mesh.x.size(); ++i) mesh.x[i][1] += 0.1 / 3;
    const HangingNodes hanging = hanging_nodes(mesh, faces_on_skin(mesh, "block"), none(mesh));
    EXPECT_GE(hanging.n, mesh.dimension == 2 ? 6u : 18u) << name(shape);
    EXPECT_NEAR(hanging.where[0], 0.5, 1e-12);
  }
}

TEST(Soundness, WhatIsThereTwiceIsLeftOut) {
  RawMesh mesh = sample_box(Shape::hex8);
  for (const char* group : {"block", "x_max"}) {
    RawBlock& block = mesh.groups.at(group).blocks[0];
    const RawBlock whole = block;
    block.nodes.insert(block.nodes.end(), whole.nodes.begin(),
                       whole.nodes.begin() + 2 * node_count(block.shape));
    block.input_element.push_back(1001);
    block.input_element.push_back(1002);
    EXPECT_EQ(drop_repeated(mesh.groups.at(group)), 2u) << group;
    EXPECT_EQ(block.nodes, whole.nodes);
    EXPECT_EQ(block.input_element, whole.input_element);
    EXPECT_EQ(drop_repeated(mesh.groups.at(group)), 0u);
  }
}

TEST(Soundness, FacesBetweenTwoElementsOfABodyAreInside) {
  const RawMesh mesh = sample_box(Shape::hex8);
  const std::vector<std::vector<OuterFace>> skins = {faces_on_skin(mesh, "block")};
  EXPECT_EQ(inner_faces(mesh, {"block"}, skins, mesh.groups.at("x_max")).n, 0u);
  // The face of the first element that its neighbour along x has too.
  RawGroup faces = mesh.groups.at("x_max");
  const Index* element = mesh.groups.at("block").blocks[0].nodes.data();
  for (int f = 0; f < 6; ++f) {
    for (const int a : face_nodes(Shape::hex8, f)) faces.blocks[0].nodes.push_back(element[a]);
    faces.blocks[0].input_element.push_back(f);
  }
  const InnerFaces inner = inner_faces(mesh, {"block"}, skins, faces);
  EXPECT_EQ(inner.n, 3u);
  EXPECT_EQ(inner.n_all, 12u);
}

TEST(Soundness, ABodyInThePlaceOfAnotherIsInsideOfItsSkin) {
  for (const Shape shape : {Shape::quad4, Shape::tri6, Shape::hex8, Shape::tet4}) {
    const RawMesh mesh = sample_box(shape);
    EXPECT_DOUBLE_EQ(share_inside(mesh, "block", faces_on_skin(mesh, "block")), 1) << name(shape);
    RawMesh beside = two_halves(shape);
    RawGroup second = beside.groups.at("block");
    const auto half = static_cast<std::ptrdiff_t>(second.blocks[0].nodes.size() / 2);
    second.blocks[0].nodes.erase(second.blocks[0].nodes.begin(), second.blocks[0].nodes.begin() + half);
    beside.groups.at("block").blocks[0].nodes.resize(static_cast<std::size_t>(half));
    beside.groups["second"] = second;
    EXPECT_DOUBLE_EQ(share_inside(beside, "second", faces_on_skin(beside, "block")), 0) << name(shape);
  }
}

}  // namespace
