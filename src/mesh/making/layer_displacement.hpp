/// Computes how far and in which direction the vertices of a wall can move into their body, to make room for
/// layers.
#pragma once

#include <vector>

#include "mesh/making/wall_topology.hpp"

namespace solidus::mesh {

/// Displacements of the vertices of the body, [node] [m]; zero at those that stay.
///
/// Vertices of the wall go along the direction from which all their faces are seen best, so far that the mean
/// distance to the faces is the thickness of their surface; at the rim of the wall along the faces that they
/// meet there. The other vertices of the body follow (mesh/making/layer_spread.hpp). Where an element would
/// become too flat, or a layer would fold, the layers around it are thinner, down to none; along the wall
/// their thickness changes gently. The boundary's shape stays.
/// @param thickness  [surface of the wall] of all layers together [m]
/// @param levels     where the layers end, as shares of a displacement, rising to one
std::vector<Point> layer_displacement(const RawMesh& mesh, const RawGroup& body, const WallTopology& wall,
                                      const std::vector<double>& thickness,
                                      const std::vector<double>& levels);

}  // namespace solidus::mesh
