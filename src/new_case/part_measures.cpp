/// Extent, volume, area, walls and largest spheres of each part, from the mesh of its file or of its skin.
#include "new_case/part_measures.hpp"

#include <algorithm>
#include <cmath>

#include "cases/roles.hpp"
#include "input/keys.hpp"
#include "mesh/files/file_format.hpp"
#include "mesh/files/file_unit.hpp"
#include "mesh/making/casting_geometry.hpp"
#include "mesh/making/kept_mesh.hpp"

namespace solidus::new_case {

namespace {

/// Riser and symmetry cut solids, and triangles cannot be cut.
void refuse_cuts(const NewCaseOptions& options, bool solids) {
  const char* allowed = "a STEP, BREP or IGES file";
  if (!solids && (options.riser || !options.feeders.empty()))
    throw InputError({"--riser"}, "a riser can be joined to solids of a CAD program only", allowed);
  if (!solids && !options.symmetry.empty())
    throw InputError({"--symmetry"}, "only solids of a CAD program can be cut", allowed);
}

}  // namespace

bool PartMeasures::has_riser() const {
  return std::ranges::any_of(bodies,
                             [](const setup::GeometryBody& b) { return b.role == cases::Role::riser; });
}

PartMeasures measure_part(const NewCaseOptions& options) {
  // The part is read as it is, or its skin is meshed without sizes of ours, so that it can be measured:
  // bodies with their roles, extent, volume, area, thickness of walls and the largest spheres within.
  PartMeasures m;
  const std::string path = options.geometry.string();
  mesh::check_readable(path);
  // A unit of the user goes before that of the file.
  mesh::MeshSource source{path, mesh::metres_of_unit(path, options.unit, "mm", {"--unit"})};
  m.file_unit = mesh::unit_of_file(path);
  // Solids are meshed coarsely, meshes are taken as they are, and skins are filled.
  const mesh::FileHolds holds = mesh::file_format(source.path).holds;
  const bool solids = holds == mesh::FileHolds::shapes, meshed = !solids && holds != mesh::FileHolds::skin;
  refuse_cuts(options, solids);
  mesh::KeptMesh kept;
  m.mesh = meshed ? mesh::read_mesh(source) : mesh::mesh_casting(source, {}, 0);
  m.time_of_direct_ways = kept.search().time_of_direct_ways;
  if (m.mesh.dimension != 3)
    throw InputError({source.path}, "the mesh is plane", "a solid: STEP, BREP, IGES, STL, or a mesh of one");
  m.bodies = setup::bodies_of(m.mesh, options.as, source.path);
  // What is poured is metal; a mould in the file makes it a whole mesh.
  for (const setup::GeometryBody& body : m.bodies) {
    if (body.role == cases::Role::mould || body.role == cases::Role::die) m.has_mould = true;
    if (cases::is_poured(body.role)) m.metal.push_back(body.name);
  }
  // Elements of the file are kept only where a mould comes with them; else the mould is made around the part.
  m.meshed = meshed && m.has_mould;
  for (std::size_t i = 0; i < 3; ++i) {
    m.low[i] = 1e300, m.high[i] = -1e300;
    for (const setup::GeometryBody& body : m.bodies)
      m.low[i] = std::min(m.low[i], body.extent.low[i]), m.high[i] = std::max(m.high[i], body.extent.high[i]);
  }
  // Walls are measured for what is poured, as it alone decides sizes and times.
  for (const setup::GeometryBody& body : m.bodies)
    if (cases::is_poured(body.role)) {
      m.volume += body.extent.volume;
      m.area += body.extent.area;
      const std::vector<double> one = mesh::thickness_by_area(m.mesh, body.name);
      m.thickness.insert(m.thickness.end(), one.begin(), one.end());
    }
  std::sort(m.thickness.begin(), m.thickness.end());
  if (m.thickness.empty()) m.thickness = {std::cbrt(m.volume)};
  constexpr std::size_t k_spheres = 12;
  m.spheres = mesh::inscribed_spheres(m.mesh, m.metal, k_spheres);
  return m;
}

}  // namespace solidus::new_case
