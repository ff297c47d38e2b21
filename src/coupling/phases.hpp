/// References to the phases that a scheme drives; setup::Assembly owns them.
#pragma once

#include <optional>
#include <vector>

#include "contact/pair.hpp"
#include "coupling/coherency.hpp"
#include "coupling/growth.hpp"
#include "coupling/observer.hpp"
#include "coupling/skin_share.hpp"
#include "coupling/state.hpp"
#include "criteria/criteria.hpp"
#include "heat/thermal_phase.hpp"
#include "mechanics/mechanical_phase.hpp"
#include "mechanics/structural_heat.hpp"

namespace solidus::coupling {

struct Phases {
  heat::ThermalPhase* heat = nullptr;               ///< null: mechanics alone
  mechanics::MechanicalPhase* mechanics = nullptr;  ///< null: heat alone
  mechanics::StructuralHeat* structural = nullptr;  ///< null: deformation does no heat
  std::vector<contact::ContactPair*> contacts;
  const criteria::Criteria* criteria = nullptr;  ///< criteria that State::criteria belongs to; null: none
  const Coherency* coherency = nullptr;          ///< null: nothing that deforms melts
  const SkinShare* skin = nullptr;               ///< null: no surface in contact melts
  const Growth* growth = nullptr;                ///< null: nothing grows
  std::vector<double> temperature;               ///< [K], [local node]: of a mechanical phase alone
  std::optional<double> ambient_temperature;     ///< Θ_a of 2.24 [K]; absent: 𝓛 is not followed

  /// Heat and deformation exchange energy and Θ_a is known: then 𝓛 is a column.
  bool audits_stability() const { return heat && structural && ambient_temperature; }
};

/// ThermalPhase::plateau_share; empty in mechanics alone. Collective.
std::vector<double> plateau_share(const Phases& phases, const heat::ThermalState& state);

/// Coherency::at of a state; empty where nothing that deforms melts. Collective.
std::vector<double> coherency_of(const Phases& phases, const heat::ThermalState& heat);
/// Coherency of a step of the mechanical phase, at the solid fractions with which its law works; empty where
/// nothing that deforms melts. Collective.
std::vector<double> coherency_of(const Phases& phases, const mechanics::MechanicalState& old,
                                 const mechanics::MechanicalPass& pass);
/// The solidity of nodes as contacts see it; keeps a view of `coherency`.
inline contact::Solidity solidity_of(const Phases& phases, std::span<const double> coherency) {
  if (phases.coherency == nullptr || coherency.empty()) return {coherency};
  return {coherency, phases.coherency->of_solid()};
}

/// Adds to the report of a step the data of the state that every scheme reports: temperatures, solid
/// fraction, contact.
void summarise(const Phases& phases, const State& state, StepEffort& effort);

}  // namespace solidus::coupling
