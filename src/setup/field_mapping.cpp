/// The field of the source is mapped as enthalpy, with the weights of the closed rule, so that no heat is
/// lost or gained.
#include "setup/field_mapping.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "mesh/block_geometry.hpp"
#include "mesh/element_search.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "results/formats/field_reader.hpp"
#include "system/common_failure.hpp"
#include "system/log.hpp"

namespace solidus::setup {

namespace {

constexpr double k_same_shape = 0.01;   // of the volumes
constexpr double k_far_outside = 0.02;  // of the diagonal of the file's grid
constexpr double k_on_plateau = 1e-9;   // of the temperature of an isothermal change

/// The file's field, as enthalpy at its points.
struct Source {
  mesh::Mesh mesh;
  std::vector<double> enthalpy;  // [J/m³]
  double volume = 0, total = 0;  // [m³], [J]
  double low = 0, high = 0;      // enthalpies that its cells have
};

/// The solid fraction of the file where a material changes isothermally: the temperature does not tell it.
/// Of the file's points, and of its cells where it has values of cells.
results::ReadField solid_fractions(const PlaceSpec& place, const material::EnthalpyCurve& curve) {
  if (curve.jumps().empty()) return {};
  try {
    return results::read_field(place.file, "solid_fraction", place.body, place.length, place.where);
  } catch (const InputError&) {
    logging::warn(
        "'{}' has no field solid_fraction: what is at the temperature of an isothermal change counts as "
        "molten",
        place.file);
    return {};
  }
}

/// The diagonal of the box around a mesh [m].
double diagonal(const mesh::Mesh& mesh) {
  double sum = 0;
  for (std::size_t d = 0; d < 3; ++d) {
    const auto [low, high] =
        std::ranges::minmax_element(mesh.x, {}, [d](const mesh::Point& x) { return x[d]; });
    sum += ((*high)[d] - (*low)[d]) * ((*high)[d] - (*low)[d]);
  }
  return std::sqrt(sum);
}

double enthalpy(const material::EnthalpyCurve& curve, double temperature, double solid_fraction) {
  for (const auto& jump : curve.jumps())
    if (std::abs(temperature - jump.temperature) <= k_on_plateau * jump.temperature)
      return curve.lower(jump.temperature) + (1 - std::clamp(solid_fraction, 0.0, 1.0)) * jump.height;
  return curve.upper(temperature);
}

Source read_source(const PlaceSpec& place, AnalysisKind kind, const material::EnthalpyCurve& curve) {
  // The field of the file with the mesh it lives on, which must have the dimension of the analysis.
  results::ReadField field =
      results::read_field(place.file, place.column, place.body, place.length, place.where);
  if (field.mesh.dimension != (kind == AnalysisKind::solid ? 3 : 2))
    throw InputError(place.where, fmt::format("'{}' has {} dimensions, the analysis {}", place.file,
                                              field.mesh.dimension, kind == AnalysisKind::solid ? 3 : 2));
  // The unit of the case goes before that of the file.
  units::Conversion to_kelvin = place.unit;
  if (!place.unit_given && !field.unit.empty()) {
    try {
      to_kelvin = units::conversion(field.unit, "K");
    } catch (const std::invalid_argument& error) {
      throw InputError(place.where, fmt::format("the field '{}': {}", place.column, error.what()));
    }
  }
  // Cell values come along where the file had its field on cells.
  const std::vector<double> cell_values = std::move(field.cell_values),
                            cell_volumes = std::move(field.cell_volumes);
  Source source{std::move(field.mesh), std::move(field.values)};
  const results::ReadField solid = solid_fractions(place, curve);
  const std::vector<double>& fractions = solid.values;
  // Temperatures become enthalpies per volume, with the solid fraction of the file where there is one; volume
  // and content of the field follow by its closed weights.
  const std::vector<double> weight = closed_weights(source.mesh, 0, kind);
  source.low = std::numeric_limits<double>::infinity();
  source.high = -source.low;
  // Bounds, volume and content are summed in one sweep.
  for (std::size_t i = 0; i < weight.size(); ++i) {
    if (weight[i] == 0) continue;  // a point of no cell
    const double temperature = to_kelvin(source.enthalpy[i]);
    if (!(temperature > 0))
      throw InputError(
          place.where,
          fmt::format("the field '{}' is {:g} K at a point of '{}'", place.column, temperature, place.file),
          "temperatures above 0 K; say the field's unit: unit = \"degC\"");
    const double h = enthalpy(curve, temperature, fractions.empty() ? 0.0 : fractions[i]);
    source.enthalpy[i] = h;
    source.low = std::min(source.low, h);
    source.high = std::max(source.high, h);
    source.volume += weight[i];
    source.total += weight[i] * h;
  }
  if (cell_values.empty()) return source;
  // Values of cells: the heat of the file is theirs, whatever is interpolated between them.
  source.volume = source.total = 0;
  for (std::size_t c = 0; c < cell_values.size(); ++c) {
    source.volume += cell_volumes[c];
    source.total += cell_volumes[c] * enthalpy(curve, to_kelvin(cell_values[c]),
                                               solid.cell_values.empty() ? 0.0 : solid.cell_values[c]);
  }
  return source;
}

}  // namespace

std::vector<double> closed_weights(const mesh::Mesh& mesh, int body, AnalysisKind kind) {
  std::vector<double> weight(mesh.x.size(), 0.0);
  for (const mesh::ElementBlock& block : mesh.blocks) {
    if (block.body != body) continue;
    const PackVector<Lane> weights = mesh::nodal_weights(mesh, block, kind);
    const int n = mesh::node_count(block.shape);
    for (Index e = 0; e < block.size(); ++e)
      for (int a = 0; a < n; ++a)
        // A file may number the corners of its cells the other way round.
        weight[as_size(block.element(e)[a])] += std::abs(weights[as_size(e / k_lanes * n + a)][e % k_lanes]);
  }
  return weight;
}

MappedEnthalpy map_enthalpy(const PlaceSpec& place, AnalysisKind kind, const material::EnthalpyCurve& curve,
                            const mesh::Mesh& mesh, std::span<const Index> nodes,
                            std::span<const double> weights) {
  MappedEnthalpy mapped;
  mapped.values.resize(nodes.size());
  Source source;
  // Every node takes the field where it lies, or at the nearest place within.
  run_collectively([&] {
    source = read_source(place, kind, curve);
    const mesh::ElementSearch search(source.mesh);
    const double far = k_far_outside * diagonal(source.mesh);
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      // An element that holds the node, or the nearest one to it.
      const mesh::Point& x = mesh.x[as_size(nodes[k])];
      const auto found = search.find(x);
      if (place.outside_is_error && found.distance > 1e-6 * std::hypot(x[0], x[1], x[2]))
        throw InputError(place.where,
                         fmt::format("the node at ({:g}, {:g}, {:g}) m lies {:.3g} m outside of '{}'", x[0],
                                     x[1], x[2], found.distance, place.file),
                         "outside = \"nearest\", or a field that reaches further");
      mapped.farthest = std::max(mapped.farthest, found.distance);
      if (found.distance > far) mapped.outside += weights[k];
      // Basis functions of quadratic cells may leave the values of their points.
      mapped.values[k] = std::clamp(found.share(source.enthalpy), source.low, source.high);
    }
  });
  // Content, and how far values could still move to the highest and lowest of the field.
  double volume = 0, total = 0, above = 0, below = 0;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    volume += weights[k];
    total += weights[k] * mapped.values[k];
    above += weights[k] * (source.high - mapped.values[k]);
    below += weights[k] * (mapped.values[k] - source.low);
  }
  mapped.source_volume = source.volume;
  mapped.volume = volume = parallel::global_sum(volume);
  mapped.outside = parallel::global_sum(mapped.outside) / volume;
  mapped.farthest = parallel::global_max(mapped.farthest);
  total = parallel::global_sum(total);
  above = parallel::global_sum(above);
  below = parallel::global_sum(below);
  // Only between bodies of the same volume can the heat be kept.
  mapped.kept = std::abs(volume - source.volume) <= k_same_shape * source.volume;
  if (!mapped.kept) return mapped;
  // Mapping loses or gains a little heat. The difference is shared out in proportion to the way of each value
  // to the highest or lowest one, so that no new extremes arise.
  const double missing = source.total / source.volume * volume - total;
  const double room = missing > 0 ? above : below;
  if (missing == 0 || !(room > 0)) return mapped;
  // The share of its way that every value goes.
  mapped.share = std::clamp(missing / room, -1.0, 1.0);
  const double toward = missing > 0 ? source.high : source.low;
  for (double& h : mapped.values) h += std::abs(mapped.share) * (toward - h);
  return mapped;
}

}  // namespace solidus::setup
