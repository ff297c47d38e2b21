/// Kinematics of the points of a contact pair: gap and slip of a displacement, for the laws, and the
/// derivatives that a consistent tangent needs.
///
/// At every point the bodies exchange the force w f on the slave and −w f on the master at the partner's
/// place (3.73), as nodal forces
///
///   r_b = w B_b f,   f = t_N n + F T
///
/// w    weight: slave area in the reference configuration (tractions are nominal, 3.6), with 2πr
/// B_b  shape functions of the slave's nodes and minus those of the master's at the partner
/// n    unit vector from the slave to the master, −ν of 3.10b
/// t_N  pressure [Pa], a function of the penetration g_N
/// T    frictional traction 3.42b as a vector in the master's tangent plane in the reference configuration:
///      its components are the t_Tα of the monograph, its length is the norm 3.52
/// F    carries T to the current configuration: τ^α ⊗ τ_α^ref
///
/// Slip is measured where T lives: ΔG = Ȳ_{n+1} − Ȳ_n, the way of the partner on the master in the reference
/// configuration since t_n (3.15a), so it does not see rigid motions and goes on from face to face.
#pragma once

#include <span>

#include "contact/points/contact_state.hpp"
#include "contact/surfaces/facet_heights.hpp"
#include "contact/surfaces/rotation.hpp"

namespace solidus::contact {

/// One point in a configuration. Arrays are owned by the ContactKinematics and live until its next call.
struct PointMotion {
  bool partnered = false;         ///< the point has a partner within reach; else the rest is void
  std::span<const Index> nodes;   ///< local numbers: the slave's, then the master's
  int n_slave = 0;                ///< how many of them are the slave's
  std::span<const double> share;  ///< B_b
  double weight = 0;              ///< w [m²]
  /// Share of the point's area that faces the master, w over Particle::area: less than one beyond the rim of
  /// the master.
  double covered = 1;
  double penetration = 0;  ///< g_N [m]
  Point normal{};          ///< n
  Tensor push{};           ///< F
  /// Where a point stands for a part of the slave, its forces take these means of B_b n and B_b F over that
  /// part in place of the products at the point. They are empty for a single point.
  std::span<const Point> normal_share;
  std::span<const Tensor> push_share;
  Point slip{};  ///< ΔG [m]; zero unless asked for
  /// T_n of `old` in the tangent plane at the new partner: turned by the smallest rotation that takes the old
  /// reference normal of the master to the new one [Pa]. The trial traction is carried + ε_T ΔG (5.30).
  Point carried{};
  Point anchor{};  ///< Ȳ_{n+1}, of an open point plus its opening along ν^ref [m]: ContactPointState::anchor
                   ///< of the next step
  Point master_normal{};  ///< ν^ref at the partner (3.10a): ContactPointState::master_normal of the next step
  // Asked for with the tangent:
  std::span<const Point> penetration_rate;  ///< ∂g_N/∂x_b
  std::span<const Point> weight_rate;       ///< ∂w/∂x_b [m]; empty: zero
  std::span<const Tensor> slip_rate;        ///< ∂ΔG_i/∂x_bj
  std::span<const Tensor> carried_rate;  ///< ∂carried_i/∂x_bj; empty: zero (masters flat in the reference)

