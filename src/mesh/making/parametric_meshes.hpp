/// The built-in parametric shapes. Rank 0 only, as reading a file is.
#pragma once

#include <string>
#include <vector>

#include "mesh/raw_mesh.hpp"

namespace solidus::mesh {

/// A cylinder cast in an open cylindrical mould (monograph 7.3), for axisymmetry: the axis is x = 0, the
/// casting's bottom y = 0. Part and mould have nodes of their own where they touch. Bodies "part", "mould";
/// surfaces "part_surface" (side and bottom), "mould_surface" (facing it), "part_top", "part_axis",
/// "mould_axis", "mould_top", "mould_bottom", "mould_outside", and "mould_inside" for a wall that rises above
/// the casting. All lengths [m].
struct CylinderInMould {
  double radius, height;                          ///< of the casting
  double mould_wall, mould_bottom, mould_height;  ///< height with the bottom; at least bottom and casting
  double element_size;                            ///< in the casting; finer towards the interface
  double mould_element_size;                      ///< far from the casting
  /// Elements of the mould per element of the part along the interface; other than one, the meshes do not
  /// match.
  double interface_ratio = 1;
};
/// Throws std::invalid_argument for lengths that do not fit together.
RawMesh make_cylinder_in_mould(const CylinderInMould& c, Shape shape);

/// A rectangle or box: body "block", sides "x_min", "x_max", "y_min", ….
struct OneBlock {
  std::vector<double> size, origin;  ///< [m], two or three; origin empty: zero
  std::vector<int> divisions;
  std::string body = "block";
};
RawMesh make_block(const OneBlock& b, Shape shape);

/// Two blocks facing each other along the last axis, for tests of contact: "lower" from 0 to its height and
/// "upper" above it, with divisions of their own, so the interface does not match. Surfaces "lower_top",
/// "upper_bottom", and the other sides as "lower_x_min", ….
struct TwoBlocks {
  std::vector<double> lower, upper;  ///< sizes [m]
  std::vector<int> lower_divisions, upper_divisions;
  double gap = 0;  ///< between them [m]
};
RawMesh make_two_blocks(const TwoBlocks& b, Shape shape);

}  // namespace solidus::mesh
