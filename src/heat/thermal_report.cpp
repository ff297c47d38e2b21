/// Measures of the thermal phase: the heat balance of a step; fractions, entropy and heat of a state.
#include <cmath>

#include "heat/iteration/heat_system.hpp"
#include "heat/iteration/temperature_system.hpp"
#include "heat/iteration/truncated_newton.hpp"
#include "heat/storage/consistent_heat.hpp"
#include "heat/storage/nodal_enthalpy.hpp"
#include "heat/storage/point_storage.hpp"
#include "heat/storage/printed_heat.hpp"
#include "heat/thermal_phase.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"

namespace solidus::heat {

namespace {}  // namespace

HeatBalance ThermalPhase::balance(const ThermalState& old, const ThermalState& next,
                                  std::span<const double> residual, double moved, double dt) const {
  HeatBalance balance = measure(next.temperature, residual, dt);
  double stored = 0;
  // Stored is the difference of the nodal enthalpies, or that at points, and what consistent heat adds.
  if (nodal()) {
    for (std::size_t i = 0; i < as_size(mesh_.n_owned_nodes); ++i)
      stored += next.enthalpy[i] - old.enthalpy[i];
    if (consistent_) stored += consistent_->surplus().stored(next.temperature);
  } else {
    for (const auto& block : points_) stored += block->stored(next.temperature);
  }
  balance.stored = parallel::global_sum(stored);
  // `moved` is a power: heat that went from one place to another in the step.
  balance.exchanged = moved * dt;
  return balance;
}

/// Splits the stored heat.
void ThermalPhase::set_latent(HeatBalance& balance, const ThermalState& old, const ThermalState& next) const {
  double latent = 0;
  if (!nodal()) {
    for (const auto& block : points_) latent += block->latent(old.temperature, next.temperature);
  } else {
    if (consistent_) latent += consistent_->surplus().latent(old.temperature, next.temperature);
    for (Index i = 0; i < mesh_.n_owned_nodes; ++i)
      latent += storage_->latent(i, next.enthalpy[as_size(i)], next.temperature[as_size(i)]) -
                storage_->latent(i, old.enthalpy[as_size(i)], old.temperature[as_size(i)]);
  }
  balance.latent = parallel::global_sum(latent);
  balance.sensible = balance.stored - balance.latent;
}

HeatBalance ThermalPhase::measure(std::span<const double> temperature, std::span<const double> residual,
                                  double dt) const {
  HeatBalance balance;
  // Reactions are heat at prescribed temperatures; each kind of condition is listed with its heat.
  std::vector<double> reactions(residual.size());  // where the temperature is prescribed
  for (std::size_t i = 0; i < reactions.size(); ++i)
    reactions[i] = system_->parts().prescribed.fixed()[i] ? residual[i] : 0.0;
  // Entropy comes in with the heat at its temperature, q/Θ; reactions are heat at a prescribed
  // temperature.
  double entropy = system_->entropy_power(temperature);
  for (std::size_t i = 0; i < reactions.size(); ++i) entropy += reactions[i] / temperature[i];
  balance.entropy_in = parallel::global_sum(entropy) * dt;
  for (const auto& [name, power] : system_->parts().prescribed.reaction_powers(reactions))
    balance.conditions.push_back({name, power * dt});
  for (const std::vector<NamedPower>& powers :
       {system_->parts().surfaces.powers(), system_->parts().channels.powers(),
        system_->parts().sources.powers()})
    for (const auto& [name, power] : powers) balance.conditions.push_back({name, power * dt});
  for (double power : system_->parts().contributions.powers()) balance.contributions.push_back(power * dt);
  if (consistent_) balance.contributions.pop_back();  // no heat, but stored in another place
  if (printed_) balance.contributions.pop_back();     // no heat, but what a printed form loses
  return balance;
}

std::vector<ChannelReading> ThermalPhase::channel_readings(double dt) const {
  std::vector<ChannelReading> readings = system_->parts().channels.readings();
  for (ChannelReading& reading : readings) reading.heat *= dt;
  return readings;
}

double ThermalPhase::heat_at(const ThermalState& state, Index node) const {
  return state.enthalpy.empty() ? storage_->upper(node, state.temperature[as_size(node)])
                                : state.enthalpy[as_size(node)];
}

std::vector<double> ThermalPhase::plateau_share(const ThermalState& state) const {
  if (!storage_->has_plateaus()) return {};
  std::vector<double> share(mesh_.x.size());
  for (Index i = 0; i < mesh_.n_owned_nodes; ++i)
    share[as_size(i)] = storage_->plateau_share(i, heat_at(state, i), state.temperature[as_size(i)]);
  ghosts_.update(share, 1);
  return share;
}

std::vector<double> ThermalPhase::solid_fraction(const ThermalState& state) const {
  std::vector<double> fraction(mesh_.x.size());
  for (Index i = 0; i < mesh_.n_owned_nodes; ++i)
    fraction[as_size(i)] = storage_->solid_fraction(i, heat_at(state, i), state.temperature[as_size(i)]);
  ghosts_.update(fraction, 1);
  return fraction;
}

double ThermalPhase::mean_solid_fraction(const ThermalState& state, int body) const {
  double solid = 0, volume = 0;
  for (Index i = 0; i < mesh_.n_owned_nodes; ++i) {
    volume += storage_->volume(i, body);
    solid += storage_->solid_volume(i, body, heat_at(state, i), state.temperature[as_size(i)]);
  }
  return parallel::global_sum(solid) / parallel::global_sum(volume);
}

double ThermalPhase::mean_solid_fraction(const ThermalState& state) const {
  // Volumes of bodies that can melt, by their nodal shares.
  double solid = 0, volume = 0;
  for (std::size_t b = 0; b < materials_.size(); ++b) {
    const auto body = static_cast<int>(b);
    if (!storage_->can_melt(body)) continue;
    for (Index i = 0; i < mesh_.n_owned_nodes; ++i) {
      volume += storage_->volume(i, body);
      solid += storage_->solid_volume(i, body, heat_at(state, i), state.temperature[as_size(i)]);
    }
  }
  volume = parallel::global_sum(volume);
  solid = parallel::global_sum(solid);
  return volume > 0 ? solid / volume : 1.0;
}

EntropyChange ThermalPhase::entropy_change(const ThermalState& from, const ThermalState& to) const {
  // The entropy of a step is summed over points or nodes, with the size of its parts as a scale of rounding.
  EntropyChange sum;
  const auto add = [&sum](const EntropyChange& part) {
    sum.change += part.change;
    sum.magnitude += part.magnitude;
    sum.behind += part.behind;
  };
  if (!nodal()) {
    for (const auto& block : points_) add(block->entropy_change(from.temperature, to.temperature));
  } else {
    if (consistent_) add(consistent_->surplus().entropy_change(from.temperature, to.temperature));
    for (Index i = 0; i < mesh_.n_owned_nodes; ++i) {
      const double heat = from.enthalpy[as_size(i)], temperature = from.temperature[as_size(i)];
      const double before = storage_->entropy(i, heat, temperature);
      const double after = storage_->entropy(i, to.enthalpy[as_size(i)], to.temperature[as_size(i)]);
      // What the iteration has left between heat and temperature of a node is counted as `behind`.
      const double behind =
          std::max({0.0, storage_->lower(i, temperature) - heat, heat - storage_->upper(i, temperature)});
      add({after - before, std::abs(before), behind / temperature});
    }
  }
  return {parallel::global_sum(sum.change), parallel::global_sum(sum.magnitude),
          parallel::global_sum(sum.behind)};
}

double ThermalPhase::enthalpy(const ThermalState& state) const {
  double sum = 0;
  if (!nodal()) {
    for (const auto& block : points_) sum += block->enthalpy(state.temperature);
  } else {
    for (Index i = 0; i < mesh_.n_owned_nodes; ++i) sum += state.enthalpy[as_size(i)];
    if (consistent_) sum += consistent_->surplus().enthalpy(state.temperature);
  }
  return parallel::global_sum(sum);
}

double ThermalPhase::mean_temperature(const ThermalState& state, int body) const {
  double sum = 0, volume = 0;
  for (Index i = 0; i < mesh_.n_owned_nodes; ++i) {
    const double v = storage_->volume(i, body);
    volume += v;
    sum += v * state.temperature[as_size(i)];
  }
  return parallel::global_sum(sum) / parallel::global_sum(volume);
}

}  // namespace solidus::heat
