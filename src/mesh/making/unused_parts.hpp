/// What of a mesh belongs to no body any more after a body was cut or left out. Rank 0 only, as reading a
/// mesh is.
#pragma once

#include <string>

#include "mesh/raw_mesh.hpp"

namespace solidus::mesh {

/// Leaves out elements of surfaces that no body has as a face, elements of lines and points with nodes of no
/// body, and nodes that are in no body. The others keep their order; those of drawn faces are numbered again.
void leave_out_unused(RawMesh& mesh);

/// Leaves out a group of full dimension, and what then belongs to no body.
void leave_out(RawMesh& mesh, const std::string& body);

}  // namespace solidus::mesh
