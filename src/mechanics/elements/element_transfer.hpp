/// Gathers and scatters values between the lanes of a batch of elements and nodal arrays or matrix blocks.
#pragma once

#include <span>

#include "linear/lane_slots.hpp"
#include "mechanics/elements/element_matrix.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mechanics {

/// @param u      [local node][component]
/// @param nodes  [node][lane]
template <int n_nodes, int n_components>
NodalVectors<Lane, n_nodes, n_components> gather(std::span<const double> u, const Index* nodes) {
  constexpr auto dim = as_size(n_components);
  NodalVectors<Lane, n_nodes, n_components> result;
  for (std::size_t a = 0; a < n_nodes; ++a) {
    alignas(sizeof(Lane)) double values[dim][k_lanes];
    for (std::size_t lane = 0; lane < k_lanes; ++lane) {
      const double* from = u.data() + static_cast<std::ptrdiff_t>(nodes[a * k_lanes + lane]) * n_components;
      for (std::size_t i = 0; i < dim; ++i) values[i][lane] = from[i];
    }
    for (std::size_t i = 0; i < dim; ++i) result[a][i] = Lane::load(values[i]);
  }
  return result;
}

/// to[local node][component] += f
template <int n_nodes, int n_components>
void scatter(const NodalVectors<Lane, n_nodes, n_components>& f, const Index* nodes, std::span<double> to) {
  constexpr auto dim = as_size(n_components);
  for (std::size_t a = 0; a < n_nodes; ++a) {
    alignas(sizeof(Lane)) double values[dim][k_lanes];
    for (std::size_t i = 0; i < dim; ++i) f[a][i].store(values[i]);
    for (std::size_t lane = 0; lane < k_lanes; ++lane) {
      double* at = to.data() + static_cast<std::ptrdiff_t>(nodes[a * k_lanes + lane]) * n_components;
      for (std::size_t i = 0; i < dim; ++i) at[i] += values[i][lane];
    }
  }
}

/// matrix += the pairs and their mirror images.
/// @tparam mirror 1 for a symmetric element matrix, −1 for a skew one
/// @param slots   [a][b][lane] of the batch
template <int mirror, int n_nodes, int n_components>
void scatter(const ElementMatrix<n_nodes, n_components>& k, const linear::BlockMatrix::Slot* slots,
             linear::BlockMatrix& matrix) {
  using Slot = linear::BlockMatrix::Slot;
  constexpr auto dim = as_size(n_components);
  constexpr auto size = static_cast<Slot>(dim * dim);
  double* const base = matrix.block(0);
  std::size_t pair = 0;
  for (std::size_t a = 0; a < n_nodes; ++a)
    for (std::size_t b = a; b < n_nodes; ++b, ++pair) {
      alignas(sizeof(Lane)) double values[dim * dim][k_lanes];
      for (std::size_t i = 0; i < dim * dim; ++i) k.pairs[pair][i].store(values[i]);
      const Slot* upper = slots + (a * n_nodes + b) * k_lanes;
      const Slot* lower = slots + (b * n_nodes + a) * k_lanes;
      for (std::size_t lane = 0; lane < k_lanes; ++lane) {
        double* to = base + upper[lane] * size;
        for (std::size_t i = 0; i < dim * dim; ++i) to[i] += values[i][lane];
      }
      if (a == b) continue;
      for (std::size_t lane = 0; lane < k_lanes; ++lane) {
        double* to = base + lower[lane] * size;
        for (std::size_t i = 0; i < dim; ++i)
          for (std::size_t j = 0; j < dim; ++j) to[i * dim + j] += mirror * values[j * dim + i][lane];
      }
    }
}

}  // namespace solidus::mechanics
