/// Meshes of Medit (.mesh), which Gmsh reads.
#include "mesh/files/file_format.hpp"
#include "mesh/files/format_signs.hpp"

namespace solidus::mesh {

namespace {

bool begins(std::string_view head) {
  return is_text(head) && head.find("MeshVersionFormatted") != std::string_view::npos;
}

}  // namespace

FileFormat format_medit() {
  return {.name = "Medit",
          .place = 100,
          .endings = {".mesh", ".MESH"},
          .begins = &begins,
          .begins_with = "'MeshVersionFormatted'",
          .by_gmsh = true};
}

}  // namespace solidus::mesh
