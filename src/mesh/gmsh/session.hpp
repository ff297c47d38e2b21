/// Reads files in Gmsh, and meshes geometries in it. A build without Gmsh (-DSOLIDUS_GMSH=OFF) has absent.cpp
/// in the place of what needs it.
#pragma once

#include <functional>
#include <string>

#include "mesh/files/file_format.hpp"
#include "mesh/making/casting_geometry.hpp"
#include "mesh/raw_mesh.hpp"

namespace solidus::mesh {

/// Reads a mesh of a format that Solidus does not read by itself, or meshes a geometry, in this process.
/// @param casting  makes mould and riser around the parts of a file of CAD; may be null
/// Throws InputError; without Gmsh always.
RawMesh read_with_gmsh(const MeshSource& source, FileHolds holds, const CastingGeometry* casting);

/// Opens an empty model in Gmsh, lets `make` fill and mesh it, and takes the mesh. Throws InputError, also
/// for what Gmsh complains of.
RawMesh mesh_in_gmsh(const MeshSource& source, const std::function<void()>& make);

}  // namespace solidus::mesh
