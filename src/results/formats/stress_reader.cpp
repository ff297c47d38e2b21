/// Pieces follow each other; of each the places that the body has are kept.
#include "results/formats/stress_reader.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "input/keys.hpp"
#include "mesh/files/vtu_arrays.hpp"
#include "mesh/files/vtu_pieces.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::results {

namespace {

namespace fs = std::filesystem;
using boost::property_tree::ptree;
using mesh::VtuFile;

constexpr std::size_t k_components = 6;

struct Wanted {
  std::string field;
  int body;
  double length;
  SourceLocation where;
};

/// The array of the field, with whether it is one of cells.
struct Array {
  const ptree* data;
  bool of_cells;
};

Array find_field(const ptree& piece, const Wanted& wanted) {
  const ptree* of_cells = mesh::find_array(piece, "CellData", wanted.field);
  const ptree* data = of_cells != nullptr ? of_cells : mesh::find_array(piece, "PointData", wanted.field);
  if (data == nullptr) {
    std::vector<std::string> names = mesh::array_names(piece, "CellData");
    for (const std::string& name : mesh::array_names(piece, "PointData")) names.push_back(name);
    throw InputError(wanted.where, fmt::format("the file has no field '{}'", wanted.field),
                     one_of(names, wanted.field));
  }
  if (const int n = data->get<int>("<xmlattr>.NumberOfComponents", 1); n != static_cast<int>(k_components))
    throw InputError(wanted.where,
                     fmt::format("the field '{}' of the file has {} components", wanted.field, n),
                     "a stress with six: xx, yy, zz, xy, yz, xz");
  return {data, of_cells != nullptr};
}

std::vector<double> cell_data(const VtuFile& file, const ptree& piece, const char* name, std::size_t n) {
  const ptree* array = mesh::find_array(piece, "CellData", name);
  return array == nullptr ? std::vector<double>{} : file.numbers(*array, n);
}

void add(const mesh::Point& x, const double* values, ReadStress& read) {
  std::array<double, k_components> s{};
  std::copy_n(values, k_components, s.begin());
  read.x.push_back(x);
  read.values.push_back(s);
}

void add_piece(const VtuFile& file, const ptree& piece, const Wanted& wanted, ReadStress& read) {
  const auto [n_points, n_cells] = mesh::piece_size(file, piece);
  if (n_cells == 0) return;  // a process may have nothing
  const Array field = find_field(piece, wanted);
  read.unit = mesh::array_unit(*field.data);
  const std::vector<double> x = file.numbers(mesh::points_array(file, piece), 3 * n_points);
  const std::vector<double> values =
      file.numbers(*field.data, k_components * (field.of_cells ? n_cells : n_points));
  const std::vector<double> bodies = cell_data(file, piece, "body", n_cells),
                            ghosts = cell_data(file, piece, "vtkGhostType", n_cells);
  if (wanted.body >= 0 && bodies.empty())
    throw InputError(wanted.where, "the file has no cell data `body`", "no 'body', or a file that has it");
  const mesh::CellTable cells = mesh::read_cells(file, piece, n_cells, n_points);
  const auto point = [&](std::size_t i) {
    return mesh::Point{wanted.length * x[3 * i], wanted.length * x[3 * i + 1], wanted.length * x[3 * i + 2]};
  };
  // Of the points those that a cell of the body has; of the cells their middles.
  std::vector<char> taken(n_points, 0);
  for (std::size_t c = 0, begin = 0; c < n_cells; begin = cells.offsets[c++]) {
    if ((wanted.body >= 0 && bodies[c] != wanted.body) || (!ghosts.empty() && ghosts[c] != 0)) continue;
    mesh::Point middle{};
    for (std::size_t k = begin; k < cells.offsets[c]; ++k) {
      const auto corner = as_size(cells.corners[k]);
      const mesh::Point at = point(corner);
      for (std::size_t i = 0; i < 3; ++i) middle[i] += at[i] / static_cast<double>(cells.offsets[c] - begin);
      if (!field.of_cells && taken[corner] == 0) add(at, &values[k_components * corner], read);
      taken[corner] = 1;
    }
    if (field.of_cells) add(middle, &values[k_components * c], read);
  }
}

}  // namespace

ReadStress read_stress(const fs::path& path, const std::string& field, int body, double length,
                       const SourceLocation& where) {
  if (!fs::exists(path)) throw InputError(where, fmt::format("the file '{}' does not exist", path.string()));
  const Wanted wanted{field, body, length, where};
  ReadStress read;
  const VtuFile list(path);
  for (const fs::path& each : mesh::grid_files(list, path)) {
    const VtuFile file(each);
    if (file.type() != "UnstructuredGrid")
      file.fail(fmt::format("the file holds a grid of the type '{}'", file.type()), "an UnstructuredGrid");
    for (const auto& [tag, child] : mesh::children(file, "UnstructuredGrid"))
      if (tag == "Piece") add_piece(file, child, wanted, read);
  }
  if (read.x.empty())
    throw InputError(where, fmt::format("'{}' has no cells of the body {}", path.string(), body),
                     "a number of its cell data `body`");
  for (const auto& s : read.values)
    for (const double value : s)
      if (!std::isfinite(value))
        throw InputError({path.string(), 0, 0}, fmt::format("the field '{}' is not finite somewhere", field));
  return read;
}

}  // namespace solidus::results
