/// Meshes of Medit (.mesh).
#include "mesh/files/file_format.hpp"
#include "mesh/files/format_signs.hpp"
#include "mesh/files/medit_file.hpp"

namespace solidus::mesh {

namespace {

bool begins(std::string_view head) {
  return is_text(head) && head.find("MeshVersionFormatted") != std::string_view::npos;
}

std::optional<RawMesh> read(const std::string& path, double unit_in_metres) {
  return read_medit_file(path, unit_in_metres);
}

}  // namespace

FileFormat format_medit() {
  return {.name = "Medit",
          .place = 100,
          .endings = {".mesh", ".MESH"},
          .begins = &begins,
          .begins_with = "'MeshVersionFormatted'",
          .read = &read};
}

}  // namespace solidus::mesh
