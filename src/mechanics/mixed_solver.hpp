/// The linear systems of Newton's method where elements have a pressure (pressure_equation.hpp):
///
///   ⎡ A   B     ⎤ ⎧δu⎫   ⎧−r_u⎫
///   ⎣ Bᵀ −(C+S) ⎦ ⎩δp⎭ = ⎩  0 ⎭        whose Schur complement in u is the tangent
///
/// S couples neighbours of neighbours and is never assembled: flexible GMRES has it in its operator and goes
/// without that part in its preconditioner, which is the LDLᵀ of MUMPS or, for many unknowns, block
/// triangular (saddle_preconditioner.hpp), set up for every matrix: that costs as much as ten iterations and
/// saves more. There A gets a stiffness 2Ĝ/3 against the divergence, which the operator is without: alone it
/// is singular where a body may swell. Where that does not converge, and a factorisation is possible, it
/// takes over until forget().
///
/// What an iterative solver leaves in the second row comes back in the forces, once the pressure is
/// eliminated, up to κ/2Ĝ times as large: r = r_u + B (C+S)⁻¹ r_p. The iteration goes on until r is small
/// enough. PETSc options: mechanics_mixed_, and for the pressure of the block triangular one
/// mechanics_mixed_p_.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "mechanics/pressure_equation.hpp"
#include "mechanics/saddle_preconditioner.hpp"

namespace solidus::mechanics {

struct MixedSolverOptions {
  bool direct = true;
  bool symmetric = true;
  double relative_tolerance = 1e-8;
};

class MixedSolver final : public algebra::TangentSolver {
 public:
  /// @param displacement  prescribed degrees of freedom and ties set
  /// What is passed by reference must outlive this object. Collective.
  MixedSolver(const mesh::Mesh& mesh, algebra::BlockMatrix& displacement, PressureEquation& pressure,
              const algebra::GhostExchange& ghosts, MixedSolverOptions options);
  ~MixedSolver() override;

  /// After the blocks have added their tangents to the matrix of displacements. Collective.
  void assemble();

  algebra::LinearReport solve(algebra::BlockMatrix& a, std::span<const double> b, std::span<double> x,
                              double forcing) override;
  algebra::LinearReport solve_again(std::span<const double> b, std::span<double> x, double forcing) override;
  void forget() override;
  void reset() override;
  double seconds_setup() const override { return seconds_setup_; }
  double seconds_solve() const override { return seconds_solve_; }
  std::size_t bytes() const;

 private:
  struct Petsc;

  void make_solver(bool direct);
  void set_operators();
  bool factorisation_serves() const;
  algebra::LinearReport attempt(std::span<const double> b, double forcing);
  template <class Function>
  void on_whole(std::span<const double> x, std::span<double> y, Function&& f);
  algebra::LinearReport solve_once(double absolute);
  void multiply(std::span<const double> x, std::span<double> y);
  void add_terms(std::span<const double> x, std::span<double> y);
  algebra::LinearReport solve_to(double relative, std::span<const double> b);
  double reduced_residual();

  const mesh::Mesh& mesh_;
  algebra::BlockMatrix& displacement_;
  PressureEquation& pressure_;
  const algebra::GhostExchange& ghosts_;
  MixedSolverOptions options_;
  std::unique_ptr<algebra::BlockMatrix> compliance_;  ///< −(C + S) but for the projection, times unit²
  std::unique_ptr<algebra::BlockMatrix> schur_;       ///< of the block triangular preconditioner
  algebra::CoupledMatrix matrix_;
  algebra::CorrectedMatrix operator_;
  bool augmented_ = false;  ///< A has the stiffness against the divergence
  bool direct_ = true;
  std::optional<algebra::KrylovSolver> solver_;
  std::optional<SaddlePreconditioner> preconditioner_;
  std::optional<SaddleOperator> saddle_;  ///< for which it is
  double seconds_setup_ = 0, seconds_solve_ = 0;
  std::vector<double> right_, solution_;      ///< owned, displacements and then pressures
  std::vector<double> residual_, direction_;  ///< of the same
  double tightening_ = 1;                     ///< of the tolerance, so that the reduced residual is small
  std::vector<double> whole_in_, whole_out_, free_in_, free_out_;  ///< scratch
  std::vector<double> swelling_, pull_;                            ///< scratch, [local node][component]
  std::unique_ptr<Petsc> petsc_;
};

/// Whether MUMPS serves: in two dimensions and on small meshes in three.
bool factorises(algebra::SolverKind kind, const mesh::Mesh& mesh, int components);

}  // namespace solidus::mechanics
