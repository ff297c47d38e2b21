/// Unstructured grids in VTK's XML format (.vtu).
#include "mesh/files/file_format.hpp"
#include "mesh/files/vtu_mesh.hpp"

namespace solidus::mesh {

namespace {

bool begins(std::string_view head) {
  return head.find("<VTKFile") != std::string_view::npos;
}

std::optional<RawMesh> read(const std::string& path, double unit_in_metres) {
  return read_vtu_mesh(path, unit_in_metres);
}

}  // namespace

FileFormat format_vtu() {
  return {.name = "VTU",
          .place = 120,
          .endings = {".vtu"},
          .begins = &begins,
          .begins_with = "'<VTKFile'",
          .told = ".vtu",
          .read = &read};
}

}  // namespace solidus::mesh
