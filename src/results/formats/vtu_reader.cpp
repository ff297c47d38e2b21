/// Pieces are joined to one grid, and fields looked up by name.
#include "results/formats/vtu_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "input/keys.hpp"
#include "mesh/files/vtu_arrays.hpp"
#include "mesh/files/vtu_pieces.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::results {

namespace {

namespace fs = std::filesystem;
using boost::property_tree::ptree;
using mesh::CellParts;
using mesh::CellTable;
using mesh::Shape;
using mesh::VtuFile;

class Reader {
 public:
  Reader(const std::string& field, int body, double length, const SourceLocation& where)
      : field_(field), body_(body), length_(length), where_(where) {}

  /// @param part  the file is in a list of parts, and is none itself
  void read(const fs::path& path, bool part = false) {
    if (!fs::exists(path))
      throw InputError(where_, fmt::format("the file '{}' does not exist", path.string()));
    const VtuFile file(path);
    if (file.type() == "PUnstructuredGrid" && !part) {
      for (const fs::path& each : grid_files(file, path)) read(each, true);
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
    // Cells of the highest dimension are the body; those of surfaces are left out.
    for (const auto& [shape, nodes] : cells_) dimension = std::max(dimension, mesh::dimension(shape));
    if (dimension < 2) {
      if (body_ >= 0 && found_body_)
        throw InputError(where_, fmt::format("'{}' has no cells of the body {}", path.string(), body_),
                         "a number of its cell data `body`");
      throw InputError(where_, fmt::format("'{}' has no areas or volumes", path.string()));
    }
    // A mesh of one body that this process has alone.
    mesh.dimension = dimension;
    mesh.n_owned_nodes = as_index(mesh.x.size());
    mesh.n_global_nodes = mesh.n_owned_nodes;
    mesh.bodies.push_back({"body"});
    // Each shape becomes a block, numbered from one.
    for (auto& [shape, nodes] : cells_) {
      if (mesh::dimension(shape) != dimension) continue;
      mesh::ElementBlock block{.shape = shape, .body = 0, .nodes = std::move(nodes), .input_element = {}};
      block.n_counted = block.size();
      for (Index e = 0; e < block.size(); ++e) block.input_element.push_back(e + 1);
      mesh.blocks.push_back(std::move(block));
    }
    return std::move(read_);
  }

 private:
  void add_piece(const VtuFile& file, const ptree& piece) {
    // Points and field of the piece must both be there.
    const auto [n_points, n_cells] = piece_size(file, piece);
    const ptree& points = points_array(file, piece);
    // The field must be there, at points, with one component.
    const ptree* field = mesh::find_array(piece, "PointData", field_);
    if (field == nullptr)
      throw InputError(where_, fmt::format("the file has no field '{}' at its points", field_),
                       one_of(mesh::array_names(piece, "PointData"), field_));
    if (field->get<int>("<xmlattr>.NumberOfComponents", 1) != 1)
      throw InputError(where_, fmt::format("the field '{}' of the file has several components", field_),
                       "a field of one component");
    read_.unit = mesh::array_unit(*field);
    // Points and values of further pieces follow those before.
    const std::size_t first = read_.mesh.x.size();
    const std::vector<double> x = file.numbers(points, 3 * n_points);
    for (std::size_t i = 0; i < n_points; ++i)
      read_.mesh.x.push_back({length_ * x[3 * i], length_ * x[3 * i + 1], length_ * x[3 * i + 2]});
    const std::vector<double> values = file.numbers(*field, n_points);
    read_.values.insert(read_.values.end(), values.begin(), values.end());
    add_cells(file, piece, n_cells, first, n_points);
  }

  void add_cells(const VtuFile& file, const ptree& piece, std::size_t n_cells, std::size_t first,
                 std::size_t n_points) {
    // Cells are checked against the number of points of their own piece.
    const CellTable cells = read_cells(file, piece, n_cells, n_points);
    const std::vector<double> bodies = cell_data(file, piece, "body", n_cells);
    // Copies of cells of other processes are marked as ghosts.
    const std::vector<double> ghosts = cell_data(file, piece, "vtkGhostType", n_cells);
    if (body_ >= 0 && bodies.empty() && n_cells > 0)
      throw InputError(where_, "the file has no cell data `body`", "no 'body', or a file that has it");
    found_body_ = true;
    // Cells of the body asked for, without copies of other processes, split into simplices and cubes.
    for (std::size_t c = 0; c < n_cells; ++c) {
      if (body_ >= 0 && bodies[c] != body_) continue;
      if (!ghosts.empty() && ghosts[c] != 0) continue;
      const std::optional<CellParts> parts = mesh::parts_of(cells.types[c]);
      if (!parts)
        file.fail(fmt::format("cells of VTK's type {} are not read", cells.types[c]),
                  "triangles, quadrilaterals, tetrahedra, hexahedra, linear or quadratic, wedges, pyramids");
      // Corners of the part within the cell, which a damaged file may let end too early.
      const std::size_t begin = c == 0 ? 0 : cells.offsets[c - 1];
      for (const std::vector<int>& part : parts->corners)
        for (const int corner : part) {
          const std::size_t at = begin + as_size(corner);
          if (at >= cells.offsets[c])
            file.fail(fmt::format("the file is damaged: cell {} has a corner that is no point", c));
          cells_[parts->shape].push_back(as_index(first) + cells.corners[at]);
        }
    }
  }

  static std::vector<double> cell_data(const VtuFile& file, const ptree& piece, const char* name,
                                       std::size_t n_cells) {
    const ptree* array = mesh::find_array(piece, "CellData", name);
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
  for (const mesh::ElementBlock& block : read.mesh.blocks)
    for (const Index node : block.nodes)
      if (!std::isfinite(read.values[as_size(node)]))
        throw InputError({file.string(), 0, 0}, fmt::format("the field '{}' is not finite somewhere", field));
  return read;
}

}  // namespace solidus::results
