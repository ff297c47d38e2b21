/// A block triangular preconditioner of the saddle point of mixed elements (mixed_solver.hpp):
///
///   ⎡ A   B  ⎤ ⎧z_u⎫   ⎧r_u⎫      A by one cycle of multigrid,
///   ⎣ 0  −S̃ ⎦ ⎩z_p⎭ = ⎩r_p⎭      S̃ by incomplete factors on each process
///
/// With the Schur complement S̃ = C + S + ∫ N 1/(2Ĝ) N dV the number of iterations depends neither on the
/// mesh nor on how nearly incompressible the body is (Elman, Silvester and Wathen, Finite Elements and Fast
/// Iterative Solvers, 2nd ed., section 4.2), as far as the cycle is that good for A.
#pragma once

#include <petscmat.h>

#include <memory>
#include <span>

#include "algebra/multigrid.hpp"
#include "mechanics/saddle_operator.hpp"

namespace solidus::mechanics {

class SaddlePreconditioner {
 public:
  /// Whether multigrid can be had for this matrix.
  static bool serves(const algebra::BlockMatrix& displacement);
  /// @param symmetric  whether A is
  SaddlePreconditioner(const mesh::Mesh& mesh, int components, bool symmetric);
  ~SaddlePreconditioner();

  /// A new hierarchy for A as it stands. Collective.
  void set_up(algebra::BlockMatrix& a);
  /// @param schur  −S̃, which must live until the next call. Collective.
  void set_schur(Mat schur);
  /// On owned degrees of freedom, displacements and then pressures, of the saddle point with this B.
  /// Collective.
  void apply(SaddleOperator& of, std::span<const double> r, std::span<double> z);
  std::size_t bytes() const { return multigrid_.bytes(); }

 private:
  algebra::Multigrid multigrid_;
  struct Petsc;
  std::unique_ptr<Petsc> petsc_;
};

}  // namespace solidus::mechanics
