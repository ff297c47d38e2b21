/// Conduction of linear triangles and tetrahedra at re-entrant edges (mesh/making/reentrant_edges.hpp).
///
/// Around an edge where a body fills the angle ω > π a temperature goes as
///
///   s = r^α cos αφ  (both faces at one temperature)   or   s = r^α sin αφ  (no heat through them),   α = π/ω
///
/// with the distance r from the edge and the angle φ from the bisector: its gradient has no bound, and linear
/// elements conduct too well there. That error does not stay there. It goes with h^(2α) everywhere, h^(4/3)
/// for sand along a rim of 90 degrees of the casting, and is the largest one of a mould of coarse elements.
/// In the elements that touch such an edge conduction across the edge is multiplied by
///
///   c = Σ_s ∫∇s · ∇I s dV / Σ_s ∫|∇I s|² dV,        I s: s interpolated by the element
///
/// so that the interpolated function conducts what the function itself does: Σ_e c_e ∫|∇I s|² is then
/// ∫∇s · ∇I s = ∫|∇s|², as ∇s has no divergence and s − I s no value on the boundary. Conduction along the
/// edge stays as it is: its conductivity is k (t ⊗ t + c (1 − t ⊗ t)), with the direction t of the edge, so
/// that a temperature that is linear along the edge remains exact. One that is linear across it is no longer
/// so.
///
/// Idea: H. Egger, U. Rüde and B. Wohlmuth, SIAM J. Numer. Anal. 52 (2014) 171 (energy-corrected finite
/// elements: conduction reduced in the elements at the corner takes the error away from everywhere else).
/// Their factor is one number for a family of meshes; this one follows from each element.
#pragma once

#include <array>
#include <optional>
#include <unordered_map>

#include "mesh/making/reentrant_edges.hpp"
#include "mesh/mesh.hpp"

namespace solidus::heat {

/// The part of its conductivity that an element loses, (1 − c)(1 − t ⊗ t), or the mean of that over all edges
/// that it touches; symmetric.
using EdgeLoss = std::array<std::array<double, 3>, 3>;

class EdgeConduction {
 public:
  /// Nothing is corrected.
  EdgeConduction() = default;
  /// Collective.
  explicit EdgeConduction(const mesh::Mesh& mesh);
  /// Nothing where the element touches no such edge or is neither a linear triangle nor a tetrahedron.
  /// @param nodes  of the element, local numbers
  std::optional<EdgeLoss> loss(const mesh::Mesh& mesh, mesh::Shape shape, const Index* nodes) const;
  /// No element of this process has another conduction than its own.
  bool empty() const { return wedges_.empty(); }

 private:
  const mesh::Wedge* wedge(Index node) const;

  std::unordered_map<Index, mesh::Wedge> wedges_;  ///< of local nodes, ghosts too
};

}  // namespace solidus::heat
