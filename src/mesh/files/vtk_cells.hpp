/// The cells of VTK that our shapes are.
#pragma once

#include <span>

#include "mesh/shape.hpp"

namespace solidus::mesh {

/// VTK's cell type of a shape.
int vtk_cell_type(Shape shape);
/// VTK's node i of a shape is Gmsh's node `vtk_node_order(shape)[i]`.
std::span<const int> vtk_node_order(Shape shape);

}  // namespace solidus::mesh
