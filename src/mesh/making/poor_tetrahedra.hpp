/// Poor tetrahedra taken out of a mesh by changing it around them. Rank 0 only.
#pragma once

#include "mesh/raw_mesh.hpp"

namespace solidus::mesh {

/// Around each poor linear tetrahedron the best of these is done, where the worst element gets better by it:
/// an edge is taken out (mesh/making/edge_removal.hpp), an edge is drawn together to one end
/// (mesh/making/edge_collapse.hpp), a node is moved (mesh/making/surface_node.hpp: inside a body, within a
/// surface or along a curve of it). Elements that are poor because edges or faces of the drawing are tiny, or
/// because surfaces meet at a small angle, go with these edges and angles.
/// @param below  elements of less quality (mean ratio) are poor
/// @return  the least quality of all linear tetrahedra afterwards; 1 where there are none
double repair_poor_tetrahedra(RawMesh& mesh, double below);

}  // namespace solidus::mesh
