/// The reader of meshes, `solidus-reader`: the program starts it, nothing else uses it
/// (mesh/making/reader_process.hpp).
#include <unistd.h>

#include <cstdio>
#include <exception>
#include <optional>

#include "app/built_version.hpp"
#include "mesh/gmsh/import.hpp"
#include "mesh/making/serve.hpp"
#include "system/version.hpp"

int main() {
  int code = 3;
  try {
    solidus::set_program_version(solidus::app::built_version());
    solidus::mesh::serve_request(
        [](const solidus::mesh::MeshSource& source, const solidus::mesh::CastingGeometry* casting) {
          return std::optional<solidus::mesh::RawMesh>(solidus::mesh::read_mesh_here(source, casting));
        });
    code = 0;
  } catch (const std::exception&) {
    std::fputs("solidus-reader: it reads meshes for the program solidus, which starts it\n", stderr);
  }
  _exit(code);  // what libraries do at the end of a process must not spoil an answer that is given
}
