/// Meshes of Medit in text (.mesh), which Gmsh, Mmg, Tetgen, FreeFEM and meshio write.
#pragma once

#include <string>

#include "mesh/raw_mesh.hpp"

namespace solidus::mesh {

/// Reads vertices and elements of first order, and triangles, tetrahedra and edges of second order
/// ("TetrahedraP2"). Elements of the highest dimension with the number N are the body body_N, those of one
/// dimension less the surface surface_N. Sections that may say something of the mesh and are not read are
/// named in the notes.
/// Throws InputError with file and line, also for a line with more or fewer numbers than its section has:
/// Gmsh writes second order under the keywords of first order, and its own reader then takes a node for the
/// number of the body.
RawMesh read_medit_file(const std::string& path, double unit_in_metres);

}  // namespace solidus::mesh
