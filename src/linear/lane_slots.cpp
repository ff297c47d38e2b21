/// Slots are stored as places within rows and put together again when a batch is held.
#include "linear/lane_slots.hpp"

#include <cassert>
#include <limits>
#include <stdexcept>

#include "numbers/index_casts.hpp"
#include "numbers/simd.hpp"

namespace solidus::linear {

namespace {
/// A pair without a slot, where its row has others.
constexpr std::uint16_t k_no_place = std::numeric_limits<std::uint16_t>::max();
}  // namespace

LaneSlots::LaneSlots(const BlockMatrix& matrix, std::span<const Index> nodes, int n, Index n_elements)
    : matrix_(&matrix), nodes_(nodes), n_(as_size(n)), n_elements_(n_elements) {
  // The place of each block within its row is stored in two bytes; the slot itself would take eight.
  const std::size_t n_batches = nodes.size() / (n_ * k_lanes);
  held_.resize(n_ * n_ * k_lanes);
  places_.resize(n_batches * held_.size());
  const std::span<const std::int64_t> row_start = matrix.row_start();
  for (std::size_t batch = 0; batch < n_batches; ++batch) {
    // Nodes lie by lanes within a batch: [node][lane].
    const Index* const of_batch = nodes.data() + batch * n_ * k_lanes;
    std::uint16_t* to = places_.data() + batch * held_.size();
    for (std::size_t a = 0; a < n_; ++a)
      for (std::size_t b = 0; b < n_; ++b)
        for (std::size_t lane = 0; lane < k_lanes; ++lane, ++to) {
          const Index row = of_batch[a * k_lanes + lane];
          [[maybe_unused]] const Index column = of_batch[b * k_lanes + lane];
          const Slot slot = matrix.slot(row, column);
          // Rows of other processes, and the mirror half of a symmetric matrix, have no slot.
          if (slot == BlockMatrix::k_no_slot) {
            assert((row >= as_index(row_start.size()) - 1 ||
                    (matrix.storage() == BlockMatrix::Storage::upper && column < row)) &&
                   "an element of a node that is left out");
            *to = k_no_place;
            continue;
          }
          const Slot place = slot - row_start[as_size(row)];
          if (place >= k_no_place) throw std::length_error("a node is coupled with 65 536 others or more");
          *to = static_cast<std::uint16_t>(place);
        }
  }
}

void LaneSlots::hold(Index batch) const {
  // The slots of one batch are put together from the starts of the rows and the stored places. Lanes beyond
  // the last element get none.
  const std::span<const std::int64_t> row_start = matrix_->row_start();
  const auto n_owned = as_index(row_start.size()) - 1;
  const Index* const of_batch = nodes_.data() + as_size(batch) * n_ * k_lanes;
  const std::uint16_t* from = places_.data() + as_size(batch) * held_.size();
  Slot* to = held_.data();
  for (std::size_t a = 0; a < n_; ++a) {
    Slot first[k_lanes];
    for (std::size_t lane = 0; lane < k_lanes; ++lane) {
      const Index row = of_batch[a * k_lanes + lane];
      const bool none = row >= n_owned || batch * k_lanes + as_index(lane) >= n_elements_;
      first[lane] = none ? BlockMatrix::k_no_slot : row_start[as_size(row)];
    }
    for (std::size_t b = 0; b < n_; ++b)
      for (std::size_t lane = 0; lane < k_lanes; ++lane, ++from, ++to)
        *to = first[lane] == BlockMatrix::k_no_slot || *from == k_no_place ? BlockMatrix::k_no_slot
                                                                           : first[lane] + *from;
  }
  held_batch_ = batch;
}

}  // namespace solidus::linear
