/// Groups of a geometry that has none of its own (STEP, BREP, IGES), or more of them, chosen from the data of
/// the reader on its volumes and surfaces.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"

namespace solidus::mesh {

/// Volumes, or surfaces (of a plane geometry: surfaces, or lines), chosen in one of three ways.
struct GeometryGroup {
  std::string name;
  bool bodies = false;
  std::vector<int> numbers;                 ///< as the file counts them from one
  std::string label;                        ///< the file's own name of them, or its last part
  std::optional<std::array<Point, 2>> box;  ///< corners [m]: those that lie inside, with its boundary
};

struct GeometryChoice {
  std::vector<GeometryGroup> groups;
  /// Bodies that touch share the faces between them, and so the nodes; else each has its own, for contact.
  bool conforming = false;
};

/// Makes the groups in the geometry that is open in Gmsh, before it is meshed. A file of a CAD program gets
/// further ones: every volume without a group by its label, or as body_1, body_2, …; every surface without
/// one as surface_N, N being its number. Throws InputError for a choice that finds nothing and for a volume
/// in two groups.
/// @param from_cad  the file has no groups of its own: STEP, BREP, IGES
void make_geometry_groups(const std::string& path, const GeometryChoice& choice, double unit_in_metres,
                          bool from_cad);

}  // namespace solidus::mesh
