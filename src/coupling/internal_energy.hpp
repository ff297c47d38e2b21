/// The internal energy of a state, a function of its fields alone: sensible and latent heat, the structural
/// energy E = W + M + K + Θ S with the energy of cold work, and the energy in contact penalties. Over a run
///
///   U(end) − U(start) = heat + work − energy that the time integration has dissipated
///
/// which is the first law as a statement about two states; no sum over the steps enters the left-hand side.
#pragma once

#include "coupling/phases.hpp"

namespace solidus::coupling {

/// Whether that is a function of the fields. False without structural heat, with inertia or friction, and
/// where a body that deforms has its specific heat at constant strain: latent heat and bends of tables are
/// then those at fixed strain, so that the energy of a state depends on the strain at which it froze
/// (docs/theory/coupling.md).
bool has_internal_energy(const Phases& phases);

/// U of a committed state [J] (axisymmetric: of the whole revolution; plane strain: per metre), from a zero
/// that is the same in all states of a run. The contact pairs must stand at that state. Lets
/// go of the deformation of the step before, so not between the passes of a step. Collective.
double internal_energy(const Phases& phases, const State& state);

}  // namespace solidus::coupling
