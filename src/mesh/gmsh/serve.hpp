/// The work of the reader: a request from the pipe, an answer into it (mesh/making/reader_process.hpp).
#pragma once

namespace solidus::mesh {

/// Takes the request from k_request_descriptor, restricts this process for good (system/sandbox.hpp), reads
/// or meshes, and puts the mesh or the reason why there is none into k_answer_descriptor. Throws
/// std::runtime_error where the other end of a pipe has gone.
void serve_request();

}  // namespace solidus::mesh
