/// Slots of the blocks of element matrices in a BlockMatrix, for batches of k_lanes elements.
///
/// For each slot only its place within its row is stored: 2 bytes instead of the 8 of a slot. 64 of them
/// belong to an 8-node hexahedron.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "linear/block_matrix.hpp"

namespace solidus::linear {

class LaneSlots {
 public:
  using Slot = BlockMatrix::Slot;

  LaneSlots() = default;
  /// Void with the next BlockMatrix::set_graph().
  /// @param nodes  [batch][node][lane], as in BlockGeometry; is referred to
  /// @param n      nodes of an element
  /// Lanes beyond `n_elements` are padding. All pairs of nodes must be in the matrix's graph (assert). Throws
  /// std::length_error for a row of 65 536 blocks or more.
  LaneSlots(const BlockMatrix& matrix, std::span<const Index> nodes, int n, Index n_elements);

  /// [a][b][lane], k_no_slot where the row is not owned, where the mirror image is kept and in padding; holds
  /// until another batch is asked for. Not for several threads.
  const Slot* of(Index batch) const {
    if (batch != held_batch_) hold(batch);
    return held_.data();
  }
  std::size_t bytes() const { return places_.capacity() * sizeof places_[0]; }

 private:
  void hold(Index batch) const;

  const BlockMatrix* matrix_ = nullptr;
  std::span<const Index> nodes_;
  std::size_t n_ = 0;
  Index n_elements_ = 0;
  std::vector<std::uint16_t> places_;  ///< [batch][a][b][lane], within the row
  mutable Index held_batch_ = -1;
  mutable std::vector<Slot> held_;
};

}  // namespace solidus::linear
