/// The reference shapes: node counts, dimensions, basis functions. The order of nodes is Gmsh's.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "numbers/types.hpp"

namespace solidus::mesh {

/// Wedges and pyramids are cells of files alone: mesh/files/split_cells.hpp makes tetrahedra of them before a
/// mesh is used, and what follows here of bases, faces and quadrature is of the other shapes.
enum class Shape {
  point1,
  line2,
  line3,
  tri3,
  tri6,
  quad4,
  quad8,
  tet4,
  tet10,
  hex8,
  hex20,
  wedge6,
  pyramid5
};

int node_count(Shape shape);
int vertex_count(Shape shape);
int dimension(Shape shape);          ///< of the reference shape: 0 to 3
int order(Shape shape);              ///< polynomial order: 1 or 2
std::string_view name(Shape shape);  ///< "tri3", ...
/// Number of faces (edges of a 2-D shape) and their local nodes, outward when seen with Gmsh's orientation.
int face_count(Shape shape);
Shape face_shape(Shape shape);
std::span<const int> face_nodes(Shape shape, int face);

using Point = std::array<double, 3>;

/// Basis functions N_a(ξ), a = 0 … node_count − 1, at a reference point (Gmsh's reference coordinates:
/// simplices in [0, 1], quads and hexes in [−1, 1]).
void basis_values(Shape shape, const Point& xi, std::span<double> values);
/// ∂N_a/∂ξ_i stored as gradients[a * dimension + i].
void basis_gradients(Shape shape, const Point& xi, std::span<double> gradients);

}  // namespace solidus::mesh
