/// View of a square matrix in block rows that another object stores: whole, or symmetric and without the
/// blocks below the diagonal.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "numbers/index_casts.hpp"
#include "numbers/types.hpp"

namespace solidus::multigrid {

/// Positions of the transposed blocks below the diagonal of a symmetric matrix that is stored by its blocks
/// on and above it.
class LowerPart {
 public:
  struct MirroredBlock {
    Index column;  ///< of the block below the diagonal: the row in which its mirror image is
    Index place;   ///< within that row
  };
  LowerPart(std::span<const std::int64_t> start, std::span<const Index> column);
  /// Returns the blocks of a block row, columns rising.
  std::span<const MirroredBlock> row(Index row) const {
    const auto i = as_size(row);
    return std::span(blocks_).subspan(as_size(start_[i]), as_size(start_[i + 1] - start_[i]));
  }

 private:
  std::vector<std::int64_t> start_;
  std::vector<MirroredBlock> blocks_;
};

/// The block rows of this process; columns are its own, then ghosts.
struct MatrixView {
  int size = 1;  ///< of a block
  std::span<const std::int64_t> start;
  std::span<const Index> column;   ///< rising within a row
  const double* blocks = nullptr;  ///< [slot][row][column]
  /// The blocks left of the diagonal, if rows are stored from their diagonal on; null: rows are stored whole.
  const LowerPart* lower = nullptr;

  Index n_rows() const { return as_index(start.size()) - 1; }
  const double* block(std::int64_t slot) const { return blocks + slot * size * size; }
  std::int64_t begin(Index row) const { return start[as_size(row)]; }
  std::int64_t end(Index row) const { return start[as_size(row) + 1]; }

  /// Calls f(column, slot, mirrored) for all blocks of a row, columns rising; of those that are mirrored the
  /// slot has the transpose.
  template <class F>
  void each(Index row, const F& f) const {
    if (lower != nullptr)
      for (const LowerPart::MirroredBlock& block : lower->row(row))
        f(block.column, begin(block.column) + block.place, true);
    for (std::int64_t s = begin(row); s < end(row); ++s) f(column[as_size(s)], s, false);
  }
};

}  // namespace solidus::multigrid
