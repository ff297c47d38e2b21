/// One temperature for a body, or a function that is evaluated at all of its nodes at once; a temperature
/// at a jump of the enthalpy counts as melt.
#include "setup/initial_temperature.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "cases/roles.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "setup/field_mapping.hpp"
#include "setup/filled_mould.hpp"
#include "setup/jet_input.hpp"
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

/// Weights of the closed rule at nodes of a body [m³]; those of ghosts are zero, since their owners count
/// them.
std::vector<double> owned_weights(const mesh::Mesh& mesh, const std::vector<Index>& nodes, int body,
                                  AnalysisKind kind) {
  const std::vector<double> all = closed_weights(mesh, body, kind);
  std::vector<double> weights(nodes.size(), 0.0);
  for (std::size_t k = 0; k < nodes.size(); ++k)
    if (nodes[k] < mesh.n_owned_nodes) weights[k] = all[as_size(nodes[k])];
  return weights;
}

}  // namespace

InitialTemperatures::InitialTemperatures(const cases::CaseSpec& spec,
                                         const std::vector<material::Material>& materials,
                                         const mesh::Mesh& mesh) {
  const bool filled = spec.filling && spec.filling->result;
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    // Given by place the temperature is evaluated at every node; a number is one value for the body, moved to
    // the jump of enthalpy where it lies next to one.
    const Function& given = spec.bodies[b].initial_temperature;
    if (filled && cases::is_poured(cases::role_of(spec.bodies[b], materials[b]))) {
      const PlaceSpec at_end = filled_temperature(*spec.filling, static_cast<int>(b));
      bodies_.push_back(evaluated(at_end, mesh, static_cast<int>(b), spec.analysis.kind, materials[b],
                                  spec.bodies[b].name));
      continue;
    }
    if (given.place != nullptr) {
      bodies_.push_back(evaluated(*given.place, mesh, static_cast<int>(b), spec.analysis.kind, materials[b],
                                  spec.bodies[b].name));
      continue;
    }
    const material::EnthalpyCurve curve = materials[b].enthalpy();
    Body& body = bodies_.emplace_back();
    body.temperature = snapped(temperature_in_die(spec, spec.bodies[b], materials[b]), curve);
    body.enthalpy = curve.upper(body.temperature);
    body.range = {body.temperature, body.temperature};
  }
  if (filled) heat_moulds(spec, materials, mesh);
}

void InitialTemperatures::heat_moulds(const cases::CaseSpec& spec,
                                      const std::vector<material::Material>& materials,
                                      const mesh::Mesh& mesh) {
  std::vector<FilledWall> all;
  run_collectively([&] { all = read_filled_walls(*spec.filling, spec.bodies.size()); });
  // No mould gets hotter than the metal that heats it.
  double hottest = 0;
  for (std::size_t b = 0; b < bodies_.size(); ++b)
    if (cases::is_poured(cases::role_of(spec.bodies[b], materials[b])))
      hottest = std::max(hottest, bodies_[b].range.high);
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    std::vector<FilledWall> walls;
    std::ranges::copy_if(all, std::back_inserter(walls),
                         [b](const FilledWall& wall) { return wall.body == static_cast<int>(b); });
    if (walls.empty()) continue;
    // A body of one temperature gets values at its nodes first.
    const std::vector<Index> nodes = nodes_of(mesh, static_cast<int>(b));
    const std::vector<double> weights = owned_weights(mesh, nodes, static_cast<int>(b), spec.analysis.kind);
    std::vector<double> enthalpies;
    for (const Index node : nodes) enthalpies.push_back(enthalpy(node, static_cast<int>(b)));
    const material::EnthalpyCurve curve = materials[b].enthalpy();
    double diffusivity = 0;
    if (!nodes.empty()) {
      const double start = temperature(nodes.front(), static_cast<int>(b));
      diffusivity = materials[b].conductivity.value(start) / curve.capacity(start);
    }
    add_heat_of_walls(walls, mesh, nodes, weights, parallel::global_max(diffusivity), curve.upper(hottest),
                      enthalpies);
    bodies_[b] = at_nodes(mesh, nodes, enthalpies, curve);
    double heat = 0;
    for (const FilledWall& wall : walls) heat += wall.heat;
    logging::info(
        "body '{}': {:.6g} J from the metal while the mould filled; it is {:.1f} to {:.1f} degC hot",
        spec.bodies[b].name, heat, bodies_[b].range.low - 273.15, bodies_[b].range.high - 273.15);
  }
}

