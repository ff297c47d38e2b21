/// A small grid of nodes split over the processes by hand: the algebra is tested without a mesh reader.
#pragma once

#include "mesh/mesh.hpp"
#include "system/processes.hpp"

namespace solidus::test {

/// A 2-D grid of nx × ny nodes, rows of nodes split over the processes, with the cliques of its quads.
struct Grid {
  mesh::Mesh mesh;
  std::vector<Index> quads;  ///< [quad][4] local nodes, those that touch an owned node

  Grid(int nx, int ny) {
    const int rank = processes::rank(), size = processes::count();
    const int first = ny * rank / size, last = ny * (rank + 1) / size;
    const auto add_row = [&](int j) {
      for (int i = 0; i < nx; ++i) {
        mesh.x.push_back({0.1 * i, 0.1 * j, 0.0});
        mesh.global_node.push_back(j * nx + i);
        mesh.input_node.push_back(j * nx + i + 1);
      }
    };
    for (int j = first; j < last; ++j) add_row(j);
    mesh.n_owned_nodes = static_cast<Index>((last - first) * nx);
    mesh.first_owned = first * nx;
    mesh.n_global_nodes = nx * ny;
    std::vector<int> row_at(static_cast<std::size_t>(ny), -1);
    for (int j = first; j < last; ++j) row_at[static_cast<std::size_t>(j)] = j - first;
    const auto ghost_row = [&](int j) {
      if (j < 0 || j >= ny || first == last) return;
      row_at[static_cast<std::size_t>(j)] = static_cast<int>(mesh.x.size()) / nx;
      add_row(j);
    };
    ghost_row(first - 1);
    ghost_row(last);
    for (int j = 0; j + 1 < ny; ++j) {
      const int low = row_at[static_cast<std::size_t>(j)], high = row_at[static_cast<std::size_t>(j + 1)];
      if (low < 0 || high < 0) continue;
      for (int i = 0; i + 1 < nx; ++i)
        for (int node : {low * nx + i, low * nx + i + 1, high * nx + i + 1, high * nx + i})
          quads.push_back(static_cast<Index>(node));
    }
  }
  GlobalIndex global(Index node) const { return mesh.global_node[static_cast<std::size_t>(node)]; }
};

}  // namespace solidus::test
