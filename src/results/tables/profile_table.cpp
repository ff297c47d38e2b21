/// Nodes are put in order along the group once; each moment adds their values.
#include "results/tables/profile_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "results/output/output_error.hpp"
#include "results/output/output_file.hpp"
#include "system/processes.hpp"

namespace solidus::results {

namespace {

units::Conversion shown_in(const std::string& unit, const std::string& si, const std::string& what,
                           const SourceLocation& where) {
  if (!units::compatible(unit, si))
    throw InputError(where, fmt::format("{}: the unit '{}' does not fit", what, unit),
                     fmt::format("it measures {}, for example in '{}'", units::dimension_name(si), si));
  return units::conversion(si, unit, units::Temperature::absolute);
}

/// @param values  of the field
double component_at(const Field& field, std::span<const double> values, Index node, int component) {
  const auto n = as_size(field.components);
  const double* v = values.data() + as_size(node) * n;
  if (component != k_magnitude) return v[component];
  return std::sqrt(std::inner_product(v, v + n, v, 0.0));
}

}  // namespace

ProfileTable::ProfileTable(const mesh::Mesh& mesh, AnalysisKind kind, Profile profile, const FieldSet& fields)
    : mesh_(mesh), profile_(std::move(profile)), dimension_(kind == AnalysisKind::solid ? 3 : 2) {
  const std::string what = fmt::format("profile '{}'", profile_.name);
  const auto group = mesh.node_sets.find(profile_.group);
  if (group == mesh.node_sets.end()) {
    std::string known;
    for (const auto& [name, nodes] : mesh.node_sets) known += (known.empty() ? "" : ", ") + name;
    throw InputError(profile_.where, fmt::format("{}: there is no group '{}'", what, profile_.group),
                     "groups: " + known);
  }
  // Each process has the own nodes of the group; the first one writes all of them.
  for (const Index node : group->second)
    if (node < mesh.n_owned_nodes) nodes_.push_back(node);
  if (!parallel::any_process(!nodes_.empty()))
    throw InputError(profile_.where, fmt::format("{}: the group '{}' is empty", what, profile_.group));
  length_ = shown_in(profile_.length_unit, "m", what, profile_.where);
  for (const Sampled& column : profile_.columns) {
    const Field* field = fields.find(column.field);
    if (field == nullptr || field->place != mesh::FieldPlace::node) {
      std::string known;
      for (const Field& f : fields.all())
        if (f.place == mesh::FieldPlace::node) known += (known.empty() ? "" : ", ") + f.name;
      throw InputError(column.where, fmt::format("{}: there is no field '{}' at nodes", what, column.field),
                       "fields: " + known);
    }
    shown_.push_back(shown_in(column.column.unit, field->unit, what, column.where));
  }
}

std::vector<CsvColumn> ProfileTable::columns() const {
  std::vector<CsvColumn> all;
  for (int i = 0; i < dimension_; ++i) all.push_back({std::string(1, "xyz"[i]), profile_.length_unit});
  for (const Sampled& column : profile_.columns) all.push_back(column.column);
  return all;
}

std::vector<double> ProfileTable::gather(const FieldSet& fields) const {
  std::vector<double> mine;
  std::vector<const Field*> of_column;
  std::vector<std::vector<double>> storage(shown_.size());
  // Coordinates first and then the columns of each own node.
  std::vector<std::span<const double>> values;
  for (std::size_t c = 0; c < shown_.size(); ++c) {
    of_column.push_back(fields.find(profile_.columns[c].field));
    values.push_back(of_column[c]->read(storage[c]));
  }
  for (const Index node : nodes_) {
    for (int i = 0; i < dimension_; ++i) mine.push_back(length_(mesh_.x[as_size(node)][as_size(i)]));
    for (std::size_t c = 0; c < shown_.size(); ++c)
      mine.push_back(shown_[c](component_at(*of_column[c], values[c], node, profile_.columns[c].component)));
  }
  return processes::gather_on_first(mine);
}

void ProfileTable::write(const std::filesystem::path& folder, const FieldSet& fields) const {
  const std::vector<double> values = gather(fields);
  on_first_process([&] {
    const std::vector<CsvColumn> header = columns();
    const auto width = static_cast<std::ptrdiff_t>(header.size());
    using Row = std::vector<double>;
    std::vector<Row> rows;
    for (auto row = values.begin(); row != values.end(); row += width) rows.emplace_back(row, row + width);
    std::sort(rows.begin(), rows.end());  // coordinates come first
    std::string text;
    const auto add_line = [&text](std::size_t n, const auto& cell) {
      for (std::size_t i = 0; i < n; ++i) text += (i == 0 ? "" : ",") + cell(i);
      text += "\n";
    };
    add_line(header.size(), [&](std::size_t i) { return csv_text(header[i].header()); });
    for (const Row& row : rows)
      add_line(row.size(), [&](std::size_t i) {
        if (!std::isfinite(row[i])) throw NotFiniteError("column '" + header[i].header() + "'", {});
        return number_text(row[i]);
      });
    write_file(folder / file_name(), text);
  });
}

}  // namespace solidus::results
