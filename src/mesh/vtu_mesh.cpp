#include "mesh/vtu_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "mesh/gmsh_elements.hpp"
#include "mesh/vtu_pieces.hpp"
#include "system/errors.hpp"

namespace solidus::mesh {

namespace {

using boost::property_tree::ptree;

const ptree& only_piece(const VtuFile& file) {
  if (file.type() != "UnstructuredGrid")
    file.fail("the file holds a grid of the type '" + file.type() + "'", "an UnstructuredGrid");
  const ptree* piece = nullptr;
  for (const auto& [tag, child] : children(file, "UnstructuredGrid")) {
    if (tag != "Piece") continue;
    if (piece != nullptr) file.fail("the mesh is in several pieces", "a file of one piece");
    piece = &child;
  }
  if (piece == nullptr) file.fail("the file has no piece of a grid");
  return *piece;
}

/// The number that tells the body of each cell; empty where no data tell it.
std::vector<double> body_numbers(const VtuFile& file, const ptree& piece, std::size_t n_cells) {
  for (const char* name : {"body", "gmsh:physical", "CellEntityIds"}) {
    const ptree* array = find_array(piece, "CellData", name);
    if (array == nullptr) continue;
    std::vector<double> numbers = file.numbers(*array, n_cells);
    for (const double number : numbers)
      if (number != std::round(number))
        file.fail(std::string("the cell data `") + name + "` are no whole numbers");
    return numbers;
  }
  return {};
}

}  // namespace

RawMesh read_vtu_mesh(const std::string& path, double unit_in_metres) {
  const VtuFile file(path);
  const ptree& piece = only_piece(file);
  const auto [n_points, n_cells] = piece_size(file, piece);
  RawMesh mesh;
  mesh.dimension = 0;
  const std::vector<double> x = file.numbers(points_array(file, piece), 3 * n_points);
  for (std::size_t i = 0; i < n_points; ++i) {
    mesh.x.push_back(
        {unit_in_metres * x[3 * i], unit_in_metres * x[3 * i + 1], unit_in_metres * x[3 * i + 2]});
    mesh.input_node.push_back(static_cast<GlobalIndex>(i) + 1);
  }

  const CellTable cells = read_cells(file, piece, n_cells, n_points);
  const std::vector<double> bodies = body_numbers(file, piece, n_cells);
  std::map<std::pair<int, double>, RawGroup> groups;  // by dimension and number
  for (std::size_t c = 0; c < n_cells; ++c) {
    const std::optional<CellParts> parts = parts_of(cells.types[c]);
    if (!parts || parts->corners.size() != 1)
      file.fail("the mesh has cells of VTK's type " + std::to_string(cells.types[c]), k_shapes_of_meshes);
    const int dimension = mesh::dimension(parts->shape);
    mesh.dimension = std::max(mesh.dimension, dimension);
    RawGroup& group = groups[{dimension, bodies.empty() ? 0.0 : bodies[c]}];
    group.dimension = dimension;
    auto block = std::find_if(group.blocks.begin(), group.blocks.end(),
                              [&](const RawBlock& b) { return b.shape == parts->shape; });
    if (block == group.blocks.end())
      block = group.blocks.insert(group.blocks.end(), RawBlock{parts->shape, {}, {}});
    const std::size_t begin = c == 0 ? 0 : cells.offsets[c - 1];
    if (cells.offsets[c] - begin != parts->corners[0].size())
      file.fail("the file is damaged: cell " + std::to_string(c) +
                " has another number of corners than its type");
    for (const int corner : parts->corners[0])
      block->nodes.push_back(cells.corners[begin + static_cast<std::size_t>(corner)]);
    block->input_element.push_back(static_cast<GlobalIndex>(c) + 1);
  }
  if (mesh.dimension < 2)
    file.fail("the mesh has no triangles, quads, tetrahedra or hexahedra: empty or not a mesh");
  int n_bodies = 0, n_surfaces = 0;
  for (auto& [key, group] : groups) {
    if (key.first == mesh.dimension)
      mesh.groups.emplace("body_" + std::to_string(++n_bodies), std::move(group));
    else if (key.first == mesh.dimension - 1)
      mesh.groups.emplace("surface_" + std::to_string(++n_surfaces), std::move(group));
  }
  return mesh;
}

}  // namespace solidus::mesh
