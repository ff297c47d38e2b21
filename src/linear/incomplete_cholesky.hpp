/// Incomplete Cholesky factors without fill, in single precision, of a process's part of a symmetric matrix:
/// the preconditioner of a step of transient heat, which is diagonally strong.
///
/// The fill f_i of a row that has no place in the pattern goes to its diagonal as far as it exceeds 0.3 of
/// the row's sum s_i = Σ_j A_ij, f_i − 0.3 s_i where that is positive. The factors then act on smooth
/// functions as the matrix does but for such a share, and iterations grow with the root of the number of
/// nodes along a side, not with that number (I. Gustafsson, BIT 18 (1978) 142, who takes all of f_i less a
/// perturbation). A row that is diagonally dominant by more than its fill stays as it is: there nothing is
/// smooth, and fill on the diagonal would be in the way.
///
/// Entries off the diagonal that are positive, as quadratic elements have them, may make a pivot negative,
/// and factors that go on from it have no bound. Then they are made of A + α diag A, with the least of some
/// rising α for which no pivot is negative (T. A. Manteuffel, Math. Comp. 34 (1980) 473).
///
/// Without changes of the entries off the diagonal all fill is treated so, and the factors are the entries of
/// the matrix itself about another diagonal: they cost as much as a product with the matrix, an eighth of
/// those with all entries of the pattern, and take some 1.4 times the iterations.
///
/// Each process has factors of its own rows. Of the entries A_ij with nodes j of other processes 0.7 goes to
/// the diagonal of row i. With none of them the factors act as if the unknowns beyond the border were zero,
/// with all of them as if each equalled that of its row; something between the two couples the parts best, as
/// in optimised Schwarz methods (M. J. Gander, SIAM J. Numer. Anal. 44 (2006) 699).
///
/// Made from half a BlockMatrix as it is, whose pattern the factors share: a sixth of the memory of
/// PETSc's copy and factors. Meijerink and van der Vorst, Math. Comp. 31 (1977) 148.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "linear/block_matrix.hpp"

namespace solidus::linear {

class IncompleteCholesky {
 public:
  /// The entries of the factors that fill changes.
  enum class Fill { pattern, diagonal };
  /// A pivot that is not positive gives way to the diagonal it came from. Collective.
  /// @param a  of one component, by half, with its fixed rows; must outlive the factors and keep its pattern
  void set_up(BlockMatrix& a, Fill fill = Fill::pattern);
  /// z = (Uᵀ D U)⁻¹ r on owned rows.
  void apply(std::span<const double> r, std::span<double> z);
  /// The same z in single precision; it stays until the next call.
  std::span<const float> apply(std::span<const double> r);
  std::size_t bytes() const { return (factor_.capacity() + work_.capacity()) * sizeof(float); }

 private:
  bool factorise(const double* values, float shift, Fill fill);
  void find_borne_fill(const double* values, std::span<float> bears) const;
  void eliminate(Index row, std::int64_t end, std::span<float> bears);
  void eliminate_on_diagonal(Index row, std::int64_t end, std::span<float> bears);
  std::int64_t end_of_owned(std::size_t row) const;

  std::span<const std::int64_t> start_;
  std::span<const Index> column_;
  std::vector<float> factor_;  ///< [slot] of U, with 1/D on the diagonal
  std::vector<float> work_;    ///< [owned row]; while the factors are made, the fill that rows still bear
};

}  // namespace solidus::linear
