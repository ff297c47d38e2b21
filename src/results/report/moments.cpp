/// Fields of a moment are brought to the nodes of each body and packed.
#include "results/report/moments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string_view>

#include "coupling/all_fields.hpp"
#include "mechanics/quantities.hpp"
#include "numbers/index_casts.hpp"
#include "system/errors.hpp"

namespace solidus::results {

using boost::property_tree::ptree;

namespace {

constexpr double k_none = std::numeric_limits<double>::quiet_NaN();

/// Arrays of a field file that are no fields: numbers of things.
constexpr std::array<std::string_view, 5> k_numbers = {"node", "element", "body", "process", "vtkGhostType"};

bool is_number_of_things(std::string_view name) {
  return std::find(k_numbers.begin(), k_numbers.end(), name) != k_numbers.end();
}

void add_columns(const FieldFile::Piece& piece, bool of_elements, const std::set<std::string>& contact_fields,
                 std::vector<FieldColumn>& columns) {
  // Each array of the file becomes a column, a vector three and the stress its largest principal value. What
  // a column means (kept at the end alone, without value below zero) is declared with the quantity.
  const char* section = of_elements ? "CellData" : "PointData";
  for (const std::string& name : mesh::array_names(*piece.tree, section)) {
    // Numbers of nodes and elements are no fields.
    if (is_number_of_things(name)) continue;
    const quantities::Quantity unknown{};
    const quantities::Quantity* const declared = coupling::find_field(name);
    const quantities::Quantity& quantity = declared != nullptr ? *declared : unknown;
    if (quantity.kept == quantities::Kept::none) continue;
    const ptree& array = *mesh::find_array(*piece.tree, section, name);
    FieldColumn column;
    column.field = column.name = name;
    // Vectors become three columns, the stress its largest principal value; other tensors are left
    // out.
    column.unit = mesh::array_unit(array);
    column.n_components = array.get<int>("<xmlattr>.NumberOfComponents", 1);
    column.of_elements = of_elements;
    column.at_end = quantity.kept == quantities::Kept::last;
    column.none_below_zero = quantity.no_value && *quantity.no_value < 0;
    column.none_at_zero = quantity.no_value && *quantity.no_value == 0;
    column.of_contact = contact_fields.contains(name);
    if (column.n_components == 1) {
      columns.push_back(column);
    } else if (column.n_components == 3) {
      for (column.index = 0; column.index < 3; ++column.index) {
        column.component = std::string(1, "xyz"[column.index]);
        columns.push_back(column);
      }
    } else if (column.n_components == 6 && declared == &mechanics::fields::k_stress) {
      column.name = mechanics::fields::k_first_principal_stress.name;
      column.principal = true;
      columns.push_back(column);
    }
  }
}

/// Values of one moment at the nodes.
class Reading {
 public:
  Reading(const Bodies& bodies, const std::set<std::int64_t>& contact_nodes)
      : bodies_(bodies.all()), contact_nodes_(contact_nodes) {}

  /// The nodes of each body that are there: those of cells that are not hidden, [body][node].
  std::vector<std::vector<bool>> present(const FieldFile& file, const std::vector<PieceMap>& maps) const {
    std::vector<std::vector<bool>> there;
    for (const BodyMesh& body : bodies_) there.emplace_back(body.x.size(), false);
    for (std::size_t p = 0; p < maps.size(); ++p) {
      const FieldFile::Piece& piece = file.pieces()[p];
      const ptree* array = mesh::find_array(*piece.tree, "CellData", "vtkGhostType");
      std::vector<double> ghost(piece.n_cells, 0.0);
      if (array != nullptr) ghost = piece.file->numbers(*array, piece.n_cells);
      for (std::size_t c = 0; c < piece.n_cells; ++c) {
        const PieceMap::Cell& cell = maps[p].cells[c];
        if (ghost[c] != 0 || cell.body < 0) continue;
        for (const std::int32_t node : cell.nodes) there[as_size(cell.body)][as_size(node)] = true;
      }
    }
    return there;
  }

