/// Points become nodes, cells become groups by their dimension and by the numbers of the cell data that
/// tell bodies apart.
#include "mesh/files/vtk_grid.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "mesh/files/gmsh_elements.hpp"
#include "mesh/files/vtk_cells.hpp"
#include "numbers/index_casts.hpp"
#include "system/errors.hpp"

namespace solidus::mesh {

namespace {

/// Letters and digits alone, in lower case: "Material_Ids" is "materialids".
std::string plain(const std::string& name) {
  std::string letters;
  for (const char c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) != 0)
      letters += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return letters;
}

/// Whether a program gives this name to numbers of materials, groups or regions.
bool names_regions(const std::string& array) {
  constexpr std::array k_known{"material",
                               "materials",
                               "materialid",
                               "materialids",
                               "mat",
                               "matid",
                               "group",
                               "groups",
                               "groupid",
                               "groupids",
                               "region",
                               "regions",
                               "regionid",
                               "regionids",
                               "zone",
                               "zoneid",
                               "domain",
                               "domainid",
                               "subdomain",
                               "subdomains",
                               "subdomainid",
                               "elementblock",
                               "elementblockids",
                               "blockid",
                               "blockids",
                               "partid",
                               "partids",
                               "part",
                               "parts",
                               "objectid",
                               "entityid",
                               "entityids",
                               "cellentityids",
                               "celltags",
                               "cellmarkers",
                               "celltag",
                               "meshtags",
                               "physical",
                               "gmshphysical",
                               "attribute",
                               "attributes",
                               "medfamily",
                               "familyid",
                               "propertyid",
                               "pid"};
  return std::ranges::find(k_known, plain(array)) != k_known.end();
}

/// The different numbers of an array, where all are whole ones; at most a hundred, else nothing.
std::optional<std::set<double>> few_whole_numbers(const std::vector<double>& numbers) {
  constexpr std::size_t k_most = 100;
  std::set<double> different;
  for (const double number : numbers) {
    if (number != std::round(number)) return std::nullopt;
    different.insert(number);
    if (different.size() > k_most) return std::nullopt;
  }
  return different;
}

struct Regions {
  std::vector<double> numbers;     ///< that tells the body of each cell; empty where no data tell it
  std::vector<std::string> notes;  ///< on the data that were chosen or not
};

/// The first of the known names decides.
Regions regions_of(const std::string& path, const VtkGrid& grid) {
  constexpr std::array k_certain{"body", "gmsh:physical", "CellEntityIds"};
  Regions regions;
  // Names that say without doubt what a body is are taken first.
  for (const char* name : k_certain) {
    const auto data = std::ranges::find(grid.data, name, &VtkCellData::name);
    if (data == grid.data.end() || !regions.numbers.empty()) continue;
    for (const double number : data->numbers)
      if (number != std::round(number))
        throw InputError({path}, fmt::format("the cell data `{}` are no whole numbers", name));
    regions.numbers = data->numbers;
  }
  // Other data are used if they hold a few whole numbers under a name that programs use for
  // regions.
  std::string others;
  for (const VtkCellData& data : grid.data) {
    if (data.name.starts_with("vtk") || std::ranges::find(k_certain, data.name) != k_certain.end()) continue;
    const auto different = few_whole_numbers(data.numbers);
    if (!different || different->size() < 2) continue;
    if (!regions.numbers.empty() || !names_regions(data.name)) {
      others += (others.empty() ? "`" : ", `") + data.name + "`";
      continue;
    }
    regions.numbers = data.numbers;
    regions.notes.push_back(fmt::format("the cell data `{}` tell bodies apart, by the numbers {:g}",
                                        data.name, fmt::join(*different, ", ")));
  }
  // Data that might have been meant are named, since the user can rename them.
  if (!others.empty() && regions.numbers.empty())
    regions.notes.push_back("no cell data tell bodies apart, all is one body; perhaps " + others +
                            " should, under the name `body`");
  return regions;
}

/// The nodes of a cell of the mesh, whole: wedges and pyramids are split when all is read
/// (mesh/files/split_cells.hpp).
std::optional<CellParts> cell_of(int type) {
  if (type == vtk_cell_type(Shape::wedge6)) return CellParts{Shape::wedge6, {{0, 1, 2, 3, 4, 5}}};
  if (type == vtk_cell_type(Shape::pyramid5)) return CellParts{Shape::pyramid5, {{0, 1, 2, 3, 4}}};
  return parts_of(type);
}

}  // namespace

RawMesh mesh_of_grid(const std::string& path, const VtkGrid& grid, double unit_in_metres) {
  // Points become nodes, numbered in their order.
  RawMesh mesh;
  mesh.dimension = 0;
  for (std::size_t i = 0; i < grid.points.size() / 3; ++i) {
    const double* x = &grid.points[3 * i];
    mesh.x.push_back({unit_in_metres * x[0], unit_in_metres * x[1], unit_in_metres * x[2]});
    mesh.input_node.push_back(static_cast<GlobalIndex>(i) + 1);
  }
  // Cells become groups by dimension and by the number of their region, if the file has one.
  const CellTable& cells = grid.cells;
  Regions regions = regions_of(path, grid);
  const std::vector<double>& bodies = regions.numbers;
  std::map<std::pair<int, double>, RawGroup> groups;  // by dimension and number
  for (std::size_t c = 0; c < cells.types.size(); ++c) {
    const std::optional<CellParts> parts = cell_of(cells.types[c]);
    if (!parts)
      throw InputError({path}, "the mesh has cells of VTK's type " + std::to_string(cells.types[c]),
                       k_shapes_of_meshes);
    const int dimension = mesh::dimension(parts->shape);
    mesh.dimension = std::max(mesh.dimension, dimension);
    RawGroup& group = groups[{dimension, bodies.empty() ? 0.0 : bodies[c]}];
    group.dimension = dimension;
    // The block of this shape in the group, or a new one.
    auto block = std::find_if(group.blocks.begin(), group.blocks.end(),
                              [&](const RawBlock& b) { return b.shape == parts->shape; });
    if (block == group.blocks.end())
      block = group.blocks.insert(group.blocks.end(), RawBlock{parts->shape, {}, {}});
    // The offsets of the file must fit the number of corners of each type.
    const std::size_t begin = c == 0 ? 0 : cells.offsets[c - 1];
    if (cells.offsets[c] - begin != parts->corners[0].size())
      throw InputError({path}, "the file is damaged: cell " + std::to_string(c) +
                                   " has another number of corners than its type");
    for (const int corner : parts->corners[0]) block->nodes.push_back(cells.corners[begin + as_size(corner)]);
    block->input_element.push_back(static_cast<GlobalIndex>(c) + 1);
  }
  // Groups of the highest dimension are bodies, those of one less surfaces; anything below is dropped.
  if (mesh.dimension < 2)
    throw InputError({path},
                     "the mesh has no triangles, quads, tetrahedra or hexahedra: empty or not a mesh");
  // Bodies and surfaces are numbered by the regions in rising order.
  int n_bodies = 0, n_surfaces = 0;
  for (auto& [key, group] : groups) {
    if (key.first == mesh.dimension)
      mesh.groups.emplace("body_" + std::to_string(++n_bodies), std::move(group));
    else if (key.first == mesh.dimension - 1)
      mesh.groups.emplace("surface_" + std::to_string(++n_surfaces), std::move(group));
  }
  mesh.notes = std::move(regions.notes);
  return mesh;
}

}  // namespace solidus::mesh
