/// Contents of a VTK XML file of an unstructured grid: its pieces, their arrays and cells.
#pragma once

#include <boost/property_tree/ptree.hpp>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesh/files/vtu_arrays.hpp"
#include "mesh/shape.hpp"

namespace solidus::mesh {

/// A cell of a file as shapes of ours: each by the file's corners in our order.
struct CellParts {
  Shape shape;
  std::vector<std::vector<int>> corners;
};
/// Shapes that Solidus has are taken as they are; voxels, pixels, wedges and pyramids as hexahedra,
/// quadrilaterals and tetrahedra. Nothing for other cells.
/// @param type  VTK's number of the cell type
std::optional<CellParts> parts_of(int type);

/// The array of a section ("PointData", "CellData", "Cells") of a <Piece>; null where there is none.
const boost::property_tree::ptree* find_array(const boost::property_tree::ptree& piece, const char* section,
                                              const std::string& name);
std::vector<std::string> array_names(const boost::property_tree::ptree& piece, const char* section);
/// Its UNITS_LABEL; empty where the file does not say it.
std::string array_unit(const boost::property_tree::ptree& array);
/// A number of the input that an array holds; the least of all where the array has none there.
inline std::int64_t whole_number(double value) {
  constexpr double k_beyond = 9.2e18;
  return std::abs(value) < k_beyond ? static_cast<std::int64_t>(value)
                                    : std::numeric_limits<std::int64_t>::min();
}
/// The element below <VTKFile>. Throws InputError where the file has none of that name.
const boost::property_tree::ptree& children(const VtuFile& file, const char* name);
/// The files of a grid: the file itself, or the parts that a .pvtu lists, as paths. Throws InputError where a
/// part is there twice or is the list itself; whether a part lists further ones is for its reader.
std::vector<std::filesystem::path> grid_files(const VtuFile& file, const std::filesystem::path& path);
/// The array of the points. Throws InputError where there is none.
const boost::property_tree::ptree& points_array(const VtuFile& file,
                                                const boost::property_tree::ptree& piece);

/// The cells of a piece as the file has them.
struct CellTable {
  std::vector<int> types;            ///< VTK's numbers; a Lagrange cell as the plain one of its corners
  std::vector<std::size_t> offsets;  ///< the end of each cell in `corners`
  std::vector<Index> corners;        ///< numbers of points, each below n_points
};
/// Told what is wrong with a file; throws.
using FailVtk = std::function<void(const std::string& what)>;
/// The table of numbers as a file has them: the type of each cell, its end in `corners`, and points.
CellTable cell_table(std::span<const double> types, std::span<const double> offsets,
                     std::span<const double> corners, std::size_t n_points, const FailVtk& fail);
/// Throws InputError where the table is missing or damaged.
CellTable read_cells(const VtuFile& file, const boost::property_tree::ptree& piece, std::size_t n_cells,
                     std::size_t n_points);

/// The numbers of points and cells of a piece. Throws InputError where they are beyond what is read.
struct PieceSize {
  std::size_t points = 0, cells = 0;
};
PieceSize piece_size(const VtuFile& file, const boost::property_tree::ptree& piece);

}  // namespace solidus::mesh
