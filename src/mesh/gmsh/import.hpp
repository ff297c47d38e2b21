/// Reads a mesh file, or meshes a geometry, by the reader of its format, in this process.
#pragma once

#include "mesh/making/casting_geometry.hpp"
#include "mesh/raw_mesh.hpp"

namespace solidus::mesh {

/// Reads a mesh, or with `casting` makes one in the way that its `attempt` says. Throws InputError as
/// read_mesh() does.
RawMesh read_mesh_here(const MeshSource& source, const CastingGeometry* casting = nullptr);

}  // namespace solidus::mesh
