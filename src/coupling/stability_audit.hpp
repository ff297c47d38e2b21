/// The functional 𝓛 of a-priori stability over a step (monograph 2.24; with contact 3.69):
///
///   Δ𝓛 = ΔU − Θ_a ΔS + ΔK + ΔE_c − W
///
/// U internal energy with latent heat, S = S^E + S^pc, K kinetic energy, E_c energy in contact penalties, W
/// work of the loads and supports, Θ_a the ambient temperature. U and S are summed where the phases keep
/// them: sensible and latent parts at the nodes or the points of the open rule, structural ones at the
/// mechanical points. Where 𝓛 must not grow: setup/admissible.hpp, docs/theory/coupling_stability.md.
#pragma once

#include "coupling/phases.hpp"

namespace solidus::coupling {

/// Assignment of an increment to the phases.
enum class Booking {
  by_phase,   ///< one mechanical phase, then one thermal phase
  mechanical  ///< all at once: the whole increment as mechanical (4.1.1, iterations)
};

/// After both phases of a step. Zero where heat and deformation do not exchange energy, or without an ambient
/// temperature. Collective.
/// @param deformation  of the step (MechanicalReport::deformation); empty without structural heat
/// @param effort       energies and residuals of the step, complete
StabilityAudit stability_audit(const Phases& phases, const State& old, const State& trial,
                               const mechanics::StepDeformation& deformation, const StepEffort& effort,
                               Booking booking = Booking::by_phase);

}  // namespace solidus::coupling
