#include "mesh/gmsh/import.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <utility>

#include "mesh/files/abaqus_input.hpp"
#include "mesh/files/body_partition.hpp"
#include "mesh/files/file_format.hpp"
#include "mesh/files/gmsh_mesh_file.hpp"
#include "mesh/files/gmsh_script.hpp"
#include "mesh/files/nastran_input.hpp"
#include "mesh/files/split_cells.hpp"
#include "mesh/files/stl_file.hpp"
#include "mesh/files/universal_file.hpp"
#include "mesh/files/vtk_legacy.hpp"
#include "mesh/files/vtu_mesh.hpp"
#include "mesh/gmsh/faceted_casting.hpp"
#include "mesh/gmsh/session.hpp"
#include "mesh/making/casting_geometry.hpp"
#include "mesh/med/read_med.hpp"
#include "mesh/raw_mesh.hpp"
#include "system/errors.hpp"

namespace solidus::mesh {

namespace {

/// Meshes what the skins of an STL file or of the bodies of a mesh enclose, and a mould around them.
RawMesh mesh_skins(const MeshSource& source, FileFormat format, const CastingGeometry& casting) {
  if (format == FileFormat::stl) return mesh_faceted_casting(source, casting, read_stl(source.path));
  RawMesh mesh = read_mesh_here(source);
  if (mesh.dimension != 3)
    throw InputError({source.path}, "[[mesh.size]] and [mesh.mould] are for solids, this mesh is plane",
                     "a mesh of tetrahedra or hexahedra");
  // Of sets that hold the same elements those that the case names are the bodies.
  const BodyPartition partition = partition_of(mesh, source.path, [&](const std::string& name) {
    const bool named = std::ranges::any_of(casting.sizes, [&](const BodySize& s) { return s.body == name; });
    return named ? 2 : plain_preference(name);
  });
  for (const std::string& name : partition.left_out) mesh.groups.erase(name);
  return mesh_faceted_casting(source, casting, facets_of(mesh, source.unit_in_metres));
}

/// What the file holds, by the reader of its format; wedges and pyramids are whole.
RawMesh read_format(const MeshSource& source, FileFormat format, const CastingGeometry* casting) {
  const std::string& path = source.path;
  const double unit = source.unit_in_metres;
  if (format == FileFormat::abaqus) return read_abaqus_input(path, unit);
  if (format == FileFormat::nastran) return read_nastran(path, unit);
  if (format == FileFormat::universal) return read_universal_file(path, unit);
  if (format == FileFormat::vtu) return read_vtu_mesh(path, unit);
  if (format == FileFormat::med) return read_med_file(path, unit);
  if (format == FileFormat::vtk)
    if (std::optional<RawMesh> mesh = read_legacy_vtk(path, unit)) return std::move(*mesh);
  if (format == FileFormat::gmsh_mesh)
    if (std::optional<RawMesh> mesh = read_gmsh_mesh_file(path, unit)) return std::move(*mesh);
  return read_with_gmsh(source, format, casting);
}

}  // namespace

RawMesh read_mesh_here(const MeshSource& source, const CastingGeometry* casting) {
  const std::string& path = source.path;
  check_readable(path);
  // What the format cannot have is refused before the file is opened.
  const FileFormat format = file_format(path);
  if (casting != nullptr && !is_cad(format)) return mesh_skins(source, format, *casting);
  if (format == FileFormat::stl)
    throw InputError({path}, "an STL file holds a skin of triangles and no elements of a body",
                     "[[mesh.size]] for each body: then what it encloses is meshed");
  if (!source.geometry.groups.empty() && !is_geometry(format))
    throw InputError({path}, "the file holds a mesh, whose groups are its own",
                     "a STEP, BREP, IGES or .geo file");
  if (source.geometry.conforming && !is_cad(format))
    throw InputError({path}, "'conforming' is for geometries of CAD programs", "a STEP, BREP or IGES file");
  if (!source.trust_script) {
    refuse_options_file(path);
    if (format == FileFormat::gmsh_script) check_gmsh_script(path);
  }
  if (!source.constants.empty() && format != FileFormat::gmsh_script)
    throw InputError({path}, "the mesh file is no .geo script and has no constants");
  RawMesh mesh = read_format(source, format, casting);
  split_cells(mesh, path);
  return mesh;
}

}  // namespace solidus::mesh
