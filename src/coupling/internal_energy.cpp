/// Heat of the storage, structural energy of the points and energy of contact, added up for one state.
#include "coupling/internal_energy.hpp"

#include <algorithm>

#include "coupling/contact_states.hpp"

namespace solidus::coupling {

namespace {

/// Whether structural energy of a body with its specific heat at constant strain follows from the fields: it
/// is evaluated again where a phase or the line of a table changes, and none does.
bool keeps_its_lines(const material::Material& m) {
  const auto constant = [](const Table& table) { return table.constant(); };
  if (!m.phase_changes.empty() || !constant(m.young_modulus) || !constant(m.poisson_ratio) ||
      !constant(m.expansion))
    return false;
  if (!m.flow || (m.flow->isotropic == material::IsotropicHardening::none &&
                  m.flow->kinematic == material::KinematicHardening::none))
    return true;
  return m.flow->curves.temperatures().size() <= 1 && constant(m.flow->flow_stress) &&
         std::ranges::all_of(m.flow->hardening, constant) && constant(m.flow->kinematic_modulus);
}

double energy_of_contacts(const Phases& phases, const State& state) {
  const bool begin = interfaces_begin(phases, state);
  if (begin) find_interface_temperatures(phases, state, state.time);
  double energy = 0;
  for (const contact::ContactPair* pair : phases.contacts) energy += contact::stored_energy(pair->view());
  if (begin) restore_contacts(phases, state);
  return energy;
}

}  // namespace

bool has_internal_energy(const Phases& phases, bool bodies_come) {
  if (phases.heat == nullptr || phases.structural == nullptr) return false;
  const mechanics::MechanicalPhase& mechanics = *phases.mechanics;
  // Heat capacities at constant strain give an energy only if the material keeps its lines.
  for (std::size_t body = 0; body < mechanics.mesh().bodies.size(); ++body) {
    const auto number = static_cast<int>(body);
    const material::Material& material = mechanics.bodies().material(number);
    if ((bodies_come || mechanics.bodies().active.body(number)) &&
        material.specific_heat_at == material::SpecificHeatAt::constant_strain && !keeps_its_lines(material))
      return false;
  }
  return true;
}

double internal_energy(const Phases& phases, const State& state) {
  double energy = phases.heat->states().enthalpy(state.heat);
  phases.structural->release();  // of the step that is over: its storage serves again
  energy += mechanics::structural_energy(*phases.mechanics, state.mechanics, state.heat.temperature,
                                         plateau_share(phases, state.heat));
  return energy + energy_of_contacts(phases, state);
}

}  // namespace solidus::coupling
