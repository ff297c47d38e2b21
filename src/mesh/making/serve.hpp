/// The work of the reader: a request from the pipe, an answer into it (mesh/making/reader_process.hpp).
#pragma once

#include <optional>

#include "mesh/making/casting_geometry.hpp"
#include "mesh/raw_mesh.hpp"

namespace solidus::mesh {

/// Reads a mesh, or with `casting` makes one in the way that its `attempt` says; nothing where another reader
/// has to. Throws InputError.
using ReadRequest = std::optional<RawMesh>(const MeshSource& source, const CastingGeometry* casting);

/// Takes the request from k_request_descriptor, restricts this process for good (system/sandbox.hpp), reads
/// or meshes, and puts the mesh or the reason why there is none into k_answer_descriptor. Throws
/// std::runtime_error where the other end of a pipe has gone.
/// @param held  bytes that the process had before it got the request: a limit of memory comes on top of them
void serve_request(ReadRequest* read, double held = 0);

}  // namespace solidus::mesh
