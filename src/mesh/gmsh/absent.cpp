// Replaces, in a build without Gmsh, all that needs it.
#include <string>

#include "mesh/files/file_format.hpp"
#include "mesh/gmsh/faceted_casting.hpp"
#include "mesh/gmsh/session.hpp"

namespace solidus::mesh {

namespace {

/// The endings of what is read without Gmsh: ".msh, .inp, .vtu".
std::string meshes_without_gmsh() {
  std::string text;
  for (const FileFormat& format : file_formats())
    if (format.read != nullptr || format.by_library)
      text += (text.empty() ? "" : ", ") + std::string(format.endings.front());
  return text;
}

[[noreturn]] void refuse(const MeshSource& source) {
  throw UnusableGeometry({source.path},
                         "this file needs Gmsh, and this program was built without it (SOLIDUS_GMSH=OFF)",
                         "a mesh: " + meshes_without_gmsh() + "; or a build with Gmsh");
}

}  // namespace

RawMesh read_with_gmsh(const MeshSource& source, FileHolds, const CastingGeometry*) {
  refuse(source);
}

RawMesh mesh_faceted_casting(const MeshSource& source, const CastingGeometry&, const std::vector<Facets>&) {
  refuse(source);
}

std::vector<Facets> facets_of(const RawMesh&, double) {
  return {};
}

}  // namespace solidus::mesh
