/// Meshes in VTK XML files of unstructured grids (.vtu).
#pragma once

#include <string>

#include "mesh/raw_mesh.hpp"

namespace solidus::mesh {

/// Cells of the highest dimension are bodies and those of one dimension less surfaces. The whole numbers of
/// cell data tell them apart: `body`, else `gmsh:physical`, else `CellEntityIds`, else data whose name is one
/// that programs give to materials, groups or regions. The least number is body_1 (or surface_1), the next
/// body_2, …; without such data all is one body. The notes of the mesh name the data, and others with a few
/// whole numbers that might tell bodies apart. Nodes and elements are numbered as the file has them, from
/// one. Throws InputError for a file of several pieces, of damaged arrays or of cells that Solidus does not
/// have.
RawMesh read_vtu_mesh(const std::string& path, double unit_in_metres);

}  // namespace solidus::mesh
