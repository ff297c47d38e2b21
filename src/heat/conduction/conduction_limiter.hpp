/// Keeps conduction within bounds on meshes whose conduction matrix has positive off-diagonal entries.
///
/// With K_ij = ∫∇N_i·∇N_j dV of a body and Kirchhoff's potential u the heat that leaves node i is
///
///   r_i = Σ_j K_ij (u_j − u_i)                                                                       [W]
///
/// Where all K_ij <= 0 no node can be hotter than its neighbours, or colder, unless it stores or receives
/// heat. Obtuse elements, bent quads and hexes and every quadratic element have pairs with K_ij > 0, through
/// which heat flows from cold to hot, a_ij = K_ij (u_i − u_j) into the hotter node i. Of each such flow only
/// a share is let through (algebraic flux correction):
///
///   r_i += (1 − α_ij) a_ij,   r_j −= (1 − α_ij) a_ij,   α_ij = min(R_i⁺, R_j⁻)
///
///   R_i⁺ = min(1, Q_i⁺/P_i⁺),   P_i⁺ = Σ_j a_ij over the colder partners j,
///   Q_i⁺ = γ_i Σ_m K_ii [u(max_j Θ_j) − u(Θ_i)] + c × (free conduction, surfaces, sources)
///
/// and R_j⁻ likewise with the least Θ around it and the heat that it loses. So a node that is hotter than all
/// around it gets nothing from colder ones unless its film or a source warms it. The flows are exchanged
/// between two nodes: no heat is lost. γ_i is such that α = 1 for every linear field around an inner node:
/// linear fields are exact, and the order of the elements stays.
///
/// The shares α are found at given temperatures and held until they are found again, so that conduction stays
/// linear in u, symmetric and positive semi-definite, and the iteration of a step converges as it does
/// without them. The solver of a step updates them at the temperatures reached.
///
/// D. Kuzmin, J. Comput. Appl. Math. 236 (2012) 2317 (linearity-preserving limiters); G. R. Barrenechea,
/// V. John and P. Knobloch, Math. Models Methods Appl. Sci. 27 (2017) 525 (a limiter with a discrete maximum
/// principle that keeps linear fields on general meshes). Supply in Q is ours.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "heat/conduction/kirchhoff_potential.hpp"
#include "heat/loads/surface_heat.hpp"
#include "linear/block_matrix.hpp"
#include "mesh/mesh.hpp"
#include "parallel/parallel.hpp"

namespace solidus::heat {

/// Nodes that have left the range of temperatures around them, which take nothing more on that side.
class HeldNodes {
 public:
  /// @param nodes  owned nodes that may be held; kept by reference
  HeldNodes(const mesh::Mesh& mesh, const std::vector<Index>& nodes) : mesh_(mesh), nodes_(nodes) {}

  /// No node is there, the same ones as before, others too.
  enum class Found { none, as_before, further };
  /// Sets α = 0 from here on for flows into owned nodes above `highest` and out of those below `lowest`,
  /// until release(). Collective.
  Found hold(std::span<const double> temperature, double lowest, double highest);
  void release() { held_.clear(); }
  /// Whether nothing may flow into (even) or out of (odd) the owned node of this entry, [owned node][2].
  bool holds(std::size_t entry) const { return !held_.empty() && held_[entry] != 0; }
  std::size_t bytes() const { return held_.capacity(); }

 private:
  const mesh::Mesh& mesh_;
  const std::vector<Index>& nodes_;
  std::vector<char> held_;  ///< [owned node][2]; empty: none
};

class ConductionLimiter {
 public:
  /// @param potentials  one per body; must outlive this object, as the mesh must
  ConductionLimiter(const mesh::Mesh& mesh, std::span<const KirchhoffPotential> potentials);

  /// Collects the pairs of all bodies again: clear(), add_body() for each one, finish().
  void clear();
  /// @param matrix  Σ K_ij of the body alone
  void add_body(int body, linear::BlockMatrix& matrix);
  /// Collective. The slots of the pairs are those of this matrix, which must outlive this object.
  void finish(const linear::BlockMatrix& matrix);
  /// Whether there are pairs with K_ij > 0, on any process.
  bool needed() const { return needed_; }

  /// Finds the shares α at these temperatures. Returns whether they are taken: where Σ|Δα a_ij| of all
  /// processes, by how much they change the flows there, is not above `negligible` [W], the old ones stay.
  /// Collective.
  /// @param temperature  [K], [local node], ghosts up to date
  /// @param gain, loss   heat that owned nodes receive and lose by free conduction, surfaces and sources [W],
  /// both positive
  /// @param fixed        [local node]: nodes whose temperature is prescribed need no limit
  /// @param flows        further flows to limit: all that concern owned nodes; gets `left` where they are
  /// taken
  bool find_shares(std::span<const double> temperature, std::span<const double> gain,
                   std::span<const double> loss, std::span<const char> fixed, double negligible,
                   std::span<LimitedFlow* const> flows);
  /// All α = 1.
  void clear_shares() { std::fill(left_.begin(), left_.end(), 0.0); }
  /// Nodes that take nothing more on a side (HeldNodes), where needed(); find_shares() makes it so.
  HeldNodes& held() { return held_; }
  /// r += the part of the flows that is not let through.
  void add_heat(std::span<const double> temperature, std::span<double> r) const;
  /// matrix += ∂/∂v of that, in the unknown of nodal_potential.hpp: symmetric, no less than zero.
  void add_symmetric_tangent(linear::BlockMatrix& matrix) const;
  /// matrix += ∂/∂Θ of that.
  void add_tangent(std::span<const double> temperature, linear::BlockMatrix& matrix) const;
  std::size_t bytes() const;

 private:
  /// K_ij > 0 of one body: i is owned, j > i perhaps a ghost.
  struct Pair {
    Index i, j;
    double k;  ///< [m]
    linear::BlockMatrix::Slot ij, ji;
  };
  struct Diagonal {
    Index node;
    double k;  ///< K_ii [m]
  };
  struct Body {
    int body;
    std::vector<Pair> pairs;
    std::vector<Diagonal> diagonal;  ///< of owned nodes that have pairs in any body
  };
  void find_factors();
  void find_extremes(std::span<const double> temperature);
  /// Calls f(position, pair, flow a_ij into i [W]) for the pairs of all bodies.
  template <class F>
  void for_flows(std::span<const double> temperature, const F& f) const;
  /// Calls f(potential, pair, 1 − α) where that is not zero.
  template <class F>
  void for_held(const F& f) const;

  const mesh::Mesh& mesh_;
  std::span<const KirchhoffPotential> potentials_;
  parallel::GhostExchange ghosts_;
  bool quadratic_ = false;                       ///< whether there are quadratic elements, on any process
  const linear::BlockMatrix* matrix_ = nullptr;  ///< its pattern tells the neighbours
  bool needed_ = false;
  std::vector<Body> bodies_;
  std::vector<Index> nodes_;              ///< owned nodes with pairs
  std::vector<double> gamma_;             ///< γ_i, [owned node]
  std::vector<double> highest_, lowest_;  ///< Θ around the owned nodes
  std::vector<double> sums_;              ///< P⁺, P⁻, [owned node][2]
  std::vector<double> shares_;            ///< Q, then R, [local node][2]
  std::vector<double> left_;              ///< 1 − α, [pair] of the bodies in order
  HeldNodes held_;
};

}  // namespace solidus::heat
