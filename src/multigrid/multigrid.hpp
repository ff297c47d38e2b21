/// Algebraic multigrid by smoothed aggregation (aggregation.hpp) as a preconditioner: a V-cycle with two
/// steps of Chebyshev's iteration on Jacobi's method before and after, in single precision.
///
/// Made from block rows that another object stores, without a copy in PETSc's format. For symmetric matrices
/// the cycle is symmetric. Chebyshev's interval as in Adams, Brezina, Hu, Tuminaro, J. Comput. Phys. 188
/// (2003) 593.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "multigrid/aggregation.hpp"

namespace solidus::multigrid {

/// Functions that cost next to no energy: rigid-body modes, or a constant for each component.
struct NearNullSpace {
  int modes = 1;
  std::vector<double> values;  ///< [owned block row][component][mode]
};

class Multigrid {
 public:
  /// Block rows down to which rows are coarsened; a level of so many or fewer is factorised by every process.
  static constexpr GlobalIndex k_coarsest = 60;
  /// The same where coarsening stalls above. A level that stalls with more of them is smoothed at length
  /// instead, by all processes together, with a warning.
  static constexpr GlobalIndex k_most_factorised = 1000;
  /// @param symmetric  whether the matrices are, which halves the memory that a cycle reads
  explicit Multigrid(bool symmetric, GlobalIndex coarsest = k_coarsest);
  ~Multigrid();
  /// Whether there are kernels for blocks of this size.
  static bool supports(int block_size, int modes);
  /// Makes the hierarchy for the matrix as it is now. `a.start` and `a.column` are referred to by apply().
  /// @param numbering  of the block rows and of the ghosts that are columns behind them
  /// @param fixed      [owned block row × size], rows that are decoupled and have no error
  /// Collective.
  void set_up(const MatrixView& a, Numbering numbering, std::span<const char> fixed, NearNullSpace near_null);
  /// z ≈ A⁻¹ r on owned degrees of freedom. Collective.
  void apply(std::span<const double> r, std::span<double> z);
  int levels() const;
  /// Block rows of the coarsest level over all processes.
  GlobalIndex coarsest_rows() const { return coarsest_rows_; }
  /// Whether every process factorises it; else it is smoothed.
  bool factorises() const { return coarsest_ != nullptr; }
  std::size_t bytes() const;

 private:
  struct Level;
  struct Coarsest;
  void add_level(const MatrixView& a, Numbering numbering, std::span<const char> fixed, int modes,
                 std::vector<double> near_null);
  void add_coarser(const MatrixView& a, std::span<const char> fixed, int modes,
                   std::vector<double> near_null);
  void cycle(std::size_t level);

  bool symmetric_;
  GlobalIndex coarsest_limit_;
  std::vector<Level> levels_;
  std::unique_ptr<Coarsest> coarsest_;
  GlobalIndex coarsest_rows_ = 0;
};

}  // namespace solidus::multigrid
