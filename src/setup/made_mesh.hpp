/// The mesh of a case as process 0 has made it, before it is divided; as bytes it goes from one program to
/// another of the same build.
#pragma once

#include <vector>

#include "mesh/making/reader_message.hpp"
#include "mesh/raw_mesh.hpp"
#include "setup/interfaces.hpp"

namespace solidus::setup {

struct MadeMesh {
  mesh::RawMesh mesh;
  std::vector<FoundInterface> interfaces;  ///< whose contacts are still to be added to the case
  double seconds = 0;                      ///< that it took
};

void put_made_mesh(const MadeMesh& made, const mesh::PutBytes& put);
/// Throws mesh::MessageError for bytes that are no mesh.
/// @param most_bytes  that the mesh may take
MadeMesh take_made_mesh(const mesh::TakeBytes& take, double most_bytes);

}  // namespace solidus::setup
