/// Rigid analytic surfaces as masters: plane, cylinder, sphere, with prescribed motion. They are unbounded (a
/// plane and a cylinder have no ends) and have no nodes: forces on them act on the slave alone.
#pragma once

#include <optional>

#include "contact/surfaces/master.hpp"
#include "numbers/table.hpp"

namespace solidus::contact {

/// Displacement of a rigid body: y = c + Q(θ) (Y − c) + d.
struct RigidMotion {
  std::array<Table, 3> translation{Table(0.0), Table(0.0), Table(0.0)};  ///< d(t) [m]
  Table angle{0.0};                                                      ///< θ(t) [rad]
  Point centre{};                                                        ///< c [m]
  Point axis{0, 0, 1};                                                   ///< of Q, any length
};

struct RigidSurface {
  enum class Shape { plane, cylinder, sphere } shape = Shape::plane;
  Point point{};             ///< on the plane, on the axis, the centre [m]
  Point direction{0, 1, 0};  ///< plane: outward normal; cylinder: axis; any length
  double radius = 0;         ///< [m]
  /// Cylinder, sphere: the rigid body is outside, its surface looks at the axis or centre (a bore).
  bool hollow = false;
  RigidMotion motion{};
  std::optional<Table> temperature{};  ///< of the tool [K] of time; absent: no heat passes into it
};

class AnalyticMaster : public Master {
 public:
  /// @param components of a displacement: two where the surface is seen in a plane
  /// @param search_distance a point farther outside has no partner [m]
  AnalyticMaster(int components, const RigidSurface& surface, double search_distance);
  void place(std::span<const double> displacement, double time) override;
  /// Partner::xi is Ȳ. A point on the axis or at the centre has none.
  Partner find(const Point& x, const Point& slave_normal, Index hint) const override;
  /// Deeper inside than the search distance.
  bool behind(const Partner& partner) const override { return partner.penetration > search_distance_; }
  Point way(const Partner& partner, double from, double to) const override;
  void frame(const Partner& partner, bool rates, MasterFrame& frame) const override;
  std::size_t max_nodes() const override { return 0; }
  bool reference_turns() const override { return surface_.shape != RigidSurface::Shape::plane; }
  std::span<const Index> nodes(Index) const override { return {}; }
  std::span<const Index> around(Index) const override { return {}; }

 private:
  /// Returns the position at a time of a particle of the reference configuration [m].
  Point place_at(const Point& own, double time) const;
  /// The curvature 1/R in the directions in which the surface is curved, applied to a tangent vector.
  Point curvature(const Point& radial, const Point& tangent) const;

  RigidSurface surface_;
  bool planar_;
  double search_distance_;
  Tensor turn_ = identity();  ///< Q
  Point shift_{};             ///< d
};

}  // namespace solidus::contact
