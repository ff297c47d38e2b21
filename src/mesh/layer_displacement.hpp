/// Computes how far and in which direction the vertices of a wall can move into their body, to make room for
/// layers.
#pragma once

#include <vector>

#include "mesh/wall_topology.hpp"

namespace solidus::mesh {

/// Displacements of the vertices of the body, [node] [m]; zero at those that stay.
///
/// Vertices of the wall go along the direction from which all their faces are seen best, so far that the mean
/// distance to the faces is `thickness`; at the rim of the wall along the faces that they meet there. Inner
/// vertices follow as the mean of their neighbours do. Where an element would become too flat, or a layer
/// would fold, all of its vertices move less, down to none. The boundary's shape stays.
/// @param levels  where the layers end, as shares of a displacement, rising to one
std::vector<Point> layer_displacement(const RawMesh& mesh, const RawGroup& body, const WallTopology& wall,
                                      double thickness, const std::vector<double>& levels);

}  // namespace solidus::mesh
