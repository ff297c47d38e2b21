/// Meshes parts that are given by their skins, as triangles of an STL file or the skins of a mesh, and a
/// block of mould around them. In the reader's process; needs Gmsh.
#pragma once

#include <vector>

#include "mesh/files/stl_file.hpp"
#include "mesh/making/casting_geometry.hpp"
#include "mesh/raw_mesh.hpp"

namespace solidus::mesh {

/// One way, that of geometry.attempt. Cavities of the parts are cores where there is a mould.
/// @param parts  closed skins that neither touch nor cross, in units of the file
/// Throws InputError where the skins are not closed or Gmsh cannot mesh them, for a riser, for symmetry, and
/// for a wall of the mould of thickness zero: only solids of a CAD program can be cut.
RawMesh mesh_faceted_casting(const MeshSource& source, const CastingGeometry& geometry,
                             const std::vector<Facets>& parts);

/// The skins of the bodies of a mesh, in units of the source.
std::vector<Facets> facets_of(const RawMesh& mesh, double unit_in_metres);

}  // namespace solidus::mesh
