// Poor tetrahedra leave a mesh, and its bodies keep their shape.
#include "mesh/making/poor_tetrahedra.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "mesh/making/edge_collapse.hpp"
#include "mesh/making/edge_removal.hpp"
#include "mesh/making/surface_node.hpp"
#include "mesh/making/worst_tetrahedron.hpp"
#include "mesh/quality.hpp"
#include "mesh/tetrahedra.hpp"
#include "split_block.hpp"

namespace solidus::test {

using mesh::Point;
using mesh::RawBlock;
using mesh::RawMesh;
using mesh::Shape;

namespace {

/// Two bodies of tetrahedra that share the nodes of a plane.
RawMesh two_bodies() {
  RawMesh raw = split_block(Shape::tet4, {4, 3, 3}, {4, 3, 3}, 2);
  std::erase_if(raw.groups, [](const auto& group) { return group.second.dimension < 3; });
  return raw;
}

double least_quality(const RawMesh& raw) {
  double least = 1;
  for (const auto& [name, group] : raw.groups)
    for (const RawBlock& block : group.blocks)
      for (std::size_t e = 0; e < block.nodes.size(); e += 4)
        least = std::min(least, mesh::element_quality(raw, Shape::tet4, block.nodes.data() + e));
  return least;
}

double volume(const RawMesh& raw, const std::string& body) {
  double sum = 0;
  for (const RawBlock& block : raw.groups.at(body).blocks)
    for (std::size_t e = 0; e < block.nodes.size(); e += 4) {
      const auto x = [&](std::size_t a) { return raw.x[static_cast<std::size_t>(block.nodes[e + a])]; };
      sum += mesh::volume_6(x(0), x(1), x(2), x(3)) / 6;
    }
  return sum;
}

/// How many faces one, two, ... tetrahedra have.
std::map<std::size_t, int> faces(const RawMesh& raw) {
  std::map<mesh::Triangle, std::size_t> of;
  for (const auto& [name, group] : raw.groups)
    for (const RawBlock& block : group.blocks)
      for (std::size_t e = 0; e < block.nodes.size(); e += 4)
        for (std::size_t without = 0; without < 4; ++without) {
          mesh::Triangle face{};
          for (std::size_t a = 0, i = 0; a < 4; ++a)
            if (a != without) face[i++] = block.nodes[e + a];
          std::sort(face.begin(), face.end());
          ++of[face];
        }
  std::map<std::size_t, int> counts;
  for (const auto& [face, n] : of) ++counts[n];
  return counts;
}

/// Divides the edge between two nodes close to the first one, in all tetrahedra that have it.
void divide_edge(RawMesh& raw, Index a, Index b, double at) {
  const auto node = static_cast<Index>(raw.x.size());
  Point x{};
  for (std::size_t i = 0; i < 3; ++i)
    x[i] = (1 - at) * raw.x[static_cast<std::size_t>(a)][i] + at * raw.x[static_cast<std::size_t>(b)][i];
  raw.x.push_back(x);
  raw.input_node.push_back(node + 1);
  for (auto& [name, group] : raw.groups)
    for (RawBlock& block : group.blocks)
      for (std::size_t e = 0, n = block.shape == Shape::tet4 ? block.nodes.size() : 0; e < n; e += 4) {
        const auto begin = block.nodes.begin() + static_cast<std::ptrdiff_t>(e);
        std::array<Index, 4> first{}, second{};
        std::copy_n(begin, 4, first.begin());
        second = first;
        if (std::count(first.begin(), first.end(), a) + std::count(first.begin(), first.end(), b) < 2)
          continue;
        std::replace(first.begin(), first.end(), b, node);
        std::replace(second.begin(), second.end(), a, node);
        std::copy(first.begin(), first.end(), begin);
        block.nodes.insert(block.nodes.end(), second.begin(), second.end());
        block.input_element.push_back(10000 + static_cast<GlobalIndex>(block.nodes.size()));
      }
}

Index node_at(const RawMesh& raw, const Point& place) {
  const auto found = std::find_if(raw.x.begin(), raw.x.end(), [&](const Point& x) {
    return std::abs(x[0] - place[0]) + std::abs(x[1] - place[1]) + std::abs(x[2] - place[2]) < 1e-9;
  });
  return static_cast<Index>(found - raw.x.begin());
}

}  // namespace

TEST(PoorTetrahedra, EdgesMuchShorterThanTheirNeighboursGoAndBodiesKeepTheirShape) {
  RawMesh raw = two_bodies();
  const std::size_t n_nodes = raw.x.size();
  // Inside a body, in the face that the bodies share, along an edge of that face, from a corner of all.
  const std::array<std::array<Point, 2>, 4> edges = {{{{{1, 1, 1}, {1, 2, 1}}},
                                                      {{{2, 1, 1}, {2, 2, 1}}},
                                                      {{{2, 0, 1}, {2, 0, 2}}},
                                                      {{{4, 3, 3}, {4, 2, 3}}}}};
  for (const auto& [a, b] : edges) divide_edge(raw, node_at(raw, a), node_at(raw, b), 0.02);
  ASSERT_LT(least_quality(raw), 0.1);
  for (std::size_t e = 0; e < edges.size(); ++e) {  // each could be drawn together
    const mesh::Tetrahedra tets(raw);
    const auto between = static_cast<Index>(n_nodes + e);
    EXPECT_GT(mesh::with_node_on(tets, between, node_at(raw, edges[e][0])).quality, 0.18) << e;
  }
  const double least = mesh::repair_poor_tetrahedra(raw, 0.18);
  EXPECT_GT(least, 0.18);
  EXPECT_NEAR(least, least_quality(raw), 1e-12);  // none is turned inside out either
  EXPECT_EQ(raw.input_node.size(), raw.x.size());
  EXPECT_EQ(faces(raw).rbegin()->first, 2U);
  EXPECT_NEAR(volume(raw, "left"), 18, 1e-9);
  EXPECT_NEAR(volume(raw, "right"), 18, 1e-9);
}

TEST(PoorTetrahedra, AFlatElementBetweenTwoBodiesIsTurnedOutOfTheSurface) {
  RawMesh raw;
  raw.dimension = 3;
  constexpr double k_flat = 0.02;
  raw.x = {{-1, 0, 0}, {1, 0, 0}, {0, -1, k_flat}, {0, 1, k_flat}, {0, 0, -1}, {0, 0, 1}};
  raw.input_node = {1, 2, 3, 4, 5, 6};
  const Index a = 0, b = 1, c = 2, d = 3, low = 4, high = 5;
  raw.groups["casting"] = {3, {{Shape::tet4, {a, b, c, d, a, b, c, low, a, b, d, low}, {1, 2, 3}}}};
  raw.groups["mould"] = {3, {{Shape::tet4, {a, c, d, high, b, c, d, high}, {4, 5}}}};
  mesh::validate_and_orient(raw, "five");
  ASSERT_LT(least_quality(raw), 0.2);
  EXPECT_GT(mesh::repair_poor_tetrahedra(raw, 0.3), 0.5);
  EXPECT_GT(least_quality(raw), 0.5);
  EXPECT_EQ(raw.groups.at("casting").blocks.front().input_element.size(), 2U);
  EXPECT_EQ(raw.groups.at("mould").blocks.front().input_element.size(), 2U);
  EXPECT_NEAR(volume(raw, "casting") + volume(raw, "mould"), 4.0 / 3, 0.05);
  EXPECT_NEAR(volume(raw, "mould"), 2.0 / 3, 0.03);
}

TEST(PoorTetrahedra, AnOverhangingStepOfAHundredthOfAnElementIsTurnedOutOfTheSurface) {
  RawMesh raw;
  raw.dimension = 3;
  raw.x = {{-1, 0, 0}, {1, 0, 0}, {0, -0.005, 0.02}, {0, -1, 0}, {0, 0.5, -1}, {0, -0.6, 1}};
  raw.input_node = {1, 2, 3, 4, 5, 6};
  const Index a = 0, b = 1, c = 2, d = 3, low = 4, high = 5;
  raw.groups["casting"] = {3, {{Shape::tet4, {a, b, d, low, a, b, low, c}, {1, 2}}}};
  raw.groups["mould"] = {3, {{Shape::tet4, {a, b, c, high, a, b, high, d}, {3, 4}}}};
  mesh::validate_and_orient(raw, "four");
  EXPECT_NE(mesh::worst_tetrahedron_text(raw).find("in 'casting' around"), std::string::npos);
  ASSERT_LT(least_quality(raw), 0.15);
  EXPECT_GT(mesh::without_edge(mesh::Tetrahedra(raw), a, b).quality, 0.3);
  const double whole = volume(raw, "casting") + volume(raw, "mould");
  EXPECT_GT(mesh::repair_poor_tetrahedra(raw, 0.3), 0.3);
  EXPECT_NEAR(volume(raw, "casting") + volume(raw, "mould"), whole, 0.02);
}

TEST(PoorTetrahedra, NodesMayMoveWithinCurvedSurfacesAndAlongCurvedEdgesAndNotFromCorners) {
  constexpr int k_around = 24;
  RawMesh raw = split_block(Shape::tet4, {1, 1, 1}, {k_around, 3, 2}, 0.5);
  std::erase_if(raw.groups, [](const auto& group) { return group.second.dimension < 3; });
  // A quarter of a pipe of radius 1 to 1.2.
  const auto bent = [](const Point& x) {
    const double angle = 0.5 * std::numbers::pi * x[0], radius = 1 + 0.2 * x[2];
    return Point{radius * std::cos(angle), 0.2 * x[1], radius * std::sin(angle)};
  };
  for (Point& x : raw.x) x = bent(x);
  mesh::validate_and_orient(raw, "pipe");
  const mesh::Tetrahedra tets(raw);
  constexpr double k_step = 0.01;
  const double sagitta = 1.2 * (1 - std::cos(0.5 * std::numbers::pi / k_around));
  const auto places = [&](const Point& x) {
    const Index node = node_at(raw, bent(x));
    const mesh::SurfaceNode surface(tets, node);
    EXPECT_TRUE(surface.keeps_surface());
    std::vector<Point> all = surface.places(k_step);
    for (const Point& p : all) {
      const Point& from = raw.x[static_cast<std::size_t>(node)];
      EXPECT_NEAR(std::hypot(p[0] - from[0], p[1] - from[1], p[2] - from[2]), k_step, 0.05 * k_step);
    }
    return all;
  };
  EXPECT_EQ(places({0.25, 1.0 / 3, 0.5}).size(), 6u);  // within
  const std::vector<Point> outside = places({0.25, 1.0 / 3, 1}), edge = places({0.25, 0, 1});
  ASSERT_EQ(outside.size(), 4u);
  ASSERT_EQ(edge.size(), 2u);
  for (const std::vector<Point>& some : {outside, edge})
    for (const Point& p : some) {
      EXPECT_LE(std::hypot(p[0], p[2]), 1.2 + 1e-12);
      EXPECT_GT(std::hypot(p[0], p[2]), 1.2 - sagitta);
    }
  for (const Point& p : edge) EXPECT_NEAR(p[1], 0, 1e-12);
  EXPECT_EQ(places({0, 0, 1}).size(), 0u);    // a corner
  EXPECT_EQ(places({0.5, 0, 1}).size(), 0u);  // where two bodies meet an edge
}

TEST(PoorTetrahedra, AMeshWithoutPoorElementsAndOneWhoseNodesOthersHoldStayAsTheyAre) {
  RawMesh raw = two_bodies();
  const std::vector<Point> before = raw.x;
  mesh::repair_poor_tetrahedra(raw, 0.18);
  EXPECT_EQ(raw.x, before);
  RawMesh held = split_block(Shape::tet4, {4, 3, 3}, {4, 3, 3}, 2);  // the plane between is a group
  divide_edge(held, node_at(held, {1, 1, 1}), node_at(held, {1, 2, 1}), 0.02);
  const RawBlock between = held.groups.at("between").blocks.front();
  const std::vector<Point> x = held.x;
  EXPECT_GT(mesh::repair_poor_tetrahedra(held, 0.18), 0.18);
  const RawBlock& after = held.groups.at("between").blocks.front();
  ASSERT_EQ(after.nodes.size(), between.nodes.size());
  for (std::size_t i = 0; i < after.nodes.size(); ++i)
    EXPECT_EQ(held.x[static_cast<std::size_t>(after.nodes[i])],
              x[static_cast<std::size_t>(between.nodes[i])]);
}

}  // namespace solidus::test