  /// B_b n.
  Point normal_at(std::size_t b) const {
    return normal_share.empty() ? scale(share[b], normal) : normal_share[b];
  }
  /// B_b F v of a vector in the plane of T.
  Point pushed_at(std::size_t b, const Point& v) const {
    return push_share.empty() ? scale(share[b], times(push, v)) : times(push_share[b], v);
  }
  /// r_b/w of a pressure and a frictional traction.
  Point force_at(std::size_t b, double pressure, const Point& traction) const {
    return contact::add_scaled(pushed_at(b, traction), pressure, normal_at(b));
  }
};

class ContactKinematics {
 public:
  enum class Asked { motion, rates };
  virtual ~ContactKinematics() = default;
  virtual Index n_points() const = 0;
  /// Data of a contact point; all but `weight` do not depend on the motion.
  struct Particle {
    GlobalIndex number = 0;         ///< of all processes alike, and of runs on another number of them
    bool counted = false;           ///< this process counts it in sums; over all processes every point once
    Point position{};               ///< on the slave, reference configuration [m]
    double area = 0;                ///< that the point stands for, wherever it is [m²]
    double weight = 0;              ///< w of motion() as last placed [m²]
    std::span<const Index> nodes;   ///< of the slave's face, local numbers
    std::span<const double> share;  ///< their shape functions
  };
  virtual Particle particle(Index point) const = 0;
  /// The effect of facets of curved surfaces on the gap of a point, between it and its partner as last
  /// placed; of a point that stands for a part of the slave the mean.
  virtual FacetGap facets(Index /*point*/) const { return {}; }
  /// Whether the faces of a point are there; else it has no partner (growing_kinematics.hpp).
  virtual bool there(Index /*point*/) const { return true; }
  /// Part of the slave surface that has a partner in the reference configuration, 0 to 1. Collective at
  /// construction, not here.
  virtual double coverage() const = 0;
  /// Whether the derivatives of the normal forces are symmetric (not with averaged normals).
  virtual bool symmetric() const { return true; }
  /// Whether partners ever change: else graph_outdated() is never true.
  virtual bool partners_change() const { return true; }
  /// The time whose place prescribed motions of rigid surfaces have [s]; takes effect at the next place().
  virtual void set_time(double) {}
  /// The points that place() updates: all, or those that concern this process, which suffice for its rows and
  /// its part of sums.
  enum class Points { all, own };
  /// Updates the partners for a displacement [local node][component], ghosts up to date [m]. The result
  /// depends on displacement and time alone, not on earlier calls. Local: surfaces are held whole by every
  /// process.
  virtual void place(std::span<const double> displacement, Points points) = 0;
  void place(std::span<const double> displacement) { place(displacement, Points::all); }
  /// Whether the point, as it was last placed, can reach a node of this process. Points that do not may be
  /// left where they were by place() with Points::own: without a partner.
  virtual bool concerns(Index) const { return true; }
  /// One point at the displacement of the last place().
  /// @param old  at t_n: slip is counted from its anchor, whether it touched or not; where it had no partner,
  ///             from here (ΔG = 0)
  virtual PointMotion motion(Index point, const ContactPointState& old, Asked asked) const = 0;
  /// Adds the change of the forces by the geometry at fixed t_N and T,
  ///
  ///   K_bc += w [ ∂B_b/∂x_c ⊗ f + B_b (t_N ∂n/∂x_c + ∂(F T)/∂x_c) ],
  ///
  /// for the nodes of the last motion() with rates. @param k  [b][c], 3 × 3 blocks
  virtual void add_geometric_tangent(Index point, double pressure, const Point& traction,
                                     std::span<Tensor> k) const = 0;
  /// Adds ∂B_a/∂x_b, [a][b], for the nodes of the last motion() with rates: partners that stay have none.
  virtual void add_share_rates(Index /*point*/, std::span<Point> /*rates*/) const {}
  /// Returns the displacement of the master's particle at the partner, as last placed, by a prescribed motion
  /// from one time to another [m]: zero for masters with nodes.
  virtual Point master_way(Index /*point*/, double /*from*/, double /*to*/) const { return {}; }
  /// True when nodes meet that did not at the last add_to_graph(): matrices must be made again.
  virtual bool graph_outdated() const = 0;
  /// Cliques of nodes that may meet, with a margin for later displacements.
  /// @param add  called with each clique
  struct CliqueSink {
    virtual ~CliqueSink() = default;
    virtual void add(std::span<const Index> nodes) = 0;
  };
  virtual void add_to_graph(CliqueSink& sink) = 0;
};

}  // namespace solidus::contact
