// Which reader reads a mesh file.
#include <filesystem>
#include <fstream>
#include <optional>
#include <utility>

#include "base/errors.hpp"
#include "mesh/abaqus_input.hpp"
#include "mesh/casting_geometry.hpp"
#include "mesh/file_format.hpp"
#include "mesh/gmsh_mesh_file.hpp"
#include "mesh/gmsh_reader.hpp"
#include "mesh/gmsh_script.hpp"
#include "mesh/raw_mesh.hpp"
#include "mesh/reader_process.hpp"
#include "mesh/vtu_mesh.hpp"

namespace solidus::mesh {

namespace {

void check_readable(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) throw InputError({path}, "the mesh file does not exist");
  if (!std::filesystem::is_regular_file(path, error)) throw InputError({path}, "the mesh is not a file");
  if (std::filesystem::file_size(path, error) == 0) throw InputError({path}, "the mesh file is empty");
  if (!std::ifstream(path)) throw InputError({path}, "the mesh file cannot be read");
}

}  // namespace

RawMesh read_mesh_here(const MeshSource& source, const CastingGeometry* casting) {
  const std::string& path = source.path;
  check_readable(path);
  const FileFormat format = file_format(path);
  if (casting != nullptr && !is_cad(format))
    throw InputError({path}, "[[mesh.size]], [mesh.mould], [mesh.riser] and [mesh.symmetry] are for solids",
                     "a STEP, BREP or IGES file");
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
  if (format == FileFormat::abaqus) return read_abaqus_input(path, source.unit_in_metres);
  if (format == FileFormat::vtu) return read_vtu_mesh(path, source.unit_in_metres);
  if (format == FileFormat::gmsh_mesh)
    if (std::optional<RawMesh> mesh = read_gmsh_mesh_file(path, source.unit_in_metres))
      return std::move(*mesh);
  return read_with_gmsh(source, format, casting);
}

RawMesh read_mesh(const std::string& path, double unit_in_metres, double element_size, int element_order,
                  const std::map<std::string, double>& constants, const GeometryChoice& geometry) {
  return read_mesh(MeshSource{path, unit_in_metres, element_size, element_order, constants, geometry});
}

}  // namespace solidus::mesh