  /// [body][node]; what is not a number has no value. A field that this file lacks has none anywhere.
  /// @param extremes  [body], of element fields
  std::vector<std::vector<float>> read(const FieldFile& file, const std::vector<PieceMap>& maps,
                                       const FieldColumn& column, std::vector<Extremes>& extremes) {
    // Sums and weights at the nodes: element values are averaged there by volume.
    std::vector<std::vector<double>> values, weight;
    for (const BodyMesh& body : bodies_) {
      values.emplace_back(body.x.size(), column.of_elements ? 0.0 : k_none);
      weight.emplace_back(column.of_elements ? body.x.size() : 0, 0.0);
    }
    extremes.assign(bodies_.size(), {});
    for (std::size_t p = 0; p < maps.size(); ++p)
      add(file.pieces()[p], maps[p], column, values, weight, extremes);
    // Means, as floats; where nothing was added there is no value.
    std::vector<std::vector<float>> out;
    for (std::size_t b = 0; b < values.size(); ++b) {
      out.emplace_back().reserve(values[b].size());
      for (std::size_t n = 0; n < values[b].size(); ++n) {
        const double mean = !column.of_elements ? values[b][n]
                            : weight[b][n] > 0  ? values[b][n] / weight[b][n]
                                                : k_none;
        out.back().push_back(static_cast<float>(mean));
      }
    }
    return out;
  }

 private:
  const std::vector<double>& array(const FieldFile::Piece& piece, const FieldColumn& column) {
    const char* section = column.of_elements ? "CellData" : "PointData";
    // Components of a vector come one after the other.
    if (kept_tree_ == piece.tree && kept_name_ == column.field) return kept_;
    const ptree* found = mesh::find_array(*piece.tree, section, column.field);
    const auto n = as_size(column.n_components);
    if (found != nullptr && found->get<std::size_t>("<xmlattr>.NumberOfComponents", 1) != n)
      piece.file->fail(fmt::format(
          "the field '{}' has another number of components than at the end of the run", column.field));
    kept_.clear();
    if (found != nullptr)
      kept_ = piece.file->numbers(*found, n * (column.of_elements ? piece.n_cells : piece.n_points));
    kept_tree_ = piece.tree;
    kept_name_ = column.field;
    return kept_;
  }

  void add(const FieldFile::Piece& piece, const PieceMap& map, const FieldColumn& column,
           std::vector<std::vector<double>>& values, std::vector<std::vector<double>>& weight,
           std::vector<Extremes>& extremes) {
    // Values of a moment are put at the nodes of the bodies. A marker for "no value" is turned into
    // not-a-number.
    const std::vector<double>& all = array(piece, column);
    if (all.empty()) return;
    const auto n = as_size(column.n_components);
    const auto at = [&](std::size_t i) {
      const double value =
          column.principal ? largest_principal(&all[n * i]) : all[n * i + as_size(column.index)];
      const bool nothing = (column.none_at_zero && value == 0) || (column.none_below_zero && value < 0);
      return nothing ? k_none : value;
    };
    // Fields of points go straight to their nodes; of contact fields those nodes alone count that are on a
    // surface.
    if (!column.of_elements) {
      for (const PieceMap::Target& target : map.targets) {
        const auto b = as_size(target.body), node = as_size(target.node);
        const bool silent = column.of_contact && !contact_nodes_.contains(bodies_[b].input_node[node]);
        values[b][node] = silent ? k_none : at(as_size(target.point));
      }
      return;
    }
    // Fields of elements are summed at their nodes with the volume of the element, and their extremes are
    // those of the elements.
    for (std::size_t c = 0; c < map.cells.size(); ++c) {
      const PieceMap::Cell& cell = map.cells[c];
      const double value = cell.body < 0 ? k_none : at(c);
      if (!std::isfinite(value)) continue;
      const auto b = as_size(cell.body);
      Extremes& e = extremes[b];
      if (!e.there || value < e.low) e.low = value, e.low_at = cell.centre;
      if (!e.there || value > e.high) e.high = value, e.high_at = cell.centre;
      e.there = true;
      for (const std::int32_t node : cell.nodes) {
        values[b][as_size(node)] += cell.weight * value;
        weight[b][as_size(node)] += cell.weight;
      }
    }
  }

