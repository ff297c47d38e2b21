/// The one piece of a grid is read and handed on as a mesh.
#include "mesh/files/vtu_mesh.hpp"

#include "mesh/files/vtk_grid.hpp"
#include "mesh/files/vtu_pieces.hpp"

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

bool has_one_component(const ptree& array) {
  return array.get<int>("<xmlattr>.NumberOfComponents", 1) == 1;
}

}  // namespace

RawMesh read_vtu_mesh(const std::string& path, double unit_in_metres) {
  const VtuFile file(path);
  const ptree& piece = only_piece(file);
  const auto [n_points, n_cells] = piece_size(file, piece);
  VtkGrid grid;
  grid.points = file.numbers(points_array(file, piece), 3 * n_points);
  grid.cells = read_cells(file, piece, n_cells, n_points);
  for (const std::string& name : array_names(piece, "CellData"))
    if (const ptree* array = find_array(piece, "CellData", name); has_one_component(*array))
      grid.data.push_back({name, file.numbers(*array, n_cells)});
  return mesh_of_grid(path, grid, unit_in_metres);
}

}  // namespace solidus::mesh
