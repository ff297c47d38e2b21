/// Smoothed aggregation: the coarse level of a multigrid hierarchy (Vaněk, Mandel, Brezina, Computing 56
/// (1996) 179).
///
/// Block rows are gathered in aggregates of neighbours. The near-null space restricted to an aggregate, made
/// orthonormal, is the tentative interpolation P₀, so that the coarse level represents it exactly; a step of
/// Jacobi's method takes the energy out of its edges, P = (I − ω D⁻¹ A) P₀. The coarse matrix is Pᵀ A P.
///
/// Aggregates do not reach over processes, but their functions do, by the step of Jacobi's method: so the
/// iterations do not depend on how the rows are divided. What a process finds for coarse rows of another one
/// is sent there.
#pragma once

#include <span>
#include <vector>

#include "multigrid/packed_rows.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/row_exchange.hpp"

namespace solidus::multigrid {

/// One over the diagonal, [owned row × size]; one where it vanishes.
std::vector<float> inverse_diagonal(const MatrixView& a);

/// Position of a process's block rows of one level in the numbering over all processes.
struct Numbering {
  Index n_owned = 0;
  GlobalIndex first = 0;
  std::vector<GlobalIndex> ghosts;  ///< [local − n_owned]
  Index n_local() const { return n_owned + as_index(ghosts.size()); }
};

/// Result of the aggregation of one level: the interpolation, and matrix, numbering and near-null space of
/// the next coarser level.
struct Coarsening {
  int modes = 1;  ///< size of a coarse block
  BlockRows<float>
      interpolation;         ///< P, [local fine row], ghosts too; columns are local coarse rows, ghosts too
  BlockRows<double> matrix;  ///< Pᵀ A P, owned coarse rows
  Numbering numbering;       ///< of the coarse rows
  std::vector<double> near_null;  ///< of the coarse level, [owned coarse row × modes][modes]
};

/// @param near_null  [owned row × size][modes]; freed as soon as it has been read
/// @param fixed      [owned row × size], rows that are decoupled and have no error; empty: none
/// @param largest    eigenvalue of D⁻¹ A
/// Collective.
Coarsening coarsen(const MatrixView& a, const Numbering& numbering, const parallel::RowExchange& ghosts,
                   std::vector<double> near_null, int modes, std::span<const char> fixed,
                   std::span<const float> inverse_diagonal, double largest);

}  // namespace solidus::multigrid
