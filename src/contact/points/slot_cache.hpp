/// Slots of a contact term in a matrix, stored as long as the nodes that meet stay the same.
#pragma once

#include <span>
#include <vector>

#include "linear/block_matrix.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::contact {

/// Points come in runs that share their nodes; a run is known by its first point.
class SlotCache {
 public:
  using Slot = linear::BlockMatrix::Slot;

  /// Slots are those of this matrix from here on.
  void bind(const linear::BlockMatrix& matrix, Index n_owned, Index n_points) {
    matrix_ = &matrix;
    n_owned_ = n_owned;
    runs_.assign(as_size(n_points), {});
  }
  /// Slots of all pairs of the nodes, [row][column]; rows of other processes have none. Valid until the next
  /// call for the same point.
  std::span<const Slot> slots(Index first_point, std::span<const Index> nodes);
  std::size_t bytes() const;

 private:
  struct Run {
    std::vector<Index> nodes;
    std::vector<Slot> slots;
  };
  const linear::BlockMatrix* matrix_ = nullptr;
  Index n_owned_ = 0;
  std::vector<Run> runs_;  ///< [first point]
};

}  // namespace solidus::contact
