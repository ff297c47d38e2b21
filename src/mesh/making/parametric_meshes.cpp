/// Each built-in shape is a few grids that are joined at common faces, with names for its sides.
#include "mesh/making/parametric_meshes.hpp"

#include <cmath>
#include <stdexcept>

#include "mesh/making/grid.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mesh {

namespace {

GridAxis joined(GridAxis a, const GridAxis& b) {
  a.insert(a.end(), b.begin() + 1, b.end());
  return a;
}

std::string side_name(const Point& normal) {
  for (std::size_t d = 0; d < 3; ++d)
    if (std::abs(normal[d]) > 0.5) return std::string(1, "xyz"[d]) + (normal[d] < 0 ? "_min" : "_max");
  return {};
}

Grid box(const std::vector<double>& origin, const std::vector<double>& size,
         const std::vector<int>& divisions, Shape shape) {
  const auto dim = as_size(dimension(shape));
  if (size.size() != dim || divisions.size() != dim || origin.size() != dim)
    throw std::invalid_argument("sizes, divisions and origin need one entry for each of the " +
                                std::to_string(dim) + " directions of the element " +
                                std::string(name(shape)));
  Grid grid;
  grid.shape = shape;
  for (std::size_t d = 0; d < dim; ++d) {
    if (!(size[d] > 0) || divisions[d] < 1)
      throw std::invalid_argument("sizes and divisions must be positive");
    grid.axes.push_back(uniform_axis(origin[d], origin[d] + size[d], divisions[d]));
  }
  return grid;
}

}  // namespace

RawMesh make_block(const OneBlock& b, Shape shape) {
  Grid grid =
      box(b.origin.empty() ? std::vector<double>(b.size.size(), 0.0) : b.origin, b.size, b.divisions, shape);
  grid.body = b.body;
  grid.surface = [](const Point&, const Point& normal) { return side_name(normal); };
  RawMesh mesh;
  add_grid(mesh, grid);
  return mesh;
}

RawMesh make_two_blocks(const TwoBlocks& b, Shape shape) {
  RawMesh mesh;
  const std::string last = dimension(shape) == 2 ? "y" : "z";
  // The faces that meet carry the names of the contact; all others that of their body and direction.
  const auto add = [&](const std::string& body, std::vector<double> origin, const std::vector<double>& size,
                       const std::vector<int>& divisions, const std::string& contact_side,
                       const std::string& contact) {
    Grid grid = box(origin, size, divisions, shape);
    grid.body = body;
    grid.surface = [=](const Point&, const Point& normal) {
      const std::string side = side_name(normal);
      return side == contact_side ? contact : body + "_" + side;
    };
    add_grid(mesh, grid);
  };
  std::vector<double> origin(b.lower.size(), 0.0);
  // The upper block stands on the lower one, or above it by the gap.
  add("lower", origin, b.lower, b.lower_divisions, last + "_max", "lower_top");
  origin.back() = b.lower.back() + b.gap;
  add("upper", origin, b.upper, b.upper_divisions, last + "_min", "upper_bottom");
  return mesh;
}

RawMesh make_cylinder_in_mould(const CylinderInMould& c, Shape shape) {
  if (dimension(shape) != 2)
    throw std::invalid_argument("cylinder_in_mould is axisymmetric: triangles or quads");
  // All lengths are needed, and positive.
  for (const double length : {c.radius, c.height, c.mould_wall, c.mould_bottom, c.mould_height,
                              c.element_size, c.mould_element_size, c.interface_ratio})
    if (!(length > 0)) throw std::invalid_argument("lengths and the interface ratio must be positive");
  // The mould may end at the top of the casting or rise above it.
  const double rise = c.mould_height - c.mould_bottom - c.height;  // of the wall above the casting
  if (rise < -1e-9 * c.height)
    throw std::invalid_argument("the mould must be at least as high as its bottom and the casting");
  const bool rises = rise > 1e-9 * c.height;

  // Temperatures are steep at the interface: half the size there.
  const double fine = 0.5 * c.element_size;
  const GridAxis part_r = graded_axis(0, c.radius, c.element_size, fine);
  const GridAxis part_z = graded_axis(0, c.height, fine, c.element_size);

  RawMesh mesh;
  Grid part;
  part.axes = {part_r, part_z};
  part.shape = shape;
  part.body = "part";
  part.surface = [](const Point&, const Point& n) -> std::string {
    if (n[0] < -0.5) return "part_axis";
    return n[1] > 0.5 ? "part_top" : "part_surface";
  };
  add_grid(mesh, part);

  // The mould is one grid from the axis to the outside, from which the cavity is left out.
  Grid mould;
  mould.shape = shape;
  mould.body = "mould";
  // Along the casting, the mould has the casting's grid lines, or denser or coarser ones of the same grading.
  const double size = c.element_size / c.interface_ratio, fine_size = fine / c.interface_ratio;
  const bool matching = c.interface_ratio == 1;
  const GridAxis cavity_r = matching ? part_r : graded_axis(0, c.radius, size, fine_size);
  const GridAxis cavity_z = matching ? part_z : graded_axis(0, c.height, fine_size, size);
  const GridAxis wall = graded_axis(c.radius, c.radius + c.mould_wall, fine, c.mould_element_size);
  const GridAxis bottom = graded_axis(-c.mould_bottom, 0, c.mould_element_size, fine);
  mould.axes = {joined(cavity_r, wall), joined(bottom, cavity_z)};
  if (rises)
    mould.axes[1] =
        joined(mould.axes[1], graded_axis(c.height, c.height + rise, c.element_size, c.mould_element_size));
  const int cavity_columns = static_cast<int>(cavity_r.size()) - 1,
            bottom_rows = static_cast<int>(bottom.size()) - 1;
  mould.keep = [=](std::array<int, 3> cell) { return cell[0] >= cavity_columns || cell[1] < bottom_rows; };
  // Each side is told from its normal and place.
  mould.surface = [&c](const Point& x, const Point& n) -> std::string {
    if (n[0] > 0.5) return "mould_outside";
    if (n[1] < -0.5) return "mould_bottom";
    if (n[0] < -0.5 && x[1] < 0) return "mould_axis";
    if (n[1] > 0.5 && x[0] > c.radius) return "mould_top";
    return x[1] > c.height ? "mould_inside" : "mould_surface";
  };
  add_grid(mesh, mould);
  return mesh;
}

}  // namespace solidus::mesh
