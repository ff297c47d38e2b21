/// Which facets of a mesh are of one smooth face of the geometry that it was made of.
#pragma once

#include <cstddef>
#include <unordered_map>
#include <vector>

#include "mesh/raw_mesh.hpp"

namespace solidus::mesh {

/// The facets of each smooth face of the geometry that Gmsh has meshed: of faces that continue one another
/// across a common edge with a bend of less than an angle, seen from a solid that both bound. A bore is one
/// face, however few facets it has and in however many parts a CAD program has written it.
/// @param index  of the nodes in the mesh, by the numbers that Gmsh gave them
/// @param angle  [rad]
/// @param unit   length of one unit of the geometry [m]
std::vector<DrawnFace> drawn_faces(const std::unordered_map<std::size_t, Index>& index, double angle,
                                   double unit);

}  // namespace solidus::mesh
