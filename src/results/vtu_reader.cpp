#include "results/vtu_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "base/keys.hpp"
#include "results/vtu.hpp"
#include "results/vtu_arrays.hpp"

namespace solidus::results {

namespace {

namespace fs = std::filesystem;
using boost::property_tree::ptree;
using mesh::Shape;

/// A cell of a file as shapes of ours: each by the file's corners in our order.
struct CellParts {
  Shape shape;
  std::vector<std::vector<int>> corners;
};

std::optional<CellParts> parts_of(int type) {
  for (const Shape shape : {Shape::point1, Shape::line2, Shape::line3, Shape::tri3, Shape::tri6, Shape::quad4,
                            Shape::quad8, Shape::tet4, Shape::tet10, Shape::hex8, Shape::hex20}) {
    if (vtk_cell_type(shape) != type) continue;
    CellParts parts{shape, {std::vector<int>(static_cast<std::size_t>(mesh::node_count(shape)))}};
    const std::span<const int> order = vtk_node_order(shape);
    for (std::size_t i = 0; i < order.size(); ++i)
      parts.corners[0][static_cast<std::size_t>(order[i])] = static_cast<int>(i);
    return parts;
  }
  if (type == 8) return CellParts{Shape::quad4, {{0, 1, 3, 2}}};
  if (type == 11) return CellParts{Shape::hex8, {{0, 1, 3, 2, 4, 5, 7, 6}}};
  if (type == 13) return CellParts{Shape::tet4, {{0, 1, 2, 5}, {0, 1, 5, 4}, {0, 4, 5, 3}}};
  if (type == 14) return CellParts{Shape::tet4, {{0, 1, 2, 4}, {0, 2, 3, 4}}};
  return std::nullopt;
}

std::string name_of(const ptree& array) {
  return array.get<std::string>("<xmlattr>.Name", "");
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

std::string unit_of(const ptree& array) {
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

class Reader {
 public:
  Reader(const std::string& field, int body, double length, const SourceLocation& where)
      : field_(field), body_(body), length_(length), where_(where) {}

  void read(const fs::path& path) {
    if (!fs::exists(path))
      throw InputError(where_, fmt::format("the file '{}' does not exist", path.string()));
    const VtuFile file(path);
    if (file.type() == "PUnstructuredGrid") {
      for (const auto& [tag, child] : children(file, "PUnstructuredGrid"))
        if (tag == "Piece") read(path.parent_path() / child.get<std::string>("<xmlattr>.Source", ""));
      return;
    }
    if (file.type() != "UnstructuredGrid")
      file.fail(fmt::format("the file holds a grid of the type '{}'", file.type()), "an UnstructuredGrid");
    for (const auto& [tag, child] : children(file, "UnstructuredGrid"))
      if (tag == "Piece") add_piece(file, child);
  }

  ReadField result(const fs::path& path) {
    mesh::Mesh& mesh = read_.mesh;
    int dimension = 0;
    for (const auto& [shape, nodes] : cells_) dimension = std::max(dimension, mesh::dimension(shape));
    if (dimension < 2) {
      if (body_ >= 0 && found_body_)
        throw InputError(where_, fmt::format("'{}' has no cells of the body {}", path.string(), body_),
                         "a number of its cell data `body`");
      throw InputError(where_, fmt::format("'{}' has no areas or volumes", path.string()));
    }
    mesh.dimension = dimension;
    mesh.n_owned_nodes = static_cast<Index>(mesh.x.size());
    mesh.n_global_nodes = mesh.n_owned_nodes;
    mesh.bodies.push_back({"body"});
    for (auto& [shape, nodes] : cells_) {
      if (mesh::dimension(shape) != dimension) continue;
      mesh::Block block{.shape = shape, .body = 0, .nodes = std::move(nodes), .input_element = {}};
      block.n_counted = block.size();
      for (Index e = 0; e < block.size(); ++e) block.input_element.push_back(e + 1);
      mesh.blocks.push_back(std::move(block));
    }
    return std::move(read_);
  }

 private:
  void add_piece(const VtuFile& file, const ptree& piece) {
    const auto n_points = piece.get<std::size_t>("<xmlattr>.NumberOfPoints", 0);
    const auto n_cells = piece.get<std::size_t>("<xmlattr>.NumberOfCells", 0);
    constexpr std::size_t k_most = std::size_t{1} << 31U;
    if (n_points >= k_most || n_cells >= k_most) file.fail("the file has more points or cells than are read");
    const ptree* points = nullptr;
    if (const auto group = piece.get_child_optional("Points"))
      for (const auto& [tag, child] : *group)
        if (tag == "DataArray") points = &child;
    if (points == nullptr) file.fail("the file has no points");
    const ptree* field = find_array(piece, "PointData", field_);
    if (field == nullptr)
      throw InputError(where_, fmt::format("the file has no field '{}' at its points", field_),
                       one_of(array_names(piece, "PointData"), field_));
    if (field->get<int>("<xmlattr>.NumberOfComponents", 1) != 1)
      throw InputError(where_, fmt::format("the field '{}' of the file has several components", field_),
                       "a field of one component");
    read_.unit = unit_of(*field);
    const std::size_t first = read_.mesh.x.size();
    const std::vector<double> x = file.numbers(*points, 3 * n_points);
    for (std::size_t i = 0; i < n_points; ++i)
      read_.mesh.x.push_back({length_ * x[3 * i], length_ * x[3 * i + 1], length_ * x[3 * i + 2]});
    const std::vector<double> values = file.numbers(*field, n_points);
    read_.values.insert(read_.values.end(), values.begin(), values.end());
    add_cells(file, piece, n_cells, first, n_points);
  }

  void add_cells(const VtuFile& file, const ptree& piece, std::size_t n_cells, std::size_t first,
                 std::size_t n_points) {
    const ptree* arrays[3] = {};
    const char* const names[3] = {"offsets", "types", "connectivity"};
    for (std::size_t k = 0; k < 3; ++k) {
      arrays[k] = find_array(piece, "Cells", names[k]);
      if (arrays[k] == nullptr) file.fail(fmt::format("the cells of the file have no '{}'", names[k]));
    }
    const std::vector<double> offsets = file.numbers(*arrays[0], n_cells);
    const std::vector<double> types = file.numbers(*arrays[1], n_cells);
    const double n_corners = n_cells == 0 ? 0 : offsets.back();
    if (!(n_corners >= 0 && n_corners <= 1e10)) file.fail("the file is damaged: its offsets make no sense");
    const std::vector<double> corners = file.numbers(*arrays[2], static_cast<std::size_t>(n_corners));
    const std::vector<double> bodies = cell_data(file, piece, "body", n_cells);
    const std::vector<double> ghosts = cell_data(file, piece, "vtkGhostType", n_cells);
    if (body_ >= 0 && bodies.empty() && n_cells > 0)
      throw InputError(where_, "the file has no cell data `body`", "no 'body', or a file that has it");
    found_body_ = true;
    for (std::size_t c = 0; c < n_cells; ++c) {
      if (body_ >= 0 && bodies[c] != body_) continue;
      if (!ghosts.empty() && ghosts[c] != 0) continue;
      const std::optional<CellParts> parts = parts_of(static_cast<int>(types[c]));
      if (!parts)
        file.fail(fmt::format("cells of VTK's type {} are not read", types[c]),
                  "triangles, quadrilaterals, tetrahedra, hexahedra, linear or quadratic, wedges, pyramids");
      const double begin = c == 0 ? 0 : offsets[c - 1];
      for (const std::vector<int>& part : parts->corners)
        for (const int corner : part) {
          const double at = begin + corner;
          const double node = at >= 0 && at < offsets[c] ? corners[static_cast<std::size_t>(at)] : -1;
          if (!(node >= 0 && node < static_cast<double>(n_points)))
            file.fail(fmt::format("the file is damaged: cell {} has a corner that is no point", c));
          cells_[parts->shape].push_back(static_cast<Index>(first + static_cast<std::size_t>(node)));
        }
    }
  }

  static std::vector<double> cell_data(const VtuFile& file, const ptree& piece, const char* name,
                                       std::size_t n_cells) {
    const ptree* array = find_array(piece, "CellData", name);
    return array == nullptr ? std::vector<double>{} : file.numbers(*array, n_cells);
  }

  std::string field_;
  int body_;
  double length_;
  SourceLocation where_;
  bool found_body_ = false;
  ReadField read_;
  std::map<Shape, std::vector<Index>> cells_;
};

}  // namespace

ReadField read_vtu(const fs::path& file, const std::string& field, int body, double length,
                   const SourceLocation& where) {
  Reader reader(field, body, length, where);
  reader.read(file);
  ReadField read = reader.result(file);
  // Points that no kept cell has (of other bodies) may hold anything; those of cells must be numbers.
  for (const mesh::Block& block : read.mesh.blocks)
    for (const Index node : block.nodes)
      if (!std::isfinite(read.values[static_cast<std::size_t>(node)]))
        throw InputError({file.string(), 0, 0}, fmt::format("the field '{}' is not finite somewhere", field));
  return read;
}

}  // namespace solidus::results
