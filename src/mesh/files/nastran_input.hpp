/// Meshes in bulk data files of Nastran (.bdf, .nas).
#pragma once

#include <string>

#include "mesh/raw_mesh.hpp"

namespace solidus::mesh {

/// Reads GRID and GRDSET in the coordinate systems CORD1R, CORD1C, CORD1S, CORD2R, CORD2C, CORD2S, and
/// tetrahedra, hexahedra, triangles and quadrilaterals of first and second order. Elements of one property
/// are one group: body_7 or surface_7, or the name that a comment of ANSA, HyperMesh or Femap gives to it.
/// Entries of materials, properties, loads and solutions say nothing of a mesh; others are named in the
/// notes of the mesh. Throws InputError with file and line.
RawMesh read_nastran(const std::string& path, double unit_in_metres);

}  // namespace solidus::mesh
