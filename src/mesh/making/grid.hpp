/// Structured grids of every element shape, with cells left out, from which the built-in shapes are made.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "mesh/raw_mesh.hpp"

namespace solidus::mesh {

/// Lines of a grid along one axis, rising [m].
using GridAxis = std::vector<double>;

/// n equal pieces from a to b.
GridAxis uniform_axis(double a, double b, int n);
/// From a to b, the first piece about `first`, the last about `last`, sizes in geometric progression.
GridAxis graded_axis(double a, double b, double first, double last);

struct Grid {
  std::vector<GridAxis> axes;  ///< two or three
  Shape shape = Shape::quad4;  ///< triangles and tetrahedra come from cutting the cells
  std::string body;            ///< the group that the elements join
  /// Cells that exist; empty: all.
  std::function<bool(std::array<int, 3> cell)> keep;
  /// The group of a boundary face, from its centre and outward normal; an empty name: none.
  std::function<std::string(const Point& centre, const Point& normal)> surface;
};

/// Adds the grid's elements, boundary faces and nodes. Nodes of different grids stay apart, also where they
/// coincide.
void add_grid(RawMesh& mesh, const Grid& grid);

}  // namespace solidus::mesh
