// Stands in a build without Gmsh for all that needs it.
#include "mesh/casting_geometry.hpp"
#include "mesh/faceted_casting.hpp"
#include "mesh/gmsh_reader.hpp"
#include "system/errors.hpp"

namespace solidus::mesh {

void require_gmsh(const std::string& path) {
  throw InputError({path}, "this file needs Gmsh, and this program was built without it (SOLIDUS_GMSH=OFF)",
                   "a mesh: .msh (version 2.2 or 4.1), Abaqus .inp or .vtu; or a build with Gmsh");
}

RawMesh read_with_gmsh(const MeshSource& source, FileFormat, const CastingGeometry*) {
  require_gmsh(source.path);
  return {};
}

RawMesh mesh_faceted_casting(const MeshSource& source, const CastingGeometry&, const std::vector<Facets>&) {
  require_gmsh(source.path);
  return {};
}

std::vector<Facets> facets_of(const RawMesh&, double) {
  return {};
}

std::string gmsh_version() {
  return "not in this build";
}

int n_meshing_attempts() {
  return 0;
}

int n_cheap_meshing_attempts() {
  return 0;
}

std::string meshing_attempt(int) {
  return "without Gmsh";
}

int n_faceted_attempts() {
  return 0;
}

std::string faceted_attempt(int) {
  return "without Gmsh";
}

}  // namespace solidus::mesh
