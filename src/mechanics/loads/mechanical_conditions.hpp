/// Supports and loads of the mechanical phase, as tables of time.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "numbers/time_function.hpp"
#include "numbers/types.hpp"

namespace solidus::mechanics {

/// A displacement component of every node of a set follows u(t). Where two conditions meet, the later one in
/// the list holds.
struct PrescribedDisplacement {
  std::string node_set;  ///< a key of Mesh::node_sets
  int component = 0;     ///< 0, 1, 2: x, y, z (axisymmetric: r, axial)
  TimeFunction value;    ///< [m] over time [s]
  /// Counted from where each node was when the condition began (`start` of Loads).
  bool relative = false;
};

/// A pressure on a surface, positive towards the body.
struct Pressure {
  std::string surface;  ///< a key of Mesh::surfaces
  TimeFunction value;   ///< [Pa] over time [s]
};

/// Force per area on a surface, in the directions of the coordinates.
struct Traction {
  std::string surface;                ///< a key of Mesh::surfaces
  std::array<TimeFunction, 3> value;  ///< [Pa] over time [s]
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
  std::vector<PlaneFace> plane_faces;
  std::array<double, 3> gravity{};  ///< acceleration [m/s²], times each body's density
  /// Names of the inactive bodies: those that only conduct heat, and those that have been removed. Their
  /// elements carry nothing, nodes of theirs alone stay where they are, and conditions hold only where
  /// another body is.
  std::vector<std::string> absent_bodies;
};

}  // namespace solidus::mechanics
