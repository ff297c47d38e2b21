/// The linear solver of both fields at once (coupled_matrix.hpp): MUMPS, or FGMRES with a multiplicative
/// field split, multigrid with rigid-body modes on the displacements (multigrid.hpp; GAMG where some are
/// tied) and incomplete LU on the temperatures. PETSc options: coupled_, within the split
/// coupled_fieldsplit_u_ and coupled_fieldsplit_temperature_.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "algebra/coupled_matrix.hpp"
#include "algebra/linear_solver.hpp"

namespace solidus::algebra {

enum class CoupledSolverKind {
  automatic,  ///< direct in two dimensions and on small three-dimensional meshes, field_split on others
  direct,     ///< MUMPS, LU
  field_split
};

/// What one newton and one watt count in the norm of the residual.
struct FieldWeights {
  double force = 1;  ///< [1/N]
  double heat = 1;   ///< [1/W]
};

class CoupledSolver {
 public:
  CoupledSolver(const mesh::Mesh& mesh, int components, CoupledSolverKind kind, double relative_tolerance);
  ~CoupledSolver();
  /// Solves A {u, Θ} = {force, heat} on owned degrees of freedom; right-hand sides are zero where prescribed
  /// and summed where tied. Collective.
  /// @param weights  with which an iterative solver measures its residual; ignored by the direct one
  /// @param forcing  as LinearSolver::solve()
  LinearReport solve(CoupledMatrix& a, std::span<const double> force, std::span<const double> heat,
                     FieldWeights weights, std::span<double> u, std::span<double> temperature,
                     double forcing = 0);
  /// Those that the next solve uses where it is given these: a preconditioner that stays keeps its own.
  FieldWeights in_use(FieldWeights weights) const;
  /// As LinearSolver::forget().
  void forget();
  /// As LinearSolver::reset().
  void reset();
  double seconds() const;

 private:
  bool direct_;
  LinearSolver solver_;
  FieldWeights weights_;  ///< of the present preconditioner
  std::vector<double> right_, solution_;
  struct Petsc;
  std::unique_ptr<Petsc> petsc_;
};

}  // namespace solidus::algebra
