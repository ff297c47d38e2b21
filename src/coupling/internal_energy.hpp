/// The internal energy of a state, a function of its fields alone: sensible and latent heat, the structural
/// energy E = W + M + K + Θ S with the energy of cold work, and the energy of contact: in penalties, in what
/// friction's hardening stores and in the capacity of interfaces. Over a run
///
///   U(end) − U(start) − U(bodies that have come and left) + ΔK
///       = heat + work − dissipation of friction that did not become heat − energy that the time integration
///       has
///         dissipated
///
/// which is the first law as a statement about two states; no sum over the steps enters U. The kinetic energy
/// K is that of the balance of the steps.
#pragma once

#include "coupling/phases.hpp"

namespace solidus::coupling {

/// Whether that is a function of the fields. False without structural heat, and where a body that deforms has
/// its specific heat at constant strain and a phase that changes or a modulus, an expansion or a hardening
/// that follows the temperature: latent heat and bends of tables are then those at fixed strain, so that the
/// energy of a state depends on the strain at which it froze (docs/theory/coupling.md).
/// @param bodies_come  bodies that are not active may be so later
bool has_internal_energy(const Phases& phases, bool bodies_come = false);

/// U of a committed state [J] (axisymmetric: of the whole revolution; plane strain: per metre), from a zero
/// that is the same in all states of a run with the same bodies. The contact pairs must be at that state.
/// Lets go of the deformation of the step before, so not between the passes of a step. Collective.
double internal_energy(const Phases& phases, const State& state);

}  // namespace solidus::coupling
