/// Groups of a geometry, chosen from the data of the reader on its volumes and surfaces.
#pragma once

#include <string>

#include "mesh/geometry_choice.hpp"

namespace solidus::mesh {

/// Makes the groups in the geometry that is open in Gmsh, before it is meshed. A file of a CAD program gets
/// further ones: every volume without a group by its label, or as body_1, body_2, …; every surface without
/// one as surface_N, N being its number. Throws InputError for a choice that finds nothing and for a volume
/// in two groups.
/// @param from_cad  the file has no groups of its own: STEP, BREP, IGES
void make_geometry_groups(const std::string& path, const GeometryChoice& choice, double unit_in_metres,
                          bool from_cad);

}  // namespace solidus::mesh
