/// Gathering and scattering of batches, and the way from a shape to its template.
#pragma once

#include <array>
#include <span>
#include <stdexcept>
#include <vector>

#include "linear/lane_slots.hpp"
#include "mesh/block_geometry.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::heat {

template <int n_nodes>
using ConductionMatrix = std::array<std::array<Lane, n_nodes>, n_nodes>;

template <int n_nodes>
std::array<Lane, n_nodes> gather(const mesh::BlockGeometry& geometry, Index batch,
                                 std::span<const double> nodal) {
  std::array<Lane, n_nodes> values;
  const Index* nodes = geometry.nodes.data() + static_cast<std::ptrdiff_t>(batch) * n_nodes * k_lanes;
  for (std::size_t a = 0; a < n_nodes; ++a)
    for (std::size_t lane = 0; lane < k_lanes; ++lane)
      values[a].set(static_cast<int>(lane), nodal[as_size(nodes[a * k_lanes + lane])]);
  return values;
}

/// Padding lanes carry zeros: their weights are zero.
template <int n_nodes>
void scatter(const mesh::BlockGeometry& geometry, Index batch, const std::array<Lane, n_nodes>& values,
             std::span<double> nodal) {
  const Index* nodes = geometry.nodes.data() + static_cast<std::ptrdiff_t>(batch) * n_nodes * k_lanes;
  for (std::size_t a = 0; a < n_nodes; ++a)
    for (std::size_t lane = 0; lane < k_lanes; ++lane)
      nodal[as_size(nodes[a * k_lanes + lane])] += values[a][static_cast<int>(lane)];
}

/// @param slot  [a][b][lane] of the batch
template <int n_nodes>
void scatter_matrix(const linear::BlockMatrix::Slot* slot, const ConductionMatrix<n_nodes>& m,
                    linear::BlockMatrix& matrix) {
  for (std::size_t a = 0; a < n_nodes; ++a)
    for (std::size_t b = 0; b < n_nodes; ++b)
      for (int lane = 0; lane < k_lanes; ++lane) *matrix.block(*slot++) += m[a][b][lane];
}

/// Calls make<n_nodes, dim>() for an element shape.
template <class Make>
auto for_shape(mesh::Shape shape, const Make& make) {
  using mesh::Shape;
  switch (shape) {
    case Shape::tri3:
      return make.template operator()<3, 2>();
    case Shape::tri6:
      return make.template operator()<6, 2>();
    case Shape::quad4:
      return make.template operator()<4, 2>();
    case Shape::quad8:
      return make.template operator()<8, 2>();
    case Shape::tet4:
      return make.template operator()<4, 3>();
    case Shape::tet10:
      return make.template operator()<10, 3>();
    case Shape::hex8:
      return make.template operator()<8, 3>();
    case Shape::hex20:
      return make.template operator()<20, 3>();
    default:
      throw std::invalid_argument("no element of a body has this shape");
  }
}

}  // namespace solidus::heat
