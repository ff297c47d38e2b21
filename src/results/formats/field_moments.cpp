/// Field files of the moments are read and checked for having one mesh.
#include "results/formats/field_moments.hpp"

#include <fmt/format.h>

#include <limits>
#include <string_view>

#include "system/errors.hpp"

namespace solidus::results {

namespace fs = std::filesystem;
using boost::property_tree::ptree;

std::size_t FieldMoment::n_points() const {
  std::size_t n = 0;
  for (const Piece& piece : pieces_) n += piece.n_points;
  return n;
}

std::size_t FieldMoment::n_cells() const {
  std::size_t n = 0;
  for (const Piece& piece : pieces_) n += piece.n_cells;
  return n;
}

void FieldMoment::add(const fs::path& path, bool part) {
  files_.push_back(std::make_unique<mesh::VtuFile>(path));
  const mesh::VtuFile& file = *files_.back();
  if (file.type() == "PUnstructuredGrid" && !part) {
    for (const fs::path& each : grid_files(file, path)) add(each, true);
    return;
  }
  for (const auto& [tag, child] : children(file, "UnstructuredGrid"))
    if (tag == "Piece") {
      const auto [n_points, n_cells] = piece_size(file, child);
      pieces_.push_back({&file, &child, n_points, n_cells});
    }
}

bool FieldArray::of_points() const {
  return section == std::string_view("PointData");
}

bool FieldArray::is_of_mesh() const {
  return name == "node" || name == "element" || name == "body" || name == "process";
}

std::vector<FieldArray> columns_of(const FieldMoment::Piece& piece) {
  std::vector<FieldArray> columns;
  for (const char* section : {"PointData", "CellData"})
    for (const std::string& name : mesh::array_names(*piece.tree, section)) {
      if (name == k_hidden_cells) continue;
      const ptree& array = *mesh::find_array(*piece.tree, section, name);
      columns.push_back({section, name, mesh::array_unit(array),
                         array.get<std::size_t>("<xmlattr>.NumberOfComponents", 1)});
    }
  return columns;
}

std::vector<double> values_of(const FieldMoment& moment, const FieldArray& column) {
  std::vector<double> all;
  for (const FieldMoment::Piece& piece : moment.pieces()) {
    const ptree* array = mesh::find_array(*piece.tree, column.section, column.name);
    if (array == nullptr || array->get<std::size_t>("<xmlattr>.NumberOfComponents", 1) != column.components)
      piece.file->fail(fmt::format("the file has no array '{}' as the first of the run has", column.name));
    const std::size_t n = column.of_points() ? piece.n_points : piece.n_cells;
    const std::vector<double> values = piece.file->numbers(*array, n * column.components);
    all.insert(all.end(), values.begin(), values.end());
  }
  return all;
}

std::vector<std::uint8_t> hidden_cells(const FieldMoment& moment) {
  std::vector<std::uint8_t> all;
  for (const FieldMoment::Piece& piece : moment.pieces()) {
    const ptree* array = mesh::find_array(*piece.tree, "CellData", k_hidden_cells);
    const std::vector<double> values = array == nullptr ? std::vector<double>(piece.n_cells, 0.0)
                                                        : piece.file->numbers(*array, piece.n_cells);
    for (const double value : values) all.push_back(static_cast<std::uint8_t>(mesh::whole_number(value)));
  }
  return all;
}

std::vector<PvdCollection::Entry> body_moments(const fs::path& collection) {
  std::vector<PvdCollection::Entry> moments;
  const PvdCollection all(collection, std::numeric_limits<double>::infinity());
  for (const PvdCollection::Entry& entry : all.entries())
    if (entry.part == 0) moments.push_back(entry);
  if (moments.empty()) throw InputError({collection.string()}, "the run has left no fields");
  return moments;
}

void check_same_mesh(const FieldMoment& moment, std::size_t n_points, std::size_t n_cells,
                     const fs::path& file) {
  if (moment.n_points() != n_points || moment.n_cells() != n_cells)
    throw InputError({file.string()}, "the file has another mesh than the first of the run");
}

}  // namespace solidus::results
