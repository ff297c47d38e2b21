/// The orders of nodes that differ between VTK and this program.
#include "mesh/files/vtk_cells.hpp"

#include <array>

#include "mesh/shape_table.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mesh {

int vtk_cell_type(Shape shape) {
  return row_of(shape).vtk;
}

std::span<const int> vtk_node_order(Shape shape) {
  static constexpr std::array<int, 8> k_same = {0, 1, 2, 3, 4, 5, 6, 7};
  const ShapeRow& row = row_of(shape);
  return row.vtk_nodes.empty() ? std::span(k_same).first(as_size(row.nodes)) : row.vtk_nodes;
}

}  // namespace solidus::mesh
