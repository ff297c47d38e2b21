/// The linear solver of displacement and temperature at once (coupled_matrix.hpp): MUMPS, or FGMRES with a
/// multiplicative field split, multigrid with rigid-body modes on the displacements (multigrid.hpp; GAMG
/// where some are tied) and incomplete LU on the temperatures. PETSc options: coupled_, within the split
/// coupled_fieldsplit_u_ and coupled_fieldsplit_temperature_.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "linear/coupled_matrix.hpp"
#include "linear/linear_solver.hpp"

namespace solidus::linear {

enum class CoupledSolverKind {
  automatic,  ///< direct in two dimensions and on small three-dimensional meshes, field_split on others
  direct,     ///< MUMPS, LU
  field_split
};

/// The weights of forces and heat flows in the norm of the residual.
struct FieldWeights {
  double force = 1;  ///< [1/N]
  double heat = 1;   ///< [1/W]
};

/// The interface of linear solvers for Newton's method with all fields at once.
class CoupledTangentSolver {
 public:
  virtual ~CoupledTangentSolver() = default;
  /// Solves A {u, Θ} = {force, heat} on owned degrees of freedom; right-hand sides are zero where prescribed
  /// and summed where tied. With pressures, `force` and `u` hold displacements and then pressures in the
  /// monotone form (mechanics/solver/nodal_pressure.hpp). Collective.
  /// @param weights  with which an iterative solver measures its residual; ignored by a direct one
  /// @param forcing  as LinearSolver::solve()
  virtual LinearReport solve(CoupledMatrix& a, std::span<const double> force, std::span<const double> heat,
                             FieldWeights weights, std::span<double> u, std::span<double> temperature,
                             double forcing = 0) = 0;
  /// The weights that the next solve uses instead of `weights`: a reused preconditioner may keep its own.
  virtual FieldWeights in_use(FieldWeights weights) const = 0;
  /// Discards the data kept from earlier solves, as LinearSolver::forget().
  virtual void forget() = 0;
  /// Resets the solver as LinearSolver::reset().
  virtual void reset() = 0;
  virtual double seconds() const = 0;
};

/// Solver of the coupled system of displacement and temperature without a nodal pressure; systems with one
/// are solved by coupling/coupled_saddle_solver.hpp.
class CoupledSolver final : public CoupledTangentSolver {
 public:
  CoupledSolver(const mesh::Mesh& mesh, int components, CoupledSolverKind kind, double relative_tolerance);
  ~CoupledSolver() override;
  LinearReport solve(CoupledMatrix& a, std::span<const double> force, std::span<const double> heat,
                     FieldWeights weights, std::span<double> u, std::span<double> temperature,
                     double forcing = 0) override;
  FieldWeights in_use(FieldWeights weights) const override;
  void forget() override;
  void reset() override;
  double seconds() const override;

 private:
  bool direct_;
  LinearSolver solver_;
  FieldWeights weights_;  ///< of the present preconditioner
  std::vector<double> right_, solution_;
  struct Petsc;
  std::unique_ptr<Petsc> petsc_;
};

}  // namespace solidus::linear
