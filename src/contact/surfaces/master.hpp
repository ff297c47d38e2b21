/// Interface of a master surface, which slave points may meet: a surface of a mesh or a rigid analytic one,
/// both used alike by SlidingKinematics.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "contact/surfaces/face.hpp"
#include "contact/surfaces/facet_heights.hpp"
#include "contact/surfaces/rotation.hpp"
#include "numbers/types.hpp"

namespace solidus::contact {

/// Partner of a slave point on the master: its place and normal.
struct Partner {
  /// The partner lies inside a face; or on an edge or at a vertex between faces, for all points of the wedge
  /// that their normals leave open: there the normal is the direction of the distance.
  enum class Region { face, edge, vertex };
  Index face = -1;  ///< −1: no partner within reach
  Region region = Region::face;
  bool averaged = false;   ///< found along the field of averaged normals
  Point xi{};              ///< ξ̄ on the face; analytic surfaces: Ȳ
  Point along{};           ///< region edge: the edge's direction in ξ
  double penetration = 0;  ///< g_N (3.5) [m]
  Point normal{};          ///< ν, out of the master (3.10b)
  double covered = 1;  ///< share of the point's part of the slave that the master faces: less beyond its rim
  std::array<double, 2> covered_xi{};  ///< ∂covered/∂ξ^α
};

/// The master at a partner: place, convected basis and normals, in both configurations (3.8–3.14), and what
/// of it moves with which node. In two dimensions the second basis vector is e_z and nothing changes along
/// ξ².
struct MasterFrame {
  int n_face_nodes = 0;
  std::span<const Index> nodes;                  ///< the face's, then those of the director alone
  std::array<double, k_max_face_nodes> share{};  ///< N of the face's nodes
  std::array<std::array<double, 2>, k_max_face_nodes> slope{};  ///< ∂N/∂ξ^α

  Point y{}, reference_y{};                           ///< ȳ, Ȳ [m]
  std::array<Point, 2> tau{}, reference_tau{};        ///< τ_α, τ_α^ref (3.9)
  std::array<Point, 3> tau_xi{}, reference_tau_xi{};  ///< τ_α,β in the order 11, 22, 12
  Point face_normal{}, reference_face_normal{};       ///< of the face itself (3.10)
  std::array<Point, 2> reference_face_normal_xi{};

  /// The director ν: the face's normal, or the field of averaged normals, and its derivatives.
  Point nu{}, reference_nu{};
  std::array<Point, 2> nu_xi{}, reference_nu_xi{};
  std::vector<Tensor> nu_rate;  ///< [node] ∂ν/∂x at fixed ξ; with rates
};

class Master {
 public:
  virtual ~Master() = default;
  /// Moves to a displacement and a time.
  virtual void place(std::span<const double> displacement, double time) = 0;
  /// The partner of the place x, on a side of the master that looks against the unit normal of the slave.
  /// @param hint a face that may be near, or −1: speeds the search up, never changes its result
  virtual Partner find(const Point& x, const Point& slave_normal, Index hint) const = 0;
  /// Marks faces [face]: may_meet_watched() then tells points apart that find() need not be asked for.
  virtual void watch(std::vector<char>) {}  // NOLINT: overriding functions store them
  /// False only where find() has no partner, or one whose closest face is none of the marked ones.
  virtual bool may_meet_watched(const Point&, const Point& /*slave_normal*/, Index /*hint*/) const {
    return false;
  }
  /// @param rates whether nu_rate is asked for
  virtual void frame(const Partner& partner, bool rates, MasterFrame& frame) const = 0;
  /// Whether a point with this partner at the start lies on the far side, where it never meets the surface.
  virtual bool behind(const Partner&) const { return false; }
  /// Returns the displacement of the particle at a partner by a prescribed motion from one time to another
  /// [m].
  virtual Point way(const Partner&, double /*from*/, double /*to*/) const { return {}; }
  /// Heights of its facets; null: it has none.
  virtual const FacetHeights* heights() const { return nullptr; }
  /// The most nodes that a frame has.
  virtual std::size_t max_nodes() const = 0;
  /// True when the reference normal turns on a face: then carried tractions have rates.
  virtual bool reference_turns() const = 0;
  /// Whether ∂g_N/∂x_b = B_b n, so that normal forces have a potential.
  virtual bool symmetric() const { return true; }
  /// Faces of a mesh; none for surfaces without nodes.
  virtual Index n_faces() const { return 0; }
  /// Nodes that a frame on this face may have.
  virtual std::span<const Index> nodes(Index face) const = 0;
  /// The face itself and those that share a node with it, sorted. Empty for masters without nodes.
  virtual std::span<const Index> around(Index face) const = 0;
};

/// τ^α of the basis τ_α with the unit normal n (3.13b).
inline std::array<Point, 2> dual_basis(const std::array<Point, 2>& tau) {
  const double m11 = dot(tau[0], tau[0]), m22 = dot(tau[1], tau[1]), m12 = dot(tau[0], tau[1]);
  const double det = m11 * m22 - m12 * m12;
  return {add_scaled(scale(m22 / det, tau[0]), -m12 / det, tau[1]),
          add_scaled(scale(m11 / det, tau[1]), -m12 / det, tau[0])};
}

}  // namespace solidus::contact
