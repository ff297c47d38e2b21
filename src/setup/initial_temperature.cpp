/// One temperature for a body, or a function that is evaluated at all of its nodes at once; a temperature
/// at a jump of the enthalpy counts as melt.
#include "setup/initial_temperature.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "parallel/parallel.hpp"
#include "setup/field_mapping.hpp"
#include "setup/place_input.hpp"
#include "system/common_failure.hpp"
#include "system/log.hpp"

namespace solidus::setup {

namespace {

/// Temperatures this close to that of an isothermal change, as a share of it, are that temperature: degrees
/// Celsius and kelvin round differently.
constexpr double k_same_temperature = 1e-12;

/// At the very temperature of an isothermal change there is melt.
double snapped(double temperature, const material::EnthalpyCurve& curve) {
  for (const auto& jump : curve.jumps())
    if (std::abs(temperature - jump.temperature) <= k_same_temperature * jump.temperature)
      return jump.temperature;
  return temperature;
}

std::vector<Index> nodes_of(const mesh::Mesh& mesh, int body) {
  std::vector<Index> nodes;
  for (const mesh::ElementBlock& block : mesh.blocks)
    if (block.body == body) nodes.insert(nodes.end(), block.nodes.begin(), block.nodes.end());
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

}  // namespace

InitialTemperatures::InitialTemperatures(const cases::CaseSpec& spec,
                                         const std::vector<material::Material>& materials,
                                         const mesh::Mesh& mesh) {
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    // Given by place the temperature is evaluated at every node; a number is one value for the body, moved to
    // the jump of enthalpy where it lies next to one.
    const Function& given = spec.bodies[b].initial_temperature;
    if (given.place != nullptr) {
      bodies_.push_back(evaluated(*given.place, mesh, static_cast<int>(b), spec.analysis.kind, materials[b],
                                  spec.bodies[b].name));
      continue;
    }
    const material::EnthalpyCurve curve = materials[b].enthalpy();
    Body& body = bodies_.emplace_back();
    body.temperature = snapped(given.table.value(0), curve);
    body.enthalpy = curve.upper(body.temperature);
    body.range = {body.temperature, body.temperature};
  }
}

namespace {

/// Tells how well a field of another run fits a body.
void tell_of_mapping(const std::string& name, const PlaceSpec& place, const MappedEnthalpy& mapped) {
  constexpr double k_largest_share_outside = 0.05;
  // What lies outside of the other mesh, or has another volume, is told, since it may be the file of
  // another part or unit.
  if (mapped.outside > k_largest_share_outside)
    logging::warn(
        "body '{}': {:.0f} % of it lies outside of the grid of '{}', up to {:.3g} m away, and starts with "
        "the temperature of the nearest place; is the file of a mesh at another place, or in another unit "
        "(length_unit)?",
        name, 100 * mapped.outside, place.file, mapped.farthest);
  if (!mapped.kept)
    logging::warn(
        "body '{}': '{}' has a volume of {:.4g} m3, the body {:.4g} m3: its enthalpy is interpolated, not "
        "kept",
        name, place.file, mapped.source_volume, mapped.volume);
  else
    logging::info(
        "body '{}': temperatures of '{}' with its enthalpy per volume; the volumes agree to {:.1e}, to "
        "keep "
        "the enthalpy {:.1e} of the way to the {} was gone",
        name, place.file, std::abs(mapped.volume / mapped.source_volume - 1), std::abs(mapped.share),
        mapped.share < 0 ? "coldest" : "hottest");
}

}  // namespace

InitialTemperatures::Body InitialTemperatures::evaluated(const PlaceSpec& place, const mesh::Mesh& mesh,
                                                         int number, AnalysisKind kind,
                                                         const material::Material& material,
                                                         const std::string& name) const {
  Body body;
  // The temperatures of a body at the start are those of a field of another run, or of a number or formula.
  const material::EnthalpyCurve curve = material.enthalpy();
  const std::vector<Index> nodes = nodes_of(mesh, number);
  std::vector<double> temperatures(nodes.size()), enthalpies;
  // A field keeps its enthalpy per volume: it is mapped with the weights of the owned nodes, and the
  // temperatures follow from it.
  if (place.kind == PlaceSpec::Kind::field) {
    const std::vector<double> all = closed_weights(mesh, number, kind);
    std::vector<double> weights(nodes.size(), 0.0);
    for (std::size_t k = 0; k < nodes.size(); ++k)
      if (nodes[k] < mesh.n_owned_nodes) weights[k] = all[static_cast<std::size_t>(nodes[k])];
    MappedEnthalpy mapped = map_enthalpy(place, kind, curve, mesh, nodes, weights);
    tell_of_mapping(name, place, mapped);
    enthalpies = std::move(mapped.values);
    for (std::size_t k = 0; k < nodes.size(); ++k) temperatures[k] = curve.temperature(enthalpies[k]);
  } else {
    std::vector<Position> x;
    for (const Index node : nodes) x.push_back(mesh.x[static_cast<std::size_t>(node)]);
    run_collectively([&] { place_law(place, kind)->values(x, 0, temperatures); });
    // A given temperature that rounding puts beside a change at one temperature is taken for it; the melt
    // then holds all of its latent heat.
    for (double& t : temperatures) enthalpies.push_back(curve.upper(t = snapped(t, curve)));
  }
  // Nodes of other bodies have no value.
  body.temperatures.assign(mesh.x.size(), std::numeric_limits<double>::quiet_NaN());
  body.enthalpies = body.temperatures;
  body.range = {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const auto node = static_cast<std::size_t>(nodes[k]);
    body.temperatures[node] = temperatures[k];
    body.enthalpies[node] = enthalpies[k];
    body.range.low = std::min(body.range.low, temperatures[k]);
    body.range.high = std::max(body.range.high, temperatures[k]);
  }
  body.range = {parallel::global_min(body.range.low), parallel::global_max(body.range.high)};
  return body;
}

double InitialTemperatures::temperature(Index node, int body) const {
  const Body& b = bodies_[static_cast<std::size_t>(body)];
  return b.temperatures.empty() ? b.temperature : b.temperatures[static_cast<std::size_t>(node)];
}

double InitialTemperatures::enthalpy(Index node, int body) const {
  const Body& b = bodies_[static_cast<std::size_t>(body)];
  return b.enthalpies.empty() ? b.enthalpy : b.enthalpies[static_cast<std::size_t>(node)];
}

std::vector<InitialTemperatureRange> InitialTemperatures::ranges() const {
  std::vector<InitialTemperatureRange> all;
  for (const Body& body : bodies_) all.push_back(body.range);
  return all;
}

}  // namespace solidus::setup
