/// Where a mesh of a geometry has its worst element, and what in the geometry is to blame. Rank 0 only.
#pragma once

#include <string>

#include "mesh/raw_mesh.hpp"

namespace solidus::mesh {

/// Describes the worst linear tetrahedron of all bodies: "in 'mould' at (10, 0, 5) mm, where its faces meet
/// at 3 degrees", or "…, at an edge of 0.2 mm between elements of 5 mm"; empty where there are no tetrahedra.
std::string worst_tetrahedron_text(RawMesh mesh);

}  // namespace solidus::mesh
