/// Conjugate gradients with incomplete factors for a preconditioner, on half a BlockMatrix of one component.
///
/// The iteration of PETSc's KSPCG with the norm ‖b − A x‖ and its criterion, in three vectors and in fewer
/// passes through them: the preconditioned residual stays in single precision, in the factors' own vector. A
/// step of heat alone spends as much time in vectors as in products. M. R. Hestenes and E. Stiefel, J. Res.
/// Nat. Bur. Standards 49 (1952) 409.
#pragma once

#include <span>
#include <vector>

#include "linear/block_matrix.hpp"
#include "linear/incomplete_cholesky.hpp"
#include "linear/linear_solver.hpp"
#include "parallel/parallel.hpp"

namespace solidus::linear {

class ConjugateGradients {
 public:
  /// All must outlive this object.
  ConjugateGradients(const mesh::Mesh& mesh, const BlockMatrix& a, IncompleteCholesky& factors);

  /// Solves A x = b on owned nodes from x = 0, with the fixed rows and columns of the matrix left out. Ends
  /// where ‖b − A x‖ <= tolerance ‖b‖. Throws Interrupted as check_interruption() does. Collective.
  LinearReport solve(std::span<const double> b, std::span<double> x, double tolerance, int max_iterations);

 private:
  double precondition();

  const BlockMatrix& a_;
  IncompleteCholesky& factors_;
  parallel::GhostExchange ghosts_;
  std::vector<double> residual_, product_;  ///< [owned node]
  std::vector<double> direction_;           ///< [local node]
  std::span<const float> preconditioned_;
};

}  // namespace solidus::linear
