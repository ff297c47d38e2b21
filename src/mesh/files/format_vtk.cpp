/// The legacy format of VTK (.vtk); what our own reader does not know is read by Gmsh.
#include "mesh/files/file_format.hpp"
#include "mesh/files/vtk_legacy.hpp"

namespace solidus::mesh {

namespace {

bool begins(std::string_view head) {
  return head.starts_with("# vtk DataFile");
}

}  // namespace

FileFormat format_vtk() {
  return {.name = "VTK",
          .place = 110,
          .endings = {".vtk", ".VTK"},
          .begins = &begins,
          .begins_with = "'# vtk DataFile'",
          .read = &read_legacy_vtk,
          .by_gmsh = true};
}

}  // namespace solidus::mesh
