/// Fractions and heats of a state are sums over the nodes, or over the points of bodies that store there.
#include "heat/thermal_states.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "heat/thermal_parts.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"

namespace solidus::heat {

double heat_at(const NodalEnthalpy& storage, const ThermalState& state, Index node) {
  return state.enthalpy.empty() ? storage.upper(node, state.temperature[as_size(node)])
                                : state.enthalpy[as_size(node)];
}

ThermalState ThermalStates::initial(std::span<const double> body_temperature) const {
  assert(body_temperature.size() == parts_.mesh.bodies.size());
  // The enthalpy of a body at its initial temperature is the same at all of its nodes.
  std::vector<double> enthalpy;
  for (std::size_t b = 0; b < body_temperature.size(); ++b)
    enthalpy.push_back(parts_.storage->body_enthalpy(static_cast<int>(b), body_temperature[b]));
  return initial_of([&](Index, int body) { return enthalpy[as_size(body)]; });
}

ThermalState ThermalStates::initial_of(const std::function<double(Index, int)>& enthalpy) const {
  ThermalState state;
  state.temperature.resize(parts_.mesh.x.size());
  state.enthalpy.resize(parts_.mesh.x.size());
  for (Index i = 0; i < parts_.mesh.n_owned_nodes; ++i) {
    // A node between bodies gets the heat of each of them; its temperature is that of the mixture.
    state.enthalpy[as_size(i)] =
        parts_.storage->sum_of_bodies(i, [&](int body) { return enthalpy(i, body); });
    // A node at which nothing has grown yet has no heat, and a temperature that nothing reads.
    const bool bare = parts_.storage->sum_of_bodies(i, [](int) { return 1.0; }) == 0;
    state.temperature[as_size(i)] =
        bare ? k_counted_from : parts_.storage->temperature(i, state.enthalpy[as_size(i)]);
  }
  parts_.ghosts.update(state.temperature, 1);
  parts_.ghosts.update(state.enthalpy, 1);
  // Where heat is stored at Gauss points the state is the temperature alone.
  if (!parts_.nodal()) state.enthalpy.clear();
  return state;
}

ThermalState ThermalStates::initial_at_nodes(std::span<const double> temperature) const {
  ThermalState state{{temperature.begin(), temperature.end()}, {}};
  if (!parts_.nodal()) return state;
  state.enthalpy.resize(parts_.mesh.x.size());
  for (Index i = 0; i < parts_.mesh.n_owned_nodes; ++i)
    state.enthalpy[as_size(i)] = parts_.storage->upper(i, temperature[as_size(i)]);
  parts_.ghosts.update(state.enthalpy, 1);
  return state;
}

double ThermalStates::heat_content(const ThermalState& state) const {
  double content = 0;
  for (Index i = 0; i < parts_.mesh.n_owned_nodes; ++i)
    content += heat_at(*parts_.storage, state, i) - parts_.storage->upper(i, k_counted_from);
  return parallel::global_sum(content);
}

std::vector<double> ThermalStates::plateau_share(const ThermalState& state) const {
  // The share says how far a node has gone through a change of phase at constant temperature.
  if (!parts_.storage->has_plateaus()) return {};
  std::vector<double> share(parts_.mesh.x.size());
  for (Index i = 0; i < parts_.mesh.n_owned_nodes; ++i)
    share[as_size(i)] =
        parts_.storage->plateau_share(i, heat_at(*parts_.storage, state, i), state.temperature[as_size(i)]);
  parts_.ghosts.update(share, 1);
  return share;
}

std::vector<double> ThermalStates::solid_fraction(const ThermalState& state) const {
  std::vector<double> fraction(parts_.mesh.x.size());
  for (Index i = 0; i < parts_.mesh.n_owned_nodes; ++i)
    fraction[as_size(i)] =
        parts_.storage->solid_fraction(i, heat_at(*parts_.storage, state, i), state.temperature[as_size(i)]);
  parts_.ghosts.update(fraction, 1);
  return fraction;
}

/// The mean over the volume of one body, by the volumes that its nodes have of it.
double ThermalStates::mean_solid_fraction(const ThermalState& state, int body) const {
  double solid = 0, volume = 0;
  for (Index i = 0; i < parts_.mesh.n_owned_nodes; ++i) {
    volume += parts_.storage->volume(i, body);
    solid += parts_.storage->solid_volume(i, body, heat_at(*parts_.storage, state, i),
                                          state.temperature[as_size(i)]);
  }
  return parallel::global_sum(solid) / parallel::global_sum(volume);
}

double ThermalStates::mean_solid_fraction(const ThermalState& state) const {
  // Volumes of bodies that can melt, by their nodal shares.
  double solid = 0, volume = 0;
  for (std::size_t b = 0; b < parts_.materials.size(); ++b) {
    const auto body = static_cast<int>(b);
    if (!parts_.storage->can_melt(body)) continue;
    for (Index i = 0; i < parts_.mesh.n_owned_nodes; ++i) {
      volume += parts_.storage->volume(i, body);
      solid += parts_.storage->solid_volume(i, body, heat_at(*parts_.storage, state, i),
                                            state.temperature[as_size(i)]);
    }
  }
  volume = parallel::global_sum(volume);
  solid = parallel::global_sum(solid);
  return volume > 0 ? solid / volume : 1.0;
}

EntropyChange ThermalStates::entropy_change(const ThermalState& from, const ThermalState& to) const {
  // The entropy of a step is summed over points or nodes, with the size of its parts as a scale of rounding.
  EntropyChange sum;
  const auto add = [&sum](const EntropyChange& part) {
    sum.change += part.change;
    sum.magnitude += part.magnitude;
    sum.behind += part.behind;
  };
  if (!parts_.nodal()) {
    for (const auto& block : parts_.points) add(block->entropy_change(from.temperature, to.temperature));
  } else {
    if (parts_.consistent) add(parts_.consistent->surplus().entropy_change(from.temperature, to.temperature));
    for (Index i = 0; i < parts_.mesh.n_owned_nodes; ++i) {
      const double heat = from.enthalpy[as_size(i)], temperature = from.temperature[as_size(i)];
      const double before = parts_.storage->entropy(i, heat, temperature);
      const double after = parts_.storage->entropy(i, to.enthalpy[as_size(i)], to.temperature[as_size(i)]);
      // The difference between heat and temperature of a node that the iteration has left counts as `behind`.
      const double behind = std::max(
          {0.0, parts_.storage->lower(i, temperature) - heat, heat - parts_.storage->upper(i, temperature)});
      add({after - before, std::abs(before), behind / temperature});
    }
  }
  return {parallel::global_sum(sum.change), parallel::global_sum(sum.magnitude),
          parallel::global_sum(sum.behind)};
}

/// The heat that is stored in all bodies, at nodes or at Gauss points; the consistent rule adds the part in
/// which it differs from nodal storage.
double ThermalStates::enthalpy(const ThermalState& state) const {
  double sum = 0;
  if (!parts_.nodal()) {
    for (const auto& block : parts_.points) sum += block->enthalpy(state.temperature);
  } else {
    for (Index i = 0; i < parts_.mesh.n_owned_nodes; ++i) sum += state.enthalpy[as_size(i)];
    if (parts_.consistent) sum += parts_.consistent->surplus().enthalpy(state.temperature);
  }
  return parallel::global_sum(sum);
}

double ThermalStates::mean_temperature(const ThermalState& state, int body) const {
  double sum = 0, volume = 0;
  for (Index i = 0; i < parts_.mesh.n_owned_nodes; ++i) {
    const double v = parts_.storage->volume(i, body);
    volume += v;
    sum += v * state.temperature[as_size(i)];
  }
  return parallel::global_sum(sum) / parallel::global_sum(volume);
}

}  // namespace solidus::heat
