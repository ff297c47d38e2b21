/// Transfers the histories of all contact pairs between the states of a run and the pairs.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "coupling/phases.hpp"
#include "system/errors.hpp"

namespace solidus::coupling {

/// Times the stabilisation of contact that its tangents hold where an iteration does not settle. The place of
/// a body that contact has let go and nothing else holds follows from rounding over that stabilisation, and
/// so does the heat that passes through its gaps.
inline constexpr double k_firm_hold = 1e3;

/// A mechanical pass sets out: pairs from `contacts` at t_n (State::contacts).
/// @param coherency  at t_n (coherency_of)
/// @param iterate    of the pass before within the step (ContactPass::iterate); empty: there is none
/// @param further    ContactPass::further
void begin_contacts(const Phases& phases, const std::vector<contact::ContactState>& contacts,
                    const mechanics::MechanicalState& old, const mechanics::MechanicalPass& pass,
                    std::span<const double> coherency = {},
                    const std::vector<contact::ContactState>& iterate = {}, bool further = false);
/// A step of heat alone sets out: pairs that store heat, between bodies that do not deform.
void rest_contacts(const Phases& phases, const State& old, double time, double dt);
/// Whether there are interfaces of which it is not known yet how warm they are: at the start, and where
/// bodies are new. Collective.
bool interfaces_begin(const Phases& phases, const State& state);
/// Gives interfaces whose temperature is not known yet in a state, before the first step or where bodies are
/// new, the one at rest between the bodies; pairs are then at that state. Local.
void find_interface_temperatures(const Phases& phases, const State& state, double time);
/// Returns the states of the pairs at their last update.
std::vector<contact::ContactState> contact_states(const Phases& phases);
/// Points that are not open, over all processes. Collective.
std::int64_t closed_points(const contact::ContactState& state);
/// Restores the pairs to their states in `state`.
void restore_contacts(const Phases& phases, const State& state);
/// y_n + carried (Y_1 − y_n) of all that integrates: the start of the second stage of Alexander's method.
std::vector<contact::ContactState> second_start(const Phases& phases,
                                                const std::vector<contact::ContactState>& old,
                                                const std::vector<contact::ContactState>& stage,
                                                double carried);

/// After equilibrium: true when the penetrations that are left are as small as the augmented Lagrangian wants
/// them; else the multipliers follow the pressures and the phase must be solved again. Throws StepRejected
/// after too many augmentations. Collective.
/// @param augmentation  of this pass, from one on
/// @param earlier       augmentations that passes before this one have taken in the same step
bool penetrations_small(const Phases& phases, int augmentation, int earlier = 0);
/// After an augmentation whose equilibrium was not found: true when the augmentations of the step end at the
/// equilibrium before it, which is to be solved for once more; else the step is to be rejected. Collective.
bool restore_multipliers(const Phases& phases);
/// Enters in an error, before it is thrown again, the failure_text() of the pairs and, where equilibrium was
/// not found, their points at its last iterate; the pairs are left there. Collective.
void add_contacts(const Phases& phases, StepRejected& rejected);

}  // namespace solidus::coupling
