/// Systems of springs on a grid of nodes that is split over the processes.
#pragma once

#include <cmath>
#include <functional>

#include "grid.hpp"
#include "linear/block_matrix.hpp"

namespace solidus::test {

using linear::BlockMatrix;
using linear::NodeGraph;

/// Plane stress on the unit squares of a grid, one node's two degrees of freedom held in each of the first
/// columns: the stiffness of springs between all nodes of a quad, which rigid motions do not stretch.
struct Springs {
  int n_columns;
  Grid grid;
  BlockMatrix matrix;

  using Nodes = std::function<bool(int i, int j)>;
  explicit Springs(int n) : Springs(n, [](int, int) { return true; }) {}
  /// @param there  have unknowns
  /// @param held   besides those of the first column
  Springs(
      int n, const Nodes& there, BlockMatrix::Storage storage = BlockMatrix::Storage::whole,
      const Nodes& held = [](int, int) { return false; })
      : n_columns(n), grid(n, n), matrix(grid.mesh, 2, graph(grid, n, there), storage) {
    std::vector<char> fixed(grid.mesh.x.size() * 2, 0);
    for (Index node = 0; node < grid.mesh.n_nodes(); ++node) {
      const auto i = static_cast<int>(grid.global(node) % n), j = static_cast<int>(grid.global(node) / n);
      if (i == 0 || !there(i, j) || held(i, j)) fixed[2 * at(node)] = fixed[2 * at(node) + 1] = 1;
    }
    matrix.set_fixed(fixed);
    for (std::size_t q = 0; q < grid.quads.size(); q += 4)
      for (std::size_t a = 0; a < 4; ++a)
        for (std::size_t b = 0; b < 4; ++b)
          if (a != b) add_spring(grid.quads[q + a], grid.quads[q + b]);
  }
  static std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }
  static NodeGraph graph(const Grid& grid, int n, const Nodes& there) {
    NodeGraph g(grid.mesh);
    std::vector<char> left_out(grid.mesh.x.size(), 0);
    for (Index node = 0; node < grid.mesh.n_nodes(); ++node)
      left_out[at(node)] =
          !there(static_cast<int>(grid.global(node) % n), static_cast<int>(grid.global(node) / n));
    g.leave_out(std::move(left_out));
    g.add_cliques(grid.quads, 4);
    return g;
  }
  /// The half of a spring that pulls at node a.
  void add_spring(Index a, Index b) {
    if (a >= grid.mesh.n_owned_nodes) return;
    const mesh::Point &x = grid.mesh.x[at(a)], &y = grid.mesh.x[at(b)];
    const double d[2] = {y[0] - x[0], y[1] - x[1]}, length = std::hypot(d[0], d[1]);
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) {
        const double k = d[i] * d[j] / (length * length * length);
        matrix.block(matrix.slot(a, a))[2 * i + j] += k;
        matrix.block(matrix.slot(a, b))[2 * i + j] -= k;
      }
  }
  /// The first component of the last column's nodes, ghosts too.
  std::vector<Index> side() const {
    std::vector<Index> entries;
    for (Index node = 0; node < grid.mesh.n_nodes(); ++node)
      if (grid.global(node) % n_columns == n_columns - 1) entries.push_back(2 * node);
    return entries;
  }
  std::size_t n_owned() const { return 2 * at(grid.mesh.n_owned_nodes); }
  std::vector<double> pattern(double factor) const {
    std::vector<double> b(n_owned());
    for (std::size_t i = 0; i < b.size(); ++i)
      if (!matrix.fixed()[i])
        b[i] = std::sin(factor * static_cast<double>(2 * grid.mesh.first_owned) +
                        factor * static_cast<double>(i));
    return b;
  }
};

}  // namespace solidus::test