InitialTemperatures::Body InitialTemperatures::at_nodes(const mesh::Mesh& mesh, std::span<const Index> nodes,
                                                        std::span<const double> enthalpies,
                                                        const material::EnthalpyCurve& curve) {
  Body body;
  // Nodes of other bodies have no value.
  body.temperatures.assign(mesh.x.size(), std::numeric_limits<double>::quiet_NaN());
  body.enthalpies = body.temperatures;
  body.range = {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const auto node = as_size(nodes[k]);
    body.temperatures[node] = curve.temperature(enthalpies[k]);
    body.enthalpies[node] = enthalpies[k];
    body.range.low = std::min(body.range.low, body.temperatures[node]);
    body.range.high = std::max(body.range.high, body.temperatures[node]);
  }
  body.range = {parallel::global_min(body.range.low), parallel::global_max(body.range.high)};
  return body;
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
  // The temperatures of a body at the start are those of a field of another run, or of a number or formula.
  const material::EnthalpyCurve curve = material.enthalpy();
  const std::vector<Index> nodes = nodes_of(mesh, number);
  // A field keeps its enthalpy per volume: it is mapped with the weights of the owned nodes, and the
  // temperatures follow from it.
  if (place.kind == PlaceSpec::Kind::field) {
    const std::vector<double> weights = owned_weights(mesh, nodes, number, kind);
    MappedEnthalpy mapped = map_enthalpy(place, kind, curve, mesh, nodes, weights);
    tell_of_mapping(name, place, mapped);
    return at_nodes(mesh, nodes, mapped.values, curve);
  }
  std::vector<Position> x;
  for (const Index node : nodes) x.push_back(mesh.x[as_size(node)]);
  std::vector<double> temperatures(nodes.size()), enthalpies;
  run_collectively([&] { place_law(place, kind)->values(x, 0, temperatures); });
  // A given temperature that rounding puts off a change at one temperature is taken for it; the melt
  // then holds all of its latent heat.
  for (double& t : temperatures) enthalpies.push_back(curve.upper(t = snapped(t, curve)));
  Body body = at_nodes(mesh, nodes, enthalpies, curve);
  // The temperatures themselves are kept, which the way over the enthalpy would round.
  for (std::size_t k = 0; k < nodes.size(); ++k) body.temperatures[as_size(nodes[k])] = temperatures[k];
  const auto [low, high] = std::ranges::minmax_element(temperatures);
  body.range = {
      parallel::global_min(temperatures.empty() ? std::numeric_limits<double>::infinity() : *low),
      parallel::global_max(temperatures.empty() ? -std::numeric_limits<double>::infinity() : *high)};
  return body;
}

double InitialTemperatures::temperature(Index node, int body) const {
  const Body& b = bodies_[as_size(body)];
  return b.temperatures.empty() ? b.temperature : b.temperatures[as_size(node)];
}

double InitialTemperatures::enthalpy(Index node, int body) const {
  const Body& b = bodies_[as_size(body)];
  return b.enthalpies.empty() ? b.enthalpy : b.enthalpies[as_size(node)];
}

std::vector<InitialTemperatureRange> InitialTemperatures::ranges() const {
  std::vector<InitialTemperatureRange> all;
  for (const Body& body : bodies_) all.push_back(body.range);
  return all;
}

}  // namespace solidus::setup
