/// Reads the triangles of an STL file, in text or binary form. Own code: Gmsh ends the process on some
/// damaged files.
///
/// Format: 3D Systems, "StereoLithography Interface Specification" (1988); a binary file is 80 bytes of
/// title, the number of triangles as four bytes, and 50 bytes a triangle, all little-endian.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"

namespace solidus::mesh {

/// A skin of flat triangles, in no order.
struct Facets {
  std::string name;                             ///< of the solid in the file; may be empty
  std::vector<std::array<Point, 3>> triangles;  ///< corners, in units of the file
};

/// The solids of a file, in their order; a binary one holds one, without a name. Triangles without area stay.
/// Throws InputError with the line (or the number of bytes) for a file that is cut off or damaged.
std::vector<Facets> read_stl(const std::string& path);

}  // namespace solidus::mesh
