/// Meshes of Gmsh (.msh); versions that our own reader does not know are read by Gmsh.
#include "mesh/files/file_format.hpp"
#include "mesh/files/gmsh_mesh_file.hpp"

namespace solidus::mesh {

namespace {

/// The first lines by which Gmsh itself knows a mesh (GModel::readMSH); anything else it would run.
bool begins(std::string_view head) {
  return head.starts_with("$MeshFormat") || head.starts_with("$NOD") || head.starts_with("$Comments");
}

}  // namespace

FileFormat format_gmsh_mesh() {
  return {.name = "Gmsh mesh",
          .place = 10,
          .endings = {".msh"},
          .begins = &begins,
          .begins_with = "'$MeshFormat'",
          .told = ".msh 2.2 or 4.1",
          .read = &read_gmsh_mesh_file,
          .by_gmsh = true};
}

}  // namespace solidus::mesh
