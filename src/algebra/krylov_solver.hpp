/// Krylov's methods on an operator that is preconditioned by another, assembled matrix
/// (corrected_matrix.hpp): conjugate gradients where both are positive definite, else flexible GMRES.
#pragma once

#include <petscksp.h>

#include <memory>
#include <span>
#include <string>

#include "algebra/linear_solver.hpp"

namespace solidus::algebra {

/// What is done with the assembled matrix.
enum class Preconditioner {
  factorisation,  ///< MUMPS
  multigrid,      ///< GAMG
  saddle          ///< of a MATNEST {u, p}: multigrid on u, and a given matrix for the Schur complement of p
};

struct KrylovOptions {
  std::string prefix;  ///< of PETSc's options
  Preconditioner preconditioner = Preconditioner::factorisation;
  bool definite = true;   ///< positive
  bool symmetric = true;  ///< the preconditioning matrix
  int max_iterations = 500;
};

class KrylovSolver {
 public:
  explicit KrylovSolver(KrylovOptions options);
  ~KrylovSolver();
  /// Rigid-body modes of the first block (Preconditioner::saddle), from the coordinates of the owned nodes.
  void use_rigid_body_modes(const mesh::Mesh& mesh, int components);

  /// From here on the operator and what preconditions it, set up at the next solve.
  /// @param schur  of Preconditioner::saddle: near the Schur complement of the second block
  void set(Mat op, Mat preconditioner, Mat schur = nullptr);
  /// Solves to ‖b − A x‖ <= max(relative ‖b‖, absolute) from x = 0, on owned degrees of freedom. Collective.
  LinearReport solve(std::span<const double> b, std::span<double> x, double relative, double absolute = 0);
  /// y = A x with the operator of set(), on owned degrees of freedom. Collective.
  void multiply(std::span<const double> x, std::span<double> y);
  /// The next matrices have another pattern, or nothing of the past shall count.
  void reset();
  double seconds_setup() const;
  double seconds_solve() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace solidus::algebra
