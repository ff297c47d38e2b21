#include "mesh/making/metal_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "mesh/making/parametric_meshes.hpp"

namespace solidus::mesh {
namespace {

/// Two cubes of 40 mm with a bar of 10 mm between them, 60 mm long.
class Dumbbell : public testing::Test {
 protected:
  Dumbbell() {
    add("left", {0, 0, 0}, {0.04, 0.04, 0.04});
    add("bar", {0.04, 0.015, 0.015}, {0.06, 0.01, 0.01});
    add("right", {0.1, 0, 0}, {0.04, 0.04, 0.04});
  }

  void add(const std::string& name, const Point& low, const std::vector<double>& size) {
    const RawMesh block = make_block({.size = size, .origin = {}, .divisions = {2, 2, 2}}, Shape::hex8);
    const auto before = static_cast<Index>(mesh.x.size());
    for (Point p : block.x) {
      for (std::size_t i = 0; i < 3; ++i) p[i] += low[i];
      mesh.x.push_back(p);
    }
    RawGroup group = block.groups.at("block");
    for (RawBlock& b : group.blocks)
      for (Index& node : b.nodes) node += before;
    mesh.dimension = 3;
    mesh.groups[name] = group;
  }

  RawMesh mesh;
  const Point left{0.02, 0.02, 0.02}, bar{0.07, 0.02, 0.02}, right{0.12, 0.02, 0.02};
};

TEST_F(Dumbbell, DepthsAreDistancesFromTheSkinToHalfAnEdge) {
  const MetalGrid grid(mesh, {"left", "bar", "right"}, 20000);
  EXPECT_NEAR(grid.depth(grid.cube_at(left)), 0.02, 0.7 * grid.edge());
  EXPECT_NEAR(grid.depth(grid.cube_at(bar)), 0.005, 0.7 * grid.edge());
  EXPECT_TRUE(grid.on_ridge(grid.cube_at(bar)));
  EXPECT_FALSE(grid.on_ridge(grid.cube_at({0.02, 0.02, 0.005})));
}

TEST_F(Dumbbell, TheWidestWayFromOneEndToTheOtherIsAsNarrowAsTheBar) {
  const MetalGrid grid(mesh, {"left", "bar", "right"}, 20000);
  const std::vector<double> widest = grid.widest_ways(grid.cube_at(left));
  EXPECT_NEAR(widest[grid.cube_at(right)], 0.005, 0.7 * grid.edge());
  EXPECT_NEAR(widest[grid.cube_at({0.02, 0.02, 0.01})], grid.depth(grid.cube_at({0.02, 0.02, 0.01})), 1e-12);
}

TEST_F(Dumbbell, ShortestWaysLeadThroughMetalAndEndAtTheNearestPlace) {
  const MetalGrid grid(mesh, {"left", "bar", "right"}, 20000);
  const WaysInMetal ways = grid.shortest_ways({{{0.02, 0.02, 0.04}, 0.01, 0}});
  const std::size_t end = grid.cube_at({0.138, 0.02, 0.02});
  EXPECT_NEAR(ways.length[end], 0.12, 0.01);  // down from the top, and along the bar
  EXPECT_EQ(ways.from[end], 0);
  const WaysInMetal two = grid.shortest_ways({{{0.02, 0.02, 0.04}, 0.01, 0}, {{0.12, 0.02, 0.04}, 0.01, 0}});
  EXPECT_EQ(two.from[end], 1);
  std::size_t between = 0;
  for (std::size_t c = 0; c < grid.size(); ++c) between += grid.between_places(c, two) ? 1 : 0;
  EXPECT_GT(between, 0U);
}

TEST_F(Dumbbell, TheVolumeInABallIsThatOfTheMetal) {
  const MetalGrid grid(mesh, {"left", "bar", "right"}, 20000);
  EXPECT_NEAR(grid.volume_in({0.07, 0.02, 0.02}, 1), 2 * 6.4e-5 + 6e-6, 6e-6);
  EXPECT_NEAR(grid.volume_in(left, 0.015), 4.0 / 3 * 3.14159 * 0.015 * 0.015 * 0.015, 3e-7);
}

}  // namespace
}  // namespace solidus::mesh
