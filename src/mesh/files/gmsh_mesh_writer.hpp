/// A mesh as text of Gmsh's format MSH 2.2, with the names of its groups.
#pragma once

#include <set>
#include <string>

#include "mesh/raw_mesh.hpp"

namespace solidus::mesh {

/// Nodes are numbered from one in their order, coordinates are in metres with all their digits. An element
/// is there once for each group that has it. Groups in `left_out` are not written.
/// Throws InputError for a name with a quotation mark, which the format cannot hold.
std::string gmsh_mesh_text(const RawMesh& mesh, const std::set<std::string>& left_out = {});

}  // namespace solidus::mesh
