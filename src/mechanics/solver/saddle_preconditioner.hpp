/// A preconditioner of the saddle point of mixed elements (saddle_solver.hpp), from the right, in two
/// factors:
///
///   K ⎡ 1      0 ⎤ = ⎡ A + B W⁻¹ Bᵀ   B  ⎤        ⎡ A_γ   B ⎤ ⎧z_u⎫   ⎧r_u⎫        z_p += W⁻¹ Bᵀ z_u
///     ⎣ W⁻¹Bᵀ 1 ⎦   ⎣       …         −C ⎦ ,      ⎣ 0    −S̃ ⎦ ⎩z_p⎭ = ⎩r_p⎭ ,
///
/// A_γ by one cycle of multigrid, S̃ = C + S + ∫ N 1/(2Ĝ) N dV by incomplete Cholesky factors on each process,
/// or by a cycle of multigrid of its own where melt flows between dendrites: S̃ is Darcy's Laplacian there.
///
/// A alone has no stiffness against a body that swells evenly, and a hierarchy cannot be made of it. The
/// first factor gives it one, W = diag (∫ N 1/(2Ĝ) + Δt K/μ |∇N|² dV)/γ, without a change of what is solved:
/// the augmented Lagrangian of Benzi and Olshanskii, SIAM J. Sci. Comput. 28 (2006) 2095, with the pressure
/// as the variable that is transformed. Of A_γ the hierarchy has ∫ bᵀ s̄ b dV, b = Bᵀ 1, in place of B W⁻¹ Bᵀ,
/// which would couple neighbours of neighbours, with the stiffness s = ∫ N dV/W of the nodes.
/// That is a harmonic mean: a frozen element between soft ones swells at their cost, as the nodal pressure
/// lets it.
///
/// With W⁻¹ and S̃ so chosen the number of iterations depends neither on the mesh nor on how nearly
/// incompressible the body is (Elman, Silvester and Wathen, Finite Elements and Fast Iterative Solvers, 2nd
/// ed., section 4.2), as far as the cycle is that good for A_γ and as 2Ĝ does not jump.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "linear/block_multigrid.hpp"
#include "linear/incomplete_cholesky.hpp"
#include "linear/saddle_matrix.hpp"
#include "mechanics/solver/nodal_pressure.hpp"

namespace solidus::mechanics {

class SaddlePreconditioner {
 public:
  /// Whether multigrid can be had for this matrix.
  static bool serves(const linear::BlockMatrix& displacement);
  /// @param symmetric  whether A is
  /// Keeps references to the other arguments. Collective.
  SaddlePreconditioner(const mesh::Mesh& mesh, linear::SaddleMatrix& matrix, NodalPressure& pressure,
                       const parallel::GhostExchange& ghosts, bool symmetric);

  /// New factors or hierarchy of S̃, and W, for the moduli of now. Collective.
  void set_up_schur();
  /// A new hierarchy for A as it is. Collective.
  void set_up_displacement();
  /// z ≈ K⁻¹ r on owned degrees of freedom, displacements and then pressures. Collective.
  void apply(std::span<const double> r, std::span<double> z);
  std::size_t bytes() const;

 private:
  void find_softness();

  const mesh::Mesh& mesh_;
  linear::SaddleMatrix& matrix_;
  NodalPressure& pressure_;
  const parallel::GhostExchange& ghosts_;
  linear::BlockMultigrid multigrid_;
  std::vector<std::unique_ptr<linear::BlockMatrix>> schur_;  ///< of each field: fields do not couple
  std::vector<linear::IncompleteCholesky> factors_;          ///< of each field where no melt flows
  std::vector<std::unique_ptr<linear::BlockMultigrid>> schur_cycles_;  ///< the same where it does
  std::vector<double> stiffness_;                                      ///< s [Pa], [local node][field]
  std::vector<double> inverse_softness_;                               ///< W⁻¹, [owned node][field]
  std::vector<double> right_, part_, result_, local_, local_u_;        ///< scratch
};

}  // namespace solidus::mechanics
