/// The energy that the defect of the first law is divided by.
///
///   E = max(Q, |E_mech|, k ∫ρ c Θ dV)                                                              [J]
///
/// Q is the heat exchanged over the steps, E_mech the largest of the mechanical energies. A run at rest
/// exchanges nothing but rounding, and rounding over rounding says nothing: then the part k of the heat
/// content of the bodies counts. With k = 1e-6 that is what warms them by one or two thousandths of a kelvin.
#pragma once

#include "coupling/observer.hpp"
#include "coupling/state.hpp"
#include "heat/thermal_phase.hpp"

namespace solidus::coupling {

/// Share of the heat content that counts where less heat than that is exchanged.
inline constexpr double k_at_rest = 1e-6;

/// ∫ρ c Θ dV of all bodies at the temperatures of the state, latent heat left out [J]. Collective.
double heat_content(const heat::ThermalPhase& phase, const heat::ThermalState& state);

/// @param sum           over the steps of a run
/// @param heat_content  at its start [J]
double energy_scale(const EnergyAudit& sum, double heat_content);
/// |defect of the sum| over that scale; zero where both are zero.
double relative_defect(const EnergyAudit& sum, double heat_content);

}  // namespace solidus::coupling
