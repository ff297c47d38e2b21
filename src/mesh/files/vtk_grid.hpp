/// A mesh of what a file of VTK holds, in its XML or its legacy format.
#pragma once

#include <string>
#include <vector>

#include "mesh/files/vtu_pieces.hpp"
#include "mesh/raw_mesh.hpp"

namespace solidus::mesh {

struct VtkCellData {
  std::string name;
  std::vector<double> numbers;  ///< one of each cell
};
struct VtkGrid {
  std::vector<double> points;  ///< three coordinates each, in units of the file
  CellTable cells;
  std::vector<VtkCellData> data;  ///< with one component
};

/// Cells of the highest dimension become body_1, body_2, …, those of a dimension less surface_1, …, by the
/// whole numbers of the cell data `body`, `gmsh:physical` or `CellEntityIds`, else by those under a name that
/// programs give to materials, groups or regions, which a note says; without either all is one body.
/// @param path  of the file, for messages
/// Throws InputError for cells that are no element here and where nothing of two dimensions is there.
RawMesh mesh_of_grid(const std::string& path, const VtkGrid& grid, double unit_in_metres);

}  // namespace solidus::mesh
