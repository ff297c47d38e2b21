/// Meshes in Gmsh's own format (.msh), versions 2.x and 4.1, text or binary, read without Gmsh.
#pragma once

#include <optional>
#include <string>

#include "mesh/raw_mesh.hpp"

namespace solidus::mesh {

/// Nodes in the order of their numbers; physical groups by name, those without one as group_2d_7 (dimension
/// and number); elements of full dimension without a group as body_1, body_2, … by their entity. Sections
/// that hold no mesh are skipped.
/// @return nothing for what only Gmsh reads: other versions, parametric nodes of version 2, partitions
/// Throws InputError with file and line (or byte, of a binary file) where the file is damaged or cut off, and
/// for elements of shapes that Solidus does not have.
std::optional<RawMesh> read_gmsh_mesh_file(const std::string& path, double unit_in_metres);

}  // namespace solidus::mesh
