/// Makes and meshes the bodies of a casting in its mould from solids of a CAD program.
#pragma once

#include "mesh/making/casting_geometry.hpp"

namespace solidus::mesh {

/// Makes mould, riser and groups in the file that Gmsh has open, and meshes them in the way of
/// `geometry.attempt` (meshing_ways.hpp). Throws InputError.
void make_casting_mesh(const MeshSource& source, const CastingGeometry& geometry);

}  // namespace solidus::mesh
