// Stands in a build without Gmsh for all that needs it.
#include "mesh/gmsh/faceted_casting.hpp"
#include "mesh/gmsh/session.hpp"

namespace solidus::mesh {

namespace {

[[noreturn]] void refuse(const MeshSource& source) {
  throw UnusableGeometry(
      {source.path}, "this file needs Gmsh, and this program was built without it (SOLIDUS_GMSH=OFF)",
      "a mesh: .msh (version 2.2 or 4.1), Abaqus .inp, .bdf, .unv, .med, .vtk or .vtu; or a build with Gmsh");
}

}  // namespace

RawMesh read_with_gmsh(const MeshSource& source, FileFormat, const CastingGeometry*) {
  refuse(source);
}

RawMesh mesh_faceted_casting(const MeshSource& source, const CastingGeometry&, const std::vector<Facets>&) {
  refuse(source);
}

std::vector<Facets> facets_of(const RawMesh&, double) {
  return {};
}

}  // namespace solidus::mesh
