/// Sweeps over the nodes where the residual of a step is concentrated, on any number of processes.
#include "heat/iteration/local_sweeps.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../linear/grid.hpp"
#include "parallel/parallel.hpp"

namespace solidus::heat {
namespace {

using linear::BlockMatrix;

constexpr double k_capacity = 1;  ///< heat content of a node over the time of the step [W/K]

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

/// Conduction between the nodes of each quad, by half of the matrix.
struct Conduction {
  test::Grid grid;
  BlockMatrix matrix;
  parallel::GhostExchange ghosts;

  Conduction(int nx, int ny)
      : grid(nx, ny), matrix(grid.mesh, 1, graph(grid), BlockMatrix::Storage::upper), ghosts(grid.mesh) {
    const auto slots = matrix.clique_slots(grid.quads, 4);
    for (std::size_t q = 0; q < slots.size(); q += 16)
      for (std::size_t a = 0; a < 4; ++a)
        for (std::size_t b = 0; b < 4; ++b) *matrix.block(slots[q + 4 * a + b]) += a == b ? 3.0 : -1.0;
  }
  static linear::NodeGraph graph(const test::Grid& grid) {
    linear::NodeGraph g(grid.mesh);
    g.add_cliques(grid.quads, 4);
    return g;
  }
  /// A_ii and Σ|A_ij| over nodes of other processes.
  double diagonal(std::size_t i) const {
    double sum = *matrix.block(matrix.row_start()[i]);
    for (auto s = matrix.row_start()[i]; s < matrix.row_start()[i + 1]; ++s)
      if (matrix.columns()[at(static_cast<Index>(s))] >= grid.mesh.n_owned_nodes)
        sum += std::abs(*matrix.block(s));
    return sum;
  }
};

// The rows of nodes are split over the processes: the middle, where the residual is, lies at a border.
TEST(LocalSweeps, BringTheResidualDownAtTheBordersOfProcessesToo) {
  Conduction heat(20, 12);
  const std::size_t n = at(heat.grid.mesh.n_owned_nodes);
  std::vector<double> residual(n), product(n), change(heat.grid.mesh.x.size());
  for (std::size_t i = 0; i < n; ++i) {
    const GlobalIndex row = heat.grid.global(static_cast<Index>(i)) / 20;
    residual[i] = row == 5 || row == 6 ? 1.0 : 0.01;
  }
  const std::vector<char> fixed(change.size(), 0);
  LocalSweeps sweeps(heat.matrix, residual, fixed, heat.ghosts);
  sweeps.run([&](std::size_t i, double r) {
    const double by = -r / (k_capacity + heat.diagonal(i));
    change[i] += by;
    return NodeChange{by, k_capacity * by};
  });
  heat.ghosts.update(change, 1);
  heat.matrix.multiply(change, product);
  double most = 0, functional = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double by = product[i] + k_capacity * change[i];
    functional += change[i] * (0.5 * by + residual[i]);
    if (residual[i] == 1.0) most = std::max(most, std::abs(residual[i] + by));
  }
  EXPECT_LT(parallel::global_max(most), 0.5);
  EXPECT_LT(parallel::global_sum(functional), -1.0);
}

}  // namespace
}  // namespace solidus::heat
