/// Scripts of Gmsh (.geo): programs that make a geometry.
#include "mesh/files/file_format.hpp"
#include "mesh/files/format_signs.hpp"

namespace solidus::mesh {

namespace {

bool begins(std::string_view head) {
  return is_text(head) && !head.starts_with('$');
}

}  // namespace

FileFormat format_gmsh_script() {
  return {.name = "Gmsh script",
          .place = 20,
          .endings = {".geo"},
          .begins = &begins,
          .begins_with = "text",
          .told = ".geo",
          .holds = FileHolds::script,
          .by_gmsh = true};
}

}  // namespace solidus::mesh
