/// Padding of the last batch of a block: the lanes behind the last element repeat it in everything but
/// weights (mesh::BlockGeometry), also in history and means. Decisions over all lanes of a batch, such as the
/// number of local iterations, then depend on elements alone, and are the same in a run that is continued.
#pragma once

#include <algorithm>
#include <cstddef>

#include "numbers/simd.hpp"
#include "numbers/types.hpp"

namespace solidus::mechanics {

/// Gives the padding lanes of a batch the value of the last element; other batches have none.
inline void repeat_last_element(Lane& value, Index batch, Index n_elements) {
  const int last = static_cast<int>(n_elements - 1 - batch * k_lanes);
  for (int lane = last + 1; lane < k_lanes; ++lane) value.set(lane, value[last]);
}

/// The values of a batch of elements as lanes.
/// @param of_first  the value of the first element of the block
/// @param stride    from the value of an element to that of the next
inline Lane lane_of_elements(Index batch, Index n_elements, const double* of_first, std::ptrdiff_t stride) {
  alignas(sizeof(Lane)) double values[k_lanes];
  for (int lane = 0; lane < k_lanes; ++lane)
    values[lane] = of_first[stride * std::min<Index>(batch * k_lanes + lane, n_elements - 1)];
  return Lane::load(values);
}

}  // namespace solidus::mechanics
