#include "mesh/vtk_cells.hpp"

#include <array>
#include <stdexcept>

namespace solidus::mesh {

int vtk_cell_type(Shape shape) {
  switch (shape) {
    case Shape::point1:
      return 1;
    case Shape::line2:
      return 3;
    case Shape::tri3:
      return 5;
    case Shape::quad4:
      return 9;
    case Shape::tet4:
      return 10;
    case Shape::hex8:
      return 12;
    case Shape::line3:
      return 21;
    case Shape::tri6:
      return 22;
    case Shape::quad8:
      return 23;
    case Shape::tet10:
      return 24;
    case Shape::hex20:
      return 25;
  }
  throw std::invalid_argument("shape without a VTK type");
}

std::span<const int> vtk_node_order(Shape shape) {
  static constexpr std::array<int, 8> k_same = {0, 1, 2, 3, 4, 5, 6, 7};
  // Gmsh numbers the edges (2,3), (1,3) of a tetrahedron 8, 9; VTK the other way round.
  static constexpr std::array<int, 10> k_tet10 = {0, 1, 2, 3, 4, 5, 6, 7, 9, 8};
  // VTK goes round the bottom, round the top, then up; Gmsh takes the edges in the order of their nodes.
  static constexpr std::array<int, 20> k_hex20 = {0,  1, 2,  3,  4,  5,  6,  7,  8,  11,
                                                  13, 9, 16, 18, 19, 17, 10, 12, 14, 15};
  if (shape == Shape::tet10) return k_tet10;
  if (shape == Shape::hex20) return k_hex20;
  return std::span<const int>(k_same).first(static_cast<std::size_t>(node_count(shape)));
}

}  // namespace solidus::mesh
