/// Supports and loads of the mechanical phase, as functions of position and time.
///
/// Positions are those of the mesh, which deformation does not move. A step takes the values at its end.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "numbers/place_function.hpp"
#include "numbers/types.hpp"

namespace solidus::mechanics {

/// A displacement component of every node of a set follows u(t). Where two conditions meet, the later one in
/// the list holds.
struct PrescribedDisplacement {
  std::string node_set;  ///< a key of Mesh::node_sets
  int component = 0;     ///< 0, 1, 2: x, y, z (axisymmetric: r, axial)
  PlaceFunction value;   ///< [m] over position [m] and time [s]
  /// Counted from where each node was when the condition began (`start` of Loads).
  bool relative = false;
};

/// A pressure on a surface, positive towards the body.
struct Pressure {
  std::string surface;  ///< a key of Mesh::surfaces
  PlaceFunction value;  ///< [Pa] over position [m] and time [s]
};

/// Force per area on a surface, in the directions of the coordinates.
struct Traction {
  std::string surface;                 ///< a key of Mesh::surfaces
  std::array<PlaceFunction, 3> value;  ///< [Pa] over position [m] and time [s]
};

/// Force per volume on a body besides its weight, in the directions of the coordinates.
struct BodyForce {
  std::string body;                    ///< name of a body of the mesh
  std::array<PlaceFunction, 3> value;  ///< [N/m³] over position [m] and time [s]
  bool per_mass = false;               ///< the values are accelerations [m/s²], times the body's density
};

/// Bodies that turn about an axis: how fast at most, by which the head of a melt is estimated. The force
/// itself is a BodyForce.
struct Turning {
  double omega = 0;                       ///< [rad/s]; zero: nothing turns
  std::array<double, 3> axis{}, point{};  ///< of length one; [m]
  /// The square of the distance of a place from the axis [m²].
  double squared_radius(const std::array<double, 3>& x) const {
    double along = 0, all = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double d = x[i] - point[i];
      along += d * axis[i];
      all += d * d;
    }
    return all - along * along;
  }
};

/// A face normal to a coordinate that stays plane and parallel to itself: its nodes have one normal
/// displacement, which equilibrium finds. Its net force is that of the loads on the same face, zero without
/// any: the cut through a long part that is free to shrink (generalised plane strain), or through a plate
/// that cannot bend. In an axisymmetric mesh it may be a cylinder.
struct PlaneFace {
  std::string node_set;  ///< a key of Mesh::node_sets
};

/// On the axis of an axisymmetric mesh (r = 0) the radial displacement is zero by itself.
struct MechanicalConditions {
  std::vector<PrescribedDisplacement> displacements;
  std::vector<Pressure> pressures;
  std::vector<Traction> tractions;
  std::vector<BodyForce> body_forces;
  std::vector<PlaneFace> plane_faces;
  Turning turning;
  std::array<double, 3> gravity{};  ///< acceleration [m/s²], times each body's density
  /// Names of the inactive bodies: those that only conduct heat, and those that have been removed. Their
  /// elements carry nothing, nodes of theirs alone stay where they are, and conditions hold only where
  /// another body is.
  std::vector<std::string> absent_bodies;
};

}  // namespace solidus::mechanics
