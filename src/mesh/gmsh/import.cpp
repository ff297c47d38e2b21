/// What a file holds decides which reader it gets, and what the case may ask of it.
#include "mesh/gmsh/import.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <utility>

#include "mesh/files/body_partition.hpp"
#include "mesh/files/file_format.hpp"
#include "mesh/files/own_format.hpp"
#include "mesh/files/split_cells.hpp"
#include "mesh/gmsh/faceted_casting.hpp"
#include "mesh/gmsh/session.hpp"
#include "mesh/making/casting_geometry.hpp"
#include "mesh/med/read_med.hpp"
#include "mesh/raw_mesh.hpp"
#include "system/errors.hpp"

namespace solidus::mesh {

namespace {

/// Meshes what the skins of a file of triangles or of the bodies of a mesh enclose, and a mould around them.
RawMesh mesh_skins(const MeshSource& source, const FileFormat& format, const CastingGeometry& casting) {
  if (format.read_skin != nullptr)
    return mesh_faceted_casting(source, casting, format.read_skin(source.path));
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
RawMesh read_format(const MeshSource& source, const FileFormat& format, const CastingGeometry* casting) {
  if (format.by_library) return read_med_file(source.path, source.unit_in_metres);
  if (format.read != nullptr)
    if (std::optional<RawMesh> mesh = format.read(source.path, source.unit_in_metres))
      return std::move(*mesh);
  if (!format.by_gmsh)
    throw InputError({source.path}, "the file holds no mesh that is read", common_formats());
  return read_with_gmsh(source, format.holds, casting);
}

}  // namespace

RawMesh read_mesh_here(const MeshSource& source, const CastingGeometry* casting) {
  // What the file holds decides: shapes are meshed, scripts are run, skins need sizes, meshes are
  // read.
  const std::string& path = source.path;
  check_readable(path);
  const FileFormat& format = file_format(path);
  if (casting != nullptr && format.holds != FileHolds::shapes) return mesh_skins(source, format, *casting);
  if (format.holds == FileHolds::skin)
    throw InputError(
        {path},
        "an " + std::string(format.name) + " file holds a skin of triangles and no elements of a body",
        "[[mesh.size]] for each body: then what it encloses is meshed");
  check_choices(source, format);
  RawMesh mesh = read_format(source, format, casting);
  // Cells that the program does not compute are split into tetrahedra.
  split_cells(mesh, path);
  return mesh;
}

}  // namespace solidus::mesh
