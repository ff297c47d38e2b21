// Lets the program it is linked with read meshes in its own process.
#include "mesh/gmsh/import.hpp"
#include "mesh/making/reader_process.hpp"

namespace {

[[maybe_unused]] const bool reads_here = [] {
  solidus::mesh::read_in_this_process(&solidus::mesh::read_mesh_here);
  return true;
}();

}  // namespace
