/// Measures of the thermal phase: the heat balance of a step.
#include <cmath>

#include "heat/iteration/heat_exchange.hpp"
#include "heat/thermal_parts.hpp"
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
  if (parts_->nodal()) {
    for (std::size_t i = 0; i < as_size(parts_->mesh.n_owned_nodes); ++i)
      stored += next.enthalpy[i] - old.enthalpy[i];
    if (parts_->consistent) stored += parts_->consistent->surplus().stored(next.temperature);
  } else {
    for (const auto& block : parts_->points) stored += block->stored(next.temperature);
  }
  balance.stored = parallel::global_sum(stored);
  // `moved` is a power: heat that went from one place to another in the step.
  balance.exchanged = moved * dt;
  return balance;
}

/// Splits the stored heat.
void ThermalPhase::set_latent(HeatBalance& balance, const ThermalState& old, const ThermalState& next) const {
  double latent = 0;
  if (!parts_->nodal()) {
    for (const auto& block : parts_->points) latent += block->latent(old.temperature, next.temperature);
  } else {
    if (parts_->consistent) latent += parts_->consistent->surplus().latent(old.temperature, next.temperature);
    for (Index i = 0; i < parts_->mesh.n_owned_nodes; ++i)
      latent += parts_->storage->latent(i, next.enthalpy[as_size(i)], next.temperature[as_size(i)]) -
                parts_->storage->latent(i, old.enthalpy[as_size(i)], old.temperature[as_size(i)]);
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
    reactions[i] = parts_->system->parts().prescribed.fixed()[i] ? residual[i] : 0.0;
  // Entropy comes in with the heat at its temperature, q/Θ; reactions are heat at a prescribed
  // temperature.
  double entropy = entropy_power(parts_->system->parts(), temperature);
  for (std::size_t i = 0; i < reactions.size(); ++i) entropy += reactions[i] / temperature[i];
  balance.entropy_in = parallel::global_sum(entropy) * dt;
  for (const auto& [name, power] : parts_->system->parts().prescribed.reaction_powers(reactions))
    balance.conditions.push_back({name, power * dt});
  for (const std::vector<NamedPower>& powers :
       {parts_->system->parts().surfaces.powers(), parts_->system->parts().channels.powers(),
        parts_->system->parts().sources.powers()})
    for (const auto& [name, power] : powers) balance.conditions.push_back({name, power * dt});
  for (double power : parts_->system->parts().contributions.powers())
    balance.contributions.push_back(power * dt);
  if (parts_->consistent) balance.contributions.pop_back();  // no heat, but stored in another place
  if (parts_->printed) balance.contributions.pop_back();     // no heat, but what a printed form loses
  return balance;
}

std::vector<ChannelReading> ThermalPhase::channel_readings(double dt) const {
  std::vector<ChannelReading> readings = parts_->system->parts().channels.readings();
  for (ChannelReading& reading : readings) reading.heat *= dt;
  return readings;
}

}  // namespace solidus::heat
