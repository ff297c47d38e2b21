/// A matrix without the block rows that have no unknown. In a casting in its mould most nodes may be of sand,
/// which only conducts heat: a cycle of multigrid would spend as long on their empty rows as on the casting.
#pragma once

#include <span>
#include <vector>

#include "multigrid/aggregation.hpp"
#include "multigrid/matrix_view.hpp"

namespace solidus::multigrid {

/// A copy of the rows that are left, numbered again in their old order.
struct CompactRows {
  std::vector<Index> rows;  ///< [new owned row] the owned row that it was
  Numbering numbering;
  std::vector<std::int64_t> start;
  std::vector<Index> column;
  std::vector<double> value;  ///< [slot][row][column] of the rows that are left
  std::vector<char> fixed;    ///< [new owned row × size]
  std::vector<double>
      inverse_diagonal;  ///< 1/a_ii of the rows that were left out, [owned row × size]; else 0
};

/// Whether so many block rows have no unknown that leaving them out pays. Collective.
/// @param fixed  [owned block row × size], rows that are decoupled
bool worth_compacting(int size, std::span<const char> fixed);

/// Leaves out the block rows that are fixed altogether, and the blocks in their columns, which are zero.
/// Rows are stored from the diagonal on, or whole, as those of `a` are. Collective.
/// @param a  decoupled where it is fixed
CompactRows compact(const MatrixView& a, const Numbering& numbering, std::span<const char> fixed);

}  // namespace solidus::multigrid
