/// The elements of a block some at a time, for work that needs much more memory an element than the mesh.
#pragma once

#include <algorithm>
#include <cstddef>

#include "mesh/mesh.hpp"
#include "numbers/simd.hpp"

namespace solidus::mesh {

inline constexpr Index k_elements_of_part = 512 * k_lanes;

/// Calls visit(part, first) for the elements of a block in their order, a few thousand at a time. A part is a
/// block with whole batches of lanes, but for the last one, and without the numbers of its elements in the
/// input; `first` is the number of its first element in the block.
template <class Visit>
void for_parts(const ElementBlock& block, Visit&& visit) {
  ElementBlock part;
  part.shape = block.shape;
  part.body = block.body;
  for (Index first = 0; first < block.size(); first += k_elements_of_part) {
    const Index n = std::min(k_elements_of_part, block.size() - first);
    part.nodes.assign(block.element(first),
                      block.element(first) + static_cast<std::ptrdiff_t>(n) * node_count(block.shape));
    part.n_counted = std::clamp(block.n_counted - first, Index{0}, n);
    visit(static_cast<const ElementBlock&>(part), first);
  }
}

}  // namespace solidus::mesh
