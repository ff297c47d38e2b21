/// The faces of a part's skin for the curved interpolation.
#pragma once

#include <vector>

#include "mesh/mesh.hpp"

namespace solidus::mesh {

/// Faces at nodes that this process owns which no other element of their body has; a face between two bodies
/// that share nodes comes once. The number of each is the same whatever the number of processes.
std::vector<ElementBlock> skin_faces(const Mesh& mesh);

}  // namespace solidus::mesh
