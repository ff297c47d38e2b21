/// Shapes and faces that the element types and face labels of Abaqus and CalculiX denote.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "mesh/shape.hpp"

namespace solidus::mesh {

/// The shape of an element type in upper case, whatever its formulation ("C3D10M" is tet10); nothing where
/// there is none here.
std::optional<Shape> shape_of_abaqus_type(std::string_view type);

/// Position in the Abaqus element of each of our nodes: ours[a] = theirs[order[a]]. Empty where the orders
/// agree.
std::span<const int> abaqus_node_order(Shape shape);

/// The number of faces that have a label: of wedges and pyramids 5.
int n_abaqus_faces(Shape shape);

/// Our number of the face that Abaqus calls S1, S2, … (label 1, 2, …); nothing where there is no such face.
/// Faces of wedges and pyramids are those of face_of_split_cell() (mesh/files/split_cells.hpp).
std::optional<int> face_of_abaqus_label(Shape shape, int label);

}  // namespace solidus::mesh
