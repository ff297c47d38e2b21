/// Closed skins of triangles: which triangles make one, what lies inside of which, and what is wrong with one
/// that is not closed. Without Gmsh.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "mesh/files/stl_file.hpp"

namespace solidus::mesh {

struct Shell {
  std::string name;                             ///< of the facets that it comes from
  std::vector<std::array<Index, 3>> triangles;  ///< numbers of points, outward of what it encloses
  int depth = 0;                                ///< number of shells around it: odd ones bound cavities
  int around = -1;                              ///< the innermost of these; −1: none
  bool looked_inward = false;                   ///< in the file, as the skins of cavities do
};

struct ClosedShells {
  std::vector<Point> points;  ///< corners, each once
  std::vector<Shell> shells;  ///< no two share a point
};

/// Corners that lie within 1e-6 of the extent are one; triangles whose corners are not three fall away.
/// Throws UnusableGeometry with the number of faults and the place of the first where an edge has one
/// triangle, or more than two, and where a skin has but one side.
/// @param path  for the message
ClosedShells closed_shells(const std::vector<Facets>& parts, const std::string& path);

/// Turns the triangles of shells, of which no two cross each other, so that they look outward, and finds what
/// lies inside of what.
void nest_shells(ClosedShells& all);

/// The triangles of a shell by their corners.
std::vector<std::array<Point, 3>> corners_of(const ClosedShells& all, const Shell& shell);

/// The volume that a shell encloses; positive where its triangles look outward.
double enclosed_volume(const ClosedShells& all, const Shell& shell);

/// The winding number of a closed skin about a point: 1 inside where its triangles look outward, 0 outside.
/// Van Oosterom and Strackee 1983, "The solid angle of a plane triangle", IEEE Trans. Biomed. Eng. 30,
/// 125-126.
double winding_number(const ClosedShells& all, const Shell& shell, const Point& point);

}  // namespace solidus::mesh
