/// Requests to a reader and meshes from it, as bytes through a pipe (mesh/reader_process.hpp). Both ends are
/// the same program on the same machine.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <type_traits>
#include <vector>

#include "mesh/casting_geometry.hpp"
#include "mesh/raw_mesh.hpp"

namespace solidus::mesh {

/// Functions that send and receive bytes. Both throw if the connection ends too soon.
using PutBytes = std::function<void(const void* bytes, std::size_t n)>;
using TakeBytes = std::function<void(void* bytes, std::size_t n)>;

void put_source(const MeshSource& source, const PutBytes& put);
MeshSource take_source(const TakeBytes& take);

void put_casting(const CastingGeometry& casting, const PutBytes& put);
CastingGeometry take_casting(const TakeBytes& take);

void put_mesh(const RawMesh& mesh, const PutBytes& put);
/// Throws std::runtime_error for data that are no mesh: an unknown shape, a node that is not there, more than
/// `most_bytes`.
RawMesh take_mesh(const TakeBytes& take, double most_bytes);

void put_text(const std::string& text, const PutBytes& put);
std::string take_text(const TakeBytes& take, std::size_t longest = 1 << 20);

}  // namespace solidus::mesh
