/// Re-entrant edges: where two flat parts of the boundary of a mesh meet so that the bodies fill more than
/// half a turn, as the sand does along the rims of a casting.
#pragma once

#include <utility>
#include <vector>

#include "mesh/mesh.hpp"

namespace solidus::mesh {

/// The wedge that bodies fill around an edge, seen from one of its nodes; in two dimensions around a corner.
struct Wedge {
  Point bisector{};  ///< half way between both faces, into the body; across the edge, of length one
  Point tangent{};   ///< along the edge, of length one, in either sense; the third axis in two dimensions
  double angle = 0;  ///< between both faces, through the body [rad]; 0: no wedge
};

/// Bodies that fill less than this are not said to have a re-entrant edge: facets of a smooth curved face
/// bend by up to 30 degrees [rad].
inline constexpr double k_reentrant_angle = 7.0 / 6 * 3.14159265358979323846;

/// The wedges of owned nodes, in rising order of the nodes. The boundary consists of the faces that only one
/// element of all bodies has: bodies that share nodes count as one, bodies in contact do not. A node where a
/// re-entrant edge ends has the wedge of that edge; one where two meet that bend by more than 45 degrees, or
/// more than two, has none.
std::vector<std::pair<Index, Wedge>> reentrant_wedges(const Mesh& mesh);

}  // namespace solidus::mesh
