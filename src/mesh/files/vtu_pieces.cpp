/// Pieces, arrays and cells of a grid, checked against each other before they are used as indices.
#include "mesh/files/vtu_pieces.hpp"

#include <fmt/format.h>

#include <set>
#include <span>

#include "mesh/files/vtk_cells.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mesh {

using boost::property_tree::ptree;

namespace {

std::string name_of(const ptree& array) {
  return array.get<std::string>("<xmlattr>.Name", "");
}

/// The cell of a fixed number of corners that a Lagrange cell of as many corners is; DOLFINx writes linear
/// meshes so. Others stay as they are.
int plain_type(int type, std::size_t n_corners) {
  struct Lagrange {
    int type;
    std::size_t n_corners;
    int plain;
  };
  constexpr Lagrange k_known[] = {{68, 2, 3},  {68, 3, 21},  {69, 3, 5},  {69, 6, 22}, {70, 4, 9},
                                  {71, 4, 10}, {71, 10, 24}, {72, 8, 12}, {73, 6, 13}};
  for (const Lagrange& known : k_known)
    if (known.type == type && known.n_corners == n_corners) return known.plain;
  return type;
}

}  // namespace

std::optional<CellParts> parts_of(int type) {
  for (const Shape shape : {Shape::point1, Shape::line2, Shape::line3, Shape::tri3, Shape::tri6, Shape::quad4,
                            Shape::quad8, Shape::tet4, Shape::tet10, Shape::hex8, Shape::hex20}) {
    if (vtk_cell_type(shape) != type) continue;
    CellParts parts{shape, {std::vector<int>(as_size(node_count(shape)))}};
    const std::span<const int> order = vtk_node_order(shape);
    for (std::size_t i = 0; i < order.size(); ++i) parts.corners[0][as_size(order[i])] = static_cast<int>(i);
    return parts;
  }
  if (type == 8) return CellParts{Shape::quad4, {{0, 1, 3, 2}}};
  if (type == 11) return CellParts{Shape::hex8, {{0, 1, 3, 2, 4, 5, 7, 6}}};
  if (type == 13) return CellParts{Shape::tet4, {{0, 1, 2, 5}, {0, 1, 5, 4}, {0, 4, 5, 3}}};
  if (type == 14) return CellParts{Shape::tet4, {{0, 1, 2, 4}, {0, 2, 3, 4}}};
  return std::nullopt;
}

const ptree* find_array(const ptree& piece, const char* section, const std::string& name) {
  const auto group = piece.get_child_optional(section);
  if (!group) return nullptr;
  for (const auto& [tag, child] : *group)
    if (tag == "DataArray" && name_of(child) == name) return &child;
  return nullptr;
}

std::vector<std::string> array_names(const ptree& piece, const char* section) {
  std::vector<std::string> names;
  if (const auto group = piece.get_child_optional(section))
    for (const auto& [tag, child] : *group)
      if (tag == "DataArray") names.push_back(name_of(child));
  return names;
}

std::string array_unit(const ptree& array) {
  for (const auto& [tag, child] : array)
    if (tag == "InformationKey" && child.get<std::string>("<xmlattr>.name", "") == "UNITS_LABEL") {
      std::string text = child.get<std::string>("Value", child.data());
      text.erase(0, text.find_first_not_of(" \n\r\t"));
      text.erase(text.find_last_not_of(" \n\r\t") + 1);
      return text;
    }
  return {};
}

const ptree& children(const VtuFile& file, const char* name) {
  const auto found = file.root().get_child_optional(name);
  if (!found) file.fail(fmt::format("the file has no <{}>", name));
  return *found;
}

std::vector<std::filesystem::path> grid_files(const VtuFile& file, const std::filesystem::path& path) {
  if (file.type() != "PUnstructuredGrid") return {path};
  std::vector<std::filesystem::path> parts;
  std::set<std::filesystem::path> seen = {std::filesystem::weakly_canonical(path)};
  for (const auto& [tag, child] : children(file, "PUnstructuredGrid")) {
    if (tag != "Piece") continue;
    parts.push_back(path.parent_path() / child.get<std::string>("<xmlattr>.Source", ""));
    if (!seen.insert(std::filesystem::weakly_canonical(parts.back())).second)
      file.fail(fmt::format("'{}' is in the list of parts twice", parts.back().string()));
  }
  return parts;
}

const ptree& points_array(const VtuFile& file, const ptree& piece) {
  const ptree* points = nullptr;
  if (const auto group = piece.get_child_optional("Points"))
    for (const auto& [tag, child] : *group)
      if (tag == "DataArray") points = &child;
  if (points == nullptr) file.fail("the file has no points");
  return *points;
}

CellTable cell_table(std::span<const double> types, std::span<const double> offsets,
                     std::span<const double> corners, std::size_t n_points, const FailVtk& fail) {
  // Offsets rise and stay within the corners, types are small numbers, and corners are points of the piece.
  double end = 0;
  for (const double offset : offsets) {
    if (!(offset >= end && offset <= static_cast<double>(corners.size())))
      fail("the file is damaged: its offsets make no sense");
    end = offset;
  }
  for (const double type : types)
    if (!(type >= 0 && type <= 255)) fail(fmt::format("cells of VTK's type {:g} are not read", type));
  // Types that VTK has under several numbers become one; corners must be points of this piece.
  CellTable table;
  table.types.assign(types.begin(), types.end());
  table.offsets.assign(offsets.begin(), offsets.end());
  for (std::size_t c = 0; c < table.types.size(); ++c)
    table.types[c] = plain_type(table.types[c], table.offsets[c] - (c == 0 ? 0 : table.offsets[c - 1]));
  table.corners.reserve(corners.size());
  for (std::size_t c = 0, at = 0; c < table.types.size(); ++c)
    for (; at < table.offsets[c]; ++at) {
      if (!(corners[at] >= 0 && corners[at] < static_cast<double>(n_points)))
        fail(fmt::format("the file is damaged: cell {} has a corner that is no point", c));
      table.corners.push_back(static_cast<Index>(corners[at]));
    }
  return table;
}

CellTable read_cells(const VtuFile& file, const ptree& piece, std::size_t n_cells, std::size_t n_points) {
  const ptree* arrays[3] = {};
  const char* const names[3] = {"offsets", "types", "connectivity"};
  for (std::size_t k = 0; k < 3; ++k) {
    arrays[k] = find_array(piece, "Cells", names[k]);
    if (arrays[k] == nullptr) file.fail(fmt::format("the cells of the file have no '{}'", names[k]));
  }
  const std::vector<double> offsets = file.numbers(*arrays[0], n_cells);
  const std::vector<double> types = file.numbers(*arrays[1], n_cells);
  const double end = offsets.empty() ? 0 : offsets.back();
  if (!(end >= 0 && end <= 1e10)) file.fail("the file is damaged: its offsets make no sense");
  const std::vector<double> corners = file.numbers(*arrays[2], static_cast<std::size_t>(end));
  return cell_table(types, offsets, corners, n_points, [&](const std::string& what) { file.fail(what); });
}

PieceSize piece_size(const VtuFile& file, const ptree& piece) {
  const PieceSize size{piece.get<std::size_t>("<xmlattr>.NumberOfPoints", 0),
                       piece.get<std::size_t>("<xmlattr>.NumberOfCells", 0)};
  constexpr std::size_t k_most = std::size_t{1} << 31U;
  if (size.points >= k_most || size.cells >= k_most)
    file.fail("the file has more points or cells than are read");
  return size;
}

}  // namespace solidus::mesh
