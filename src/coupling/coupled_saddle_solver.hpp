/// The linear solver of displacement, pressure and temperature at once: one linear solve of
///
///   ⎡ A    B      K_uΘ ⎤ ⎧δu⎫     ⎧r_u⎫
///   ⎢ Bᵀ  −(C+S)  K_pΘ ⎥ ⎪δp⎪ = − ⎪r_p⎪
///   ⎣ K_Θu K_Θp   K_ΘΘ ⎦ ⎩δΘ⎭     ⎩r_Θ⎭
///
/// for an iteration of Newton's method in the simultaneous scheme. Few unknowns are factorised, LU by MUMPS.
/// Many take flexible GMRES with a block triangular preconditioner: first the temperatures, GMRES with
/// incomplete LU on K_ΘΘ to a hundredth, then displacement and pressure with what those have left, by the
/// preconditioner of the splits (mechanics/solver/saddle_preconditioner.hpp). What the displacement does to
/// the heat is a share δ of what it started from (docs/theory/coupling.md) and is left to GMRES. Where that
/// does not converge and a factorisation is possible, it takes over until forget(); tied unknowns are always
/// factorised.
///
/// The part of S that couples neighbours of neighbours, with orthogonal sub-scales, is applied and never
/// assembled, as in the splits. PETSc options: coupled_, and coupled_temperature_ within the preconditioner.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "linear/coupled_solver.hpp"
#include "linear/coupled_unknowns.hpp"
#include "linear/function_matrix.hpp"
#include "linear/hierarchy_age.hpp"
#include "linear/krylov_solver.hpp"
#include "linear/recycling_gmres.hpp"
#include "mechanics/solver/nodal_pressure.hpp"
#include "mechanics/solver/saddle_preconditioner.hpp"

namespace solidus::coupling {

class CoupledSaddleSolver final : public linear::CoupledTangentSolver {
 public:
  /// @param matrix  with a saddle point
  /// Keeps references to all its arguments but the last two. Collective.
  CoupledSaddleSolver(const mesh::Mesh& mesh, linear::CoupledMatrix& matrix,
                      mechanics::NodalPressure& pressure, const parallel::GhostExchange& ghosts,
                      linear::CoupledSolverKind kind, double relative_tolerance);

  /// @param a  the matrix of the constructor
  linear::LinearReport solve(linear::CoupledMatrix& a, std::span<const double> force,
                             std::span<const double> heat, linear::FieldWeights weights, std::span<double> u,
                             std::span<double> temperature, double forcing) override;
  linear::FieldWeights in_use(linear::FieldWeights weights) const override { return weights; }
  void forget() override { make_solver(factorises()); }
  void reset() override;
  double seconds() const override { return seconds_; }

 private:
  void find_unknowns();
  bool factorises() const;
  void make_solver(bool direct);
  void set_up();
  /// y = D K x of the unknowns, D the weights of the rows.
  void multiply(std::span<const double> x, std::span<double> y);
  /// z ≈ K⁻¹ D⁻¹ r.
  void precondition(std::span<const double> r, std::span<double> z);
  void find_temperatures(std::span<const double> heat, std::span<double> temperature);
  /// Multiplies rows of the whole by their weights, or divides.
  void weight(std::span<double> whole, bool divide) const;
  std::size_t n_displacements() const;
  std::size_t n_pressures() const;

  /// The solver of the whole, and what it multiplies by.
  struct Outer {
    bool direct = true;
    std::unique_ptr<linear::FunctionMatrix> matrix;
    std::optional<linear::KrylovSolver> factorised;   ///< where few are unknown
    std::optional<linear::RecyclingGmres> iterative;  ///< where many are
  };
  /// The solver of the temperatures, part of the preconditioner.
  struct Heat {
    std::optional<linear::LinearSolver> solver;
    bool changed = true;  ///< K_ΘΘ has, since the last solve with it
  };
  struct Work {
    std::vector<double> right, solution;  ///< [unknown]
    std::vector<double> whole, product, part, local_u, local_p, local_t;
  };

  const mesh::Mesh& mesh_;
  linear::CoupledMatrix& matrix_;
  mechanics::NodalPressure& pressure_;
  const parallel::GhostExchange& ghosts_;
  linear::CoupledSolverKind kind_;
  double tightest_;  ///< relative tolerance
  std::optional<linear::CoupledUnknowns> unknowns_;
  linear::CoupledCopy copy_;
  Outer outer_;
  std::optional<mechanics::SaddlePreconditioner> saddle_;
  Heat heat_;
  linear::HierarchyAge hierarchy_;
  linear::FieldWeights weights_;
  double seconds_ = 0;
  Work work_;
};

}  // namespace solidus::coupling
