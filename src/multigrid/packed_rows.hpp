/// Block rows in single precision, for preconditioners: the copy of a matrix that a multigrid cycle reads
/// repeatedly.
///
/// A product is bound by memory: 4 bytes an entry and 4 bytes a block, where PETSc's AIJ reads 12 bytes an
/// entry, and half of that where the matrix is symmetric (symmetric_product.hpp). Blocks of others are
/// column by column, so that a column times a number is one short vector.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

#include "multigrid/matrix_view.hpp"
#include "numbers/index_casts.hpp"
#include "numbers/types.hpp"

namespace solidus::multigrid {

/// Rows of blocks, in any order of columns; blocks row by row while they are made.
template <class Number>
struct BlockRows {
  int rows = 1, columns = 1;           ///< of a block
  std::vector<std::int64_t> start{0};  ///< [block row] into `column`; one more at the end
  std::vector<Index> column;           ///< [slot] block column
  std::vector<Number> value;           ///< [slot][row][column]
  Index n_rows() const { return as_index(start.size()) - 1; }
  std::int64_t block_entries() const { return std::int64_t{rows} * columns; }
  Number* block(std::int64_t slot) { return value.data() + slot * block_entries(); }
  const Number* block(std::int64_t slot) const { return value.data() + slot * block_entries(); }
};

/// Calls f with the sizes of the blocks as constants: displacements in two or three dimensions, their modes.
template <class F>
void with_block_sizes(int rows, int columns, const F& f) {
  switch (10 * rows + columns) {
    case 11:
      return f.template operator()<1, 1>();
    case 22:
      return f.template operator()<2, 2>();
    case 23:
      return f.template operator()<2, 3>();
    case 33:
      return f.template operator()<3, 3>();
    case 36:
      return f.template operator()<3, 6>();
    case 66:
      return f.template operator()<6, 6>();
    default:
      throw std::logic_error("no block rows of this size");
  }
}

class PackedRows {
 public:
  /// Numbers behind the last block: a product reads beyond the end of a block.
  static constexpr std::size_t k_overhang = 8;
  PackedRows() = default;
  enum class Pattern { referred_to, copied };
  /// Copies the blocks of a square matrix; of a symmetric one those on and above the diagonal.
  /// @param n_local  block columns, ghosts included
  /// @param pattern  is copied in any case where it is not that of `a`
  PackedRows(const MatrixView& a, Index n_local, bool symmetric, Pattern pattern);
  /// Takes the first rows over.
  PackedRows(BlockRows<float> from, Index n_rows);
  PackedRows(PackedRows&&) noexcept = default;
  PackedRows& operator=(PackedRows&&) noexcept = default;

  /// y = A x
  void multiply(const float* x, float* y) const;
  /// y += A x
  void multiply_add(const float* x, float* y) const;
  /// y += Aᵀ x
  void multiply_transposed_add(const float* x, float* y) const;
  std::size_t bytes() const;

 private:
  void copy_upper_pattern(const MatrixView& a);

  int rows_ = 1, columns_ = 1;
  bool symmetric_ = false;
  Index n_local_ = 0;
  std::vector<std::int64_t> own_start_;  ///< empty where the pattern is another's
  std::vector<Index> own_column_;
  std::span<const std::int64_t> start_;  ///< [block row] into `column_`; one more at the end
  std::span<const Index> column_;        ///< [slot]
  std::vector<float> value_;  ///< [slot][column][row], symmetric [slot][row][column]; a register's width more
  mutable std::vector<float> scratch_;
};

}  // namespace solidus::multigrid
