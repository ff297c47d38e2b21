/// The heat that a mould takes while it is filled.
#include "setup/filled_mould.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace solidus::setup {
namespace {

/// A row of nodes below a wall at z = 0, a millimetre apart, each for a cubic millimetre.
struct Row {
  mesh::Mesh mesh;
  std::vector<Index> nodes;
  std::vector<double> weights, enthalpies;
  explicit Row(int n) : weights(static_cast<std::size_t>(n), 1e-9), enthalpies(weights.size(), 0.0) {
    for (int k = 0; k < n; ++k) {
      mesh.x.push_back({0, 0, -1e-3 * k});
      nodes.push_back(k);
    }
  }
  double heat_for(double heat, double limit) {
    const std::vector<FilledWall> walls = {{0, {0, 0, 0}, heat, 0.1}};
    add_heat_of_walls(walls, mesh, nodes, weights, 1e-6, limit, enthalpies);
    return std::inner_product(weights.begin(), weights.end(), enthalpies.begin(), 0.0);
  }
};

TEST(FilledMould, HeatOfAWallGoesDeeperWhereTheFirstNodesWouldGetHotterThanTheMetal) {
  Row row(20);
  EXPECT_NEAR(row.heat_for(5e-3, 1e6), 5e-3, 1e-14);
  EXPECT_LE(*std::ranges::max_element(row.enthalpies), 1e6 * (1 + 1e-12));
  EXPECT_TRUE(std::ranges::is_sorted(row.enthalpies, std::greater<>()));
  EXPECT_GT(row.enthalpies[5], 1e5);
}

TEST(FilledMould, HeatThatFindsRoomStaysWhereItIs) {
  Row bounded(20), free(20);
  EXPECT_NEAR(bounded.heat_for(1e-3, 1e9), 1e-3, 1e-14);
  EXPECT_NEAR(free.heat_for(1e-3, 1e12), 1e-3, 1e-14);
  EXPECT_EQ(bounded.enthalpies, free.enthalpies);
  EXPECT_GT(bounded.enthalpies[0], 2 * bounded.enthalpies[1]);
}

TEST(FilledMould, MoreHeatThanABodyCanHoldIsNotLost) {
  Row row(3);
  EXPECT_NEAR(row.heat_for(5e-3, 1e6), 5e-3, 1e-14);
}

}  // namespace
}  // namespace solidus::setup