  const std::vector<BodyMesh>& bodies_;
  const std::set<std::int64_t>& contact_nodes_;
  std::vector<double> kept_;
  const ptree* kept_tree_ = nullptr;
  std::string kept_name_;
};

/// Takes the values of nodes that are not there.
void leave_out(const std::vector<bool>& there, std::vector<float>& values) {
  for (std::size_t n = 0; n < values.size(); ++n)
    if (!there[n]) values[n] = std::numeric_limits<float>::quiet_NaN();
}

PackedValues pack(const std::vector<std::vector<float>>& moments, Blocks& blocks) {
  const Packed16 packed = pack16(moments);
  if (!packed.any) return {-2, -1, 0, 0};
  if (packed.uniform) return {-1, -1, packed.low, packed.high};
  return {blocks.add(packed.words, Bytes::noise),
          packed.mask.empty() ? -1 : blocks.add(packed.mask, Bytes::mask), packed.low, packed.high};
}

}  // namespace

double largest_principal(const double* t) {
  // The trigonometric solution for symmetric matrices (Smith, Comm. ACM 4 (1961) 168).
  const double mean = (t[0] + t[1] + t[2]) / 3;
  const double a = t[0] - mean, b = t[1] - mean, c = t[2] - mean;
  const double square = a * a + b * b + c * c + 2 * (t[3] * t[3] + t[4] * t[4] + t[5] * t[5]);
  if (square <= 0) return mean;
  const double p = std::sqrt(square / 6);
  const double determinant =
      a * (b * c - t[4] * t[4]) - t[3] * (t[3] * c - t[4] * t[5]) + t[5] * (t[3] * t[4] - b * t[5]);
  const double r = std::clamp(determinant / (2 * p * p * p), -1.0, 1.0);
  return mean + 2 * p * std::cos(std::acos(r) / 3);
}

std::vector<FieldColumn> field_columns(const FieldFile& file, const std::set<std::string>& contact_fields) {
  std::vector<FieldColumn> columns;
  if (file.pieces().empty()) return columns;
  for (const bool of_elements : {false, true})
    add_columns(file.pieces().front(), of_elements, contact_fields, columns);
  return columns;
}

PackedMoments pack_moments(Bodies& bodies, const std::vector<ReportMoment>& moments,
                           const std::vector<FieldColumn>& columns,
                           const std::set<std::int64_t>& contact_nodes, std::size_t most, Blocks& blocks) {
  PackedMoments packed;
  packed.columns = columns;
  const std::size_t n_bodies = bodies.all().size();
  Reading reading(bodies, contact_nodes);
  using OfColumn = std::vector<std::vector<std::vector<float>>>;  // [body][moment][node]
  std::vector<OfColumn> values(columns.size(), OfColumn(n_bodies));
  const auto read = [&](const ReportMoment& moment, bool last) {
    const FieldFile file(moment.file);
    const std::vector<PieceMap>& maps = bodies.maps(file);
    packed.moments.push_back(moment);
    // A body is there with its first node. Nodes that are not, where a body grows, have no value.
    const std::vector<std::vector<bool>> there = reading.present(file, maps);
    packed.present.emplace_back();
    for (const std::vector<bool>& of_body : there)
      packed.present.back().push_back(std::ranges::find(of_body, true) != of_body.end());
    auto& extremes = packed.extremes.emplace_back(columns.size());
    for (std::size_t k = 0; k < columns.size(); ++k) {
      if (columns[k].at_end && !last) continue;
      std::vector<std::vector<float>> of_bodies = reading.read(file, maps, columns[k], extremes[k]);
      for (std::size_t b = 0; b < n_bodies; ++b) {
        if (packed.present.back()[b] && !columns[k].at_end) leave_out(there[b], of_bodies[b]);
        values[k][b].push_back(std::move(of_bodies[b]));
      }
    }
  };
  // The size of the last moment tells how many there is room for.
  read(moments.back(), true);
  Blocks trial;
  for (std::size_t k = 0; k < columns.size(); ++k)
    for (std::size_t b = 0; b < n_bodies; ++b)
      if (!columns[k].at_end) pack(values[k][b], trial);
  const double each = std::max(1.0, static_cast<double>(trial.size()));
  const double room = std::max(0.0, static_cast<double>(most) - static_cast<double>(blocks.size()));
  // Every so many moments are kept as fit, and the last one.
  const auto n = static_cast<double>(moments.size());
  const auto stride = static_cast<std::size_t>(std::max(1.0, std::ceil(each * n / std::max(room, each))));
  packed = {};
  packed.columns = columns;
  values.assign(columns.size(), OfColumn(n_bodies));
  for (std::size_t m = 0; m + 1 < moments.size(); m += stride) read(moments[m], false);
  read(moments.back(), true);
  for (std::size_t k = 0; k < columns.size(); ++k) {
    std::vector<PackedValues>& row = packed.values.emplace_back();
    for (OfColumn::value_type& moments_of_body : values[k]) {
      row.push_back(pack(moments_of_body, blocks));
      OfColumn::value_type().swap(moments_of_body);
    }
  }
  return packed;
}

}  // namespace solidus::results
