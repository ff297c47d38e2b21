#include "coupling/internal_energy.hpp"

#include <algorithm>

namespace solidus::coupling {

bool has_internal_energy(const Phases& phases) {
  if (phases.heat == nullptr || phases.structural == nullptr || phases.mechanics->dynamic()) return false;
  const mechanics::MechanicalPhase& mechanics = *phases.mechanics;
  for (std::size_t body = 0; body < mechanics.mesh().bodies.size(); ++body) {
    const auto number = static_cast<int>(body);
    if (mechanics.active().body(number) &&
        mechanics.material(number).specific_heat_at == material::SpecificHeatAt::constant_strain)
      return false;
  }
  return std::none_of(phases.contacts.begin(), phases.contacts.end(),
                      [](const contact::ContactPair* pair) { return pair->spec().friction.has_value(); });
}

double internal_energy(const Phases& phases, const State& state) {
  double energy = phases.heat->enthalpy(state.heat);
  phases.structural->release();  // of the step that is over: its storage serves again
  energy += mechanics::structural_energy(*phases.mechanics, state.mechanics, state.heat.temperature,
                                         plateau_share(phases, state.heat));
  for (const contact::ContactPair* pair : phases.contacts) energy += contact::sums(pair->view(), {}).energy;
  return energy;
}

}  // namespace solidus::coupling
