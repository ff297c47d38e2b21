#include "mesh/files/own_format.hpp"

#include "mesh/files/gmsh_script.hpp"
#include "mesh/files/split_cells.hpp"
#include "system/errors.hpp"

namespace solidus::mesh {

namespace {

bool reads_itself(const FileFormat& format) {
  return format.read != nullptr && format.holds == FileHolds::mesh && !format.by_library;
}

}  // namespace

bool is_own_format(const std::string& path) {
  try {
    check_readable(path);
    return reads_itself(file_format(path));
  } catch (const InputError&) {
    return false;
  }
}

std::optional<RawMesh> read_own_format(const MeshSource& source) {
  const FileFormat& format = file_format(source.path);
  if (!reads_itself(format)) return {};
  check_choices(source, format);
  std::optional<RawMesh> mesh = format.read(source.path, source.unit_in_metres);
  // Cells that the program does not compute are split into tetrahedra.
  if (mesh) split_cells(*mesh, source.path);
  return mesh;
}

void check_choices(const MeshSource& source, const FileFormat& format) {
  const std::string& path = source.path;
  const bool shapes = format.holds == FileHolds::shapes, script = format.holds == FileHolds::script;
  // Choices that only a geometry has are refused for a mesh.
  if (!source.geometry.groups.empty() && !is_geometry(format.holds))
    throw InputError({path}, "the file holds a mesh, whose groups are its own",
                     "a STEP, BREP, IGES or .geo file");
  if (source.size_factor != 1 && !is_geometry(format.holds))
    throw InputError({path}, "the file holds a mesh, whose elements have their sizes ('mesh.size_factor')",
                     "a STEP, BREP, IGES or .geo file");
  if (source.geometry.conforming && !shapes)
    throw InputError({path}, "'conforming' is for geometries of CAD programs", "a STEP, BREP or IGES file");
  // Files that can do more than describe geometry are checked before Gmsh sees them.
  if (!source.trust_script) {
    refuse_options_file(path);
    if (script) check_gmsh_script(path);
  }
  if (!source.constants.empty() && !script)
    throw InputError({path}, "the mesh file is no .geo script and has no constants");
}

}  // namespace solidus::mesh
