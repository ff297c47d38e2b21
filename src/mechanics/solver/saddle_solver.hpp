/// The linear systems of Newton's method where elements have a pressure (nodal_pressure.hpp):
///
///   ⎡ A   B     ⎤ ⎧δu⎫   ⎧−r_u⎫
///   ⎣ Bᵀ −(C+S) ⎦ ⎩δp⎭ = ⎩−r_p⎭
///
/// one linear solve an iteration, on the degrees of freedom that are unknown: nodes of bodies that only
/// conduct heat have no rows. Where factors, LDLᵀ by MUMPS, are cheap they are taken: for few unknowns, and
/// for as many in thin walls as MUMPS foresees little work for. Others take GMRES that recycles its slow
/// directions (recycling_gmres.hpp), with the preconditioner of saddle_preconditioner.hpp. Where that does
/// not converge and a factorisation is possible, it takes over until forget().
///
/// Orthogonal sub-scales couple neighbours of neighbours. That part of S is applied and never assembled:
/// GMRES has it in its operator and goes without it in what preconditions it, the factors included. In three
/// dimensions factors of an iteration before precondition too, as long as that pays (factor_age.hpp).
/// PETSc options of the factorisation: mechanics_mixed_.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "linear/factor_age.hpp"
#include "linear/function_matrix.hpp"
#include "linear/hierarchy_age.hpp"
#include "linear/krylov_solver.hpp"
#include "linear/recycling_gmres.hpp"
#include "linear/saddle_matrix.hpp"
#include "linear/saddle_unknowns.hpp"
#include "mechanics/solver/nodal_pressure.hpp"
#include "mechanics/solver/saddle_preconditioner.hpp"

namespace solidus::mechanics {

struct SaddleSolverOptions {
  linear::SolverKind kind = linear::SolverKind::automatic;  ///< automatic, direct or multigrid
  bool symmetric = true;
  double relative_tolerance = 1e-8;
};

class SaddleSolver final : public linear::TangentSolver {
 public:
  /// @param displacement  prescribed degrees of freedom and constraints set
  /// Keeps references to all its arguments but the last. Collective.
  SaddleSolver(const mesh::Mesh& mesh, linear::BlockMatrix& displacement, NodalPressure& pressure,
               const parallel::GhostExchange& ghosts, SaddleSolverOptions options);
  ~SaddleSolver() override;

  /// Adds the pressures' part of the tangent, after the blocks have added theirs to the matrix of
  /// displacements. Collective.
  void assemble();
  linear::SaddleMatrix& matrix() { return matrix_; }

  /// The right-hand side and the solution are those of the monotone form, [owned node][component] of
  /// displacements and then [owned node][field] of pressures: b = (−r_u, +unit r_p).
  linear::LinearReport solve(linear::BlockMatrix& a, std::span<const double> b, std::span<double> x,
                             double forcing) override;
  linear::LinearReport solve_again(std::span<const double> b, std::span<double> x, double forcing) override;
  void forget() override;
  void reset() override;
  linear::SolverSeconds seconds() const override { return {seconds_.setup, seconds_.solve}; }
  std::size_t bytes() const;

 private:
  void find_unknowns();
  /// Whether factors are the faster way for the matrix of now; nothing where only their analysis can say.
  std::optional<bool> prefers_factors() const;
  /// Settles that, and makes the solver, unless there is one that serves.
  void choose();
  void make_solver();
  void set_up();
  /// The right-hand side and the solution of the unknowns, from and to those of solve().
  void restrict_right(std::span<const double> b);
  void expand_solution(std::span<double> x);
  /// Solves with the factors of an iteration before; a report that has not converged where they do not serve.
  linear::LinearReport solve_with_old_factors(std::span<const double> b, double forcing);
  /// y = K x of the unknowns.
  void multiply(std::span<const double> x, std::span<double> y);
  void precondition(std::span<const double> r, std::span<double> z);

  /// Which of the two solvers it is.
  struct Choice {
    bool settled = false;  ///< `direct` is
    bool made = false;     ///< there is a solver for this pattern
    bool direct = true;
  };
  /// The solver of the whole, and what it multiplies by.
  struct Outer {
    std::unique_ptr<linear::FunctionMatrix> matrix;
    std::optional<linear::KrylovSolver> factorised;   ///< where few are unknown
    std::optional<linear::RecyclingGmres> iterative;  ///< where many are
  };
  struct Seconds {
    double setup = 0, solve = 0;
  };
  struct Work {
    std::vector<double> right, solution;  ///< [unknown]
    std::vector<double> whole, product, local_u, local_p;
  };

  const mesh::Mesh& mesh_;
  linear::BlockMatrix& displacement_;
  NodalPressure& pressure_;
  const parallel::GhostExchange& ghosts_;
  SaddleSolverOptions options_;
  linear::SaddleMatrix matrix_;
  std::optional<linear::SaddleUnknowns> unknowns_;
  linear::SaddleCopy copy_;
  Outer outer_;
  std::optional<SaddlePreconditioner> preconditioner_;
  linear::HierarchyAge hierarchy_;
  linear::FactorAge factors_;
  Choice choice_;
  Seconds seconds_;
  Work work_;
};

}  // namespace solidus::mechanics
