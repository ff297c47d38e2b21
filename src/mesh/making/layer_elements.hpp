/// The elements between a face of a wall and its copy further inside.
#pragma once

#include <array>
#include <vector>

#include "mesh/making/wall_topology.hpp"
#include "mesh/shape.hpp"

namespace solidus::mesh {

/// A vertex of the wall and two vertices above it: the lower and the upper end of an element's edge. They
/// are the same where the column has no layers.
struct LayerColumn {
  Index wall, lower, upper;
};

/// Vertices of the elements of one layer above a face, each element a list, with a positive volume if the
/// face is outward of its body. Prisms on triangles are three tetrahedra, quadrilaterals on edges two
/// triangles; diagonals go by the numbers of the wall's vertices, so neighbours agree. Elements of columns
/// without layers vanish.
/// @param body  shape of the body's elements: simplices or not
std::vector<std::vector<Index>> layer_elements(Shape body, const std::vector<LayerColumn>& face);

/// The faces of a layer at the wall's rim: over one vertex of a plane mesh, else over an edge. Not oriented.
std::vector<std::vector<Index>> rim_faces(Shape body, const std::vector<LayerColumn>& rim);

bool is_simplex(Shape shape);

}  // namespace solidus::mesh
