/// Differences from the first node are interpolated, so that equal nodal values give that value exactly.
#include "mechanics/elements/point_temperature.hpp"

#include <cstddef>

#include "numbers/index_casts.hpp"

namespace solidus::mechanics {

Lane temperature_at(const mesh::BlockGeometry& geometry, Index batch, int point,
                    std::span<const double> nodal) {
  const double* values = geometry.values.data() + point * geometry.n_nodes;
  const Index* nodes =
      geometry.nodes.data() + static_cast<std::ptrdiff_t>(batch) * geometry.n_nodes * k_lanes;
  alignas(sizeof(Lane)) double first[k_lanes], sum[k_lanes] = {};
  for (int lane = 0; lane < k_lanes; ++lane) first[lane] = nodal[as_size(nodes[lane])];
  for (int a = 1; a < geometry.n_nodes; ++a)
    for (int lane = 0; lane < k_lanes; ++lane)
      sum[lane] += values[a] * (nodal[as_size(nodes[a * k_lanes + lane])] - first[lane]);
  return Lane::load(first) + Lane::load(sum);
}

Lane within_nodes(const mesh::BlockGeometry& geometry, Index batch, int point,
                  std::span<const double> nodal) {
  const Lane value = temperature_at(geometry, batch, point, nodal);
  if (mesh::order(geometry.shape) == 1) return value;
  const Index* nodes =
      geometry.nodes.data() + static_cast<std::ptrdiff_t>(batch) * geometry.n_nodes * k_lanes;
  Lane least = value, largest = value;
  for (int a = 0; a < geometry.n_nodes; ++a)
    for (int lane = 0; lane < k_lanes; ++lane) {
      const double here = nodal[as_size(nodes[a * k_lanes + lane])];
      if (a == 0 || here < least[lane]) least.set(lane, here);
      if (a == 0 || here > largest[lane]) largest.set(lane, here);
    }
  return max(min(value, largest), least);
}

}  // namespace solidus::mechanics
