/// A block triangular preconditioner of the saddle point of mixed elements (saddle_solver.hpp):
///
///   ⎡ A   B  ⎤ ⎧z_u⎫   ⎧r_u⎫      A by one cycle of multigrid,
///   ⎣ 0  −S̃ ⎦ ⎩z_p⎭ = ⎩r_p⎭      S̃ by incomplete Cholesky factors on each process
///
/// With the Schur complement S̃ = C + S + ∫ N 1/(2Ĝ) N dV the number of iterations depends neither on the
/// mesh nor on how nearly incompressible the body is (Elman, Silvester and Wathen, Finite Elements and Fast
/// Iterative Solvers, 2nd ed., section 4.2), as far as the cycle is that good for A.
///
/// A alone has no stiffness against a body that swells evenly. The hierarchy is therefore made of A with a
/// stiffness 2Ĝ (1/3 + 1/2) against the divergence, which gives it the stiffness of Poisson's ratio 1/4; the
/// operator itself is without it.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "algebra/incomplete_cholesky.hpp"
#include "algebra/multigrid.hpp"
#include "algebra/saddle_matrix.hpp"
#include "mechanics/nodal_pressure.hpp"

namespace solidus::mechanics {

class SaddlePreconditioner {
 public:
  /// Whether multigrid can be had for this matrix.
  static bool serves(const algebra::BlockMatrix& displacement);
  /// @param symmetric  whether A is
  /// Keeps references to the other arguments. Collective.
  SaddlePreconditioner(const mesh::Mesh& mesh, algebra::SaddleMatrix& matrix, NodalPressure& pressure,
                       const algebra::GhostExchange& ghosts, bool symmetric);

  /// New factors of S̃, for the moduli of this step. Collective.
  void set_up_schur();
  /// A new hierarchy for A as it stands. Collective.
  void set_up_displacement();
  /// z ≈ K⁻¹ r on owned degrees of freedom, displacements and then pressures. Collective.
  void apply(std::span<const double> r, std::span<double> z);
  std::size_t bytes() const;

 private:
  const mesh::Mesh& mesh_;
  algebra::SaddleMatrix& matrix_;
  NodalPressure& pressure_;
  const algebra::GhostExchange& ghosts_;
  algebra::Multigrid multigrid_;
  std::vector<std::unique_ptr<algebra::BlockMatrix>> schur_;  ///< of each field: fields do not couple
  std::vector<algebra::IncompleteCholesky> factors_;
  std::vector<double> right_, part_, result_, local_;
};

}  // namespace solidus::mechanics
