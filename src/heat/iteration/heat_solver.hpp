/// The linear solver of the thermal phase: a cheap one first, a strong one when the matrix asks for it.
#pragma once

#include <memory>

#include "linear/linear_solver.hpp"

namespace solidus::heat {

/// A transient step is diagonally strong and CG + incomplete Cholesky serves, unless the step is so long that
/// the matrix is nearly that of the steady state. Then the solver of the steady state takes over
/// (MUMPS or multigrid) until the end of the step. Its factors change the diagonal alone, which suffices for
/// most steps, until a solve has taken many iterations. A kind that the user chose is used alone.
class HeatSolver {
 public:
  HeatSolver(const mesh::Mesh& mesh, linear::SolverKind kind, bool symmetric, double relative_tolerance);
  /// Returns the storage of the matrix that suits such a solver best.
  static linear::BlockMatrix::Storage storage_for(const mesh::Mesh& mesh, linear::SolverKind kind,
                                                  bool symmetric);
  /// Call at the start of a step, so that the same step gives the same bits.
  /// @param transient false: the strong solver at once
  void begin(bool transient);
  /// @param forcing  as of linear::LinearSolver::solve()
  linear::LinearReport solve(linear::BlockMatrix& a, std::span<const double> b, std::span<double> x,
                             double forcing = 0);
  /// Solves with the matrix of the last solve(), which must not have changed.
  linear::LinearReport solve_again(std::span<const double> b, std::span<double> x, double forcing);
  /// The solver that runs now, for linear::newton().
  linear::LinearSolver& strong();
  /// Frees what the quick solver has allocated, where it carries nothing over to the next solve.
  void release();
  /// Drops what the solvers carry over from earlier solves, as linear::LinearSolver::forget().
  void forget();
  /// Resets the solvers as linear::LinearSolver::reset().
  void reset();
  double seconds() const;

 private:
  const mesh::Mesh& mesh_;
  linear::LinearSolverOptions options_;
  std::unique_ptr<linear::LinearSolver> quick_, strong_;
  bool use_quick_ = false;
  bool fill_ = false;                     ///< the quick solver's factors keep their fill
  bool keeps_nothing_ = false;            ///< the quick solver, from one solve to the next
  linear::LinearSolver* last_ = nullptr;  ///< that the last solve() ended with
};

}  // namespace solidus::heat
