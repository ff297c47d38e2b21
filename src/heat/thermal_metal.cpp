/// Metal that moves takes its heat along; what it leaves behind conducts and stores as gas.
///
/// The heat of all nodes together is the same before and after, to rounding: what some lose others get.
#include <algorithm>
#include <array>
#include <cassert>
#include <vector>

#include "heat/thermal_parts.hpp"
#include "heat/thermal_phase.hpp"
#include "mesh/shape.hpp"
#include "numbers/index_casts.hpp"
#include "system/processes.hpp"

namespace solidus::heat {

namespace {

/// Air at 600 °C, halfway between a mould and most melts (F. P. Incropera et al., Fundamentals of Heat and
/// Mass Transfer, 2007, table A.4).
constexpr double k_gas_conductivity = 0.06;  ///< [W/(m K)]
constexpr double k_gas_capacity = 450;       ///< ρ c_p [J/(m³ K)]

}  // namespace

/// The metal of each node over what was poured, but no less than stores as much as gas does.
std::vector<double> ThermalPhase::at_least_gas(const MovedMetal& metal) const {
  // A capacity of the metal at 20 °C says what share of it the gas has.
  double least = 1;
  for (std::size_t body = 0; body < parts_->materials.size(); ++body)
    if (metal.moves[body] != 0)
      least = std::min(least,
                       k_gas_capacity / parts_->storage->body_curve(static_cast<int>(body)).capacity(293.15));
  std::vector<double> held(metal.held.begin(), metal.held.end());
  for (double& share : held) share = std::max(share, least);
  return held;
}

void ThermalPhase::move_metal(const MovedMetal& metal, ThermalState* state) {
  assert(parts_->options.integration == HeatIntegration::closed &&
         parts_->options.sensible == SensibleForm::enthalpy);
  std::vector<double> held = at_least_gas(metal);
  if (state != nullptr && !carry_heat(metal.moves, held, *state)) return;
  parts_->storage->hold(metal.moves, held);
  // Temperatures follow from the heats where metal has come or gone.
  if (state != nullptr) {
    for (Index i = 0; i < parts_->mesh.n_owned_nodes; ++i)
      if (held[as_size(i)] != parts_->held_at(i))
        state->temperature[as_size(i)] = parts_->storage->temperature(i, state->enthalpy[as_size(i)]);
    parts_->ghosts.update(state->temperature, 1);
    parts_->ghosts.update(state->enthalpy, 1);
  }
  parts_->held = std::move(held);
  share_conduction(metal);
}

/// Takes the heat of metal that leaves its nodes out of them and gives all of it to those that get metal, by
/// how much they get. Returns false, and changes nothing, where none has moved.
bool ThermalPhase::carry_heat(std::span<const char> moves, std::span<const double> held,
                              ThermalState& state) const {
  // First the sums: heat that leaves, and room whose metal arrives.
  std::vector<double> change(as_size(parts_->mesh.n_owned_nodes), 0.0);
  std::array<double, 2> sums{};
  auto& [leaves, arrives] = sums;
  for (Index i = 0; i < parts_->mesh.n_owned_nodes; ++i) {
    const double before = parts_->held_at(i), gain = held[as_size(i)] - before;
    if (gain == 0) continue;
    double room = 0;
    for (std::size_t body = 0; body < moves.size(); ++body)
      if (moves[body] != 0) room += parts_->storage->volume(i, static_cast<int>(body));
    if (room == 0) continue;
    if (gain > 0) {
      change[as_size(i)] = gain * room;
      arrives += gain * room;
    } else {
      const double heat =
          parts_->storage->heat_of(moves, i, state.enthalpy[as_size(i)], state.temperature[as_size(i)]);
      change[as_size(i)] = heat * gain / before;
      leaves -= change[as_size(i)];
    }
  }
  processes::sum(sums);
  if (!(arrives > 0)) return false;
  // Then each node that gets metal has its part of that heat.
  for (Index i = 0; i < parts_->mesh.n_owned_nodes; ++i) {
    const bool gets = held[as_size(i)] > parts_->held_at(i);
    state.enthalpy[as_size(i)] += gets ? change[as_size(i)] / arrives * leaves : change[as_size(i)];
  }
  return true;
}

/// Gives each element of metal the mean conductivity of what fills it, by the mean of its nodes.
void ThermalPhase::share_conduction(const MovedMetal& metal) {
  ConductionElements& elements = parts_->system->parts().elements;
  bool any = false;
  for (std::size_t b = 0; b < parts_->mesh.blocks.size(); ++b) {
    const mesh::ElementBlock& block = parts_->mesh.blocks[b];
    if (metal.moves[as_size(block.body)] == 0) continue;
    const double gas = k_gas_conductivity / elements.potentials()[as_size(block.body)].reference();
    const Index n = mesh::node_count(block.shape);
    std::vector<double> share(as_size(block.size()));
    for (Index e = 0; e < block.size(); ++e) {
      double filled = 0;
      for (Index a = 0; a < n; ++a) filled += metal.filled[as_size(block.element(e)[a])];
      share[as_size(e)] = gas + (1 - gas) * filled / n;
      any = any || filled < n;
    }
    elements.set_shares(b, std::move(share));
  }
  // As long as nothing is empty conduction is as it was assembled.
  if (!parallel::any_process(any)) return;
  parts_->system->parts().conduction.forget();
  parts_->solver->forget();
}

}  // namespace solidus::heat
