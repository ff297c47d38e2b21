/// Two blocks with meshes that do not match where they meet, distributed over the processes of the test.
#pragma once

#include <string>
#include <vector>

#include "mesh/making/parametric_meshes.hpp"
#include "mesh/mesh.hpp"
#include "mesh/raw_mesh.hpp"
#include "system/processes.hpp"

namespace solidus::test {

inline mesh::Mesh distribute_blocks(const mesh::RawMesh& raw) {
  return mesh::distribute(raw, {"lower", "upper"}, {"lower_top", "upper_bottom"});
}

inline mesh::RawMesh raw_blocks(const mesh::TwoBlocks& blocks, mesh::Shape shape) {
  const int rank = processes::rank();
  return rank == 0 ? mesh::make_two_blocks(blocks, shape) : mesh::RawMesh{};
}

/// Blocks of equal width whose interface divisions share no line but the ends.
inline mesh::TwoBlocks standard_blocks(mesh::Shape shape, double gap = 0) {
  if (mesh::dimension(shape) == 2) return {{0.3, 0.1}, {0.3, 0.2}, {5, 2}, {3, 2}, gap};
  return {{0.3, 0.2, 0.1}, {0.3, 0.2, 0.2}, {3, 3, 2}, {2, 2, 2}, gap};
}

inline mesh::Mesh two_blocks(mesh::Shape shape, double gap = 0) {
  return distribute_blocks(raw_blocks(standard_blocks(shape, gap), shape));
}

/// A displacement field u_i(x, body) on all local nodes.
template <class Function>
std::vector<double> nodal_field(const mesh::Mesh& mesh, int components, Function f) {
  const auto c = static_cast<std::size_t>(components);
  std::vector<double> u(mesh.x.size() * c);
  std::vector<char> is_upper(mesh.x.size(), 0);
  for (Index n : mesh.node_sets.at("upper")) is_upper[static_cast<std::size_t>(n)] = 1;
  for (std::size_t n = 0; n < mesh.x.size(); ++n) {
    const std::vector<double> value = f(mesh.x[n], is_upper[n] != 0);
    for (std::size_t i = 0; i < c; ++i) u[n * c + i] = value[i];
  }
  return u;
}

}  // namespace solidus::test
