/// One pass through a phase, and its contribution to the report of the step: shared by the schemes that solve
/// the phases one after the other, once or several times a step.
#pragma once

#include "coupling/phases.hpp"

namespace solidus::coupling {

/// The state from which a pass of the mechanical phase starts.
struct MechanicalStart {
  const mechanics::MechanicalState& mechanics;
  const std::vector<contact::ContactState>& contacts;

  MechanicalStart(const State& state)  // NOLINT(google-explicit-constructor): a state is a start
      : MechanicalStart(state.mechanics, state.contacts) {}
  MechanicalStart(const mechanics::MechanicalState& mechanical,
                  const std::vector<contact::ContactState>& of_contacts)
      : mechanics(mechanical), contacts(of_contacts) {}
};

/// Equilibrium, then gaps and conductances of the configuration found. Efforts add up over the passes of a
/// step, energies are those of the last pass; the energy in contact penalties is left to the caller. Returns
/// the report of the phase: Newton's iteration may miss its tolerance only where the pass limits its steps.
/// @param pass      its iterate may be `trial`
/// @param contacts  states of the pairs after the pass before, of a scheme that iterates within the step
/// @param augmentations  of the Lagrangian in the passes of this step so far; updated. Null: this is the
///                  only pass
mechanics::MechanicalReport mechanical_pass(const Phases& phases, const MechanicalStart& old, State& trial,
                                            const mechanics::MechanicalPass& pass, StepEffort& effort,
                                            const std::vector<contact::ContactState>& contacts = {},
                                            int* augmentations = nullptr);
/// Enters the work and the support forces of a solved mechanical phase in the report of the step.
void book_work(const mechanics::MechanicalReport& report, StepEffort& effort);

/// Enters EnergyAudit::excess_work of the last mechanical pass of a step, in a scheme of first order in time.
/// It stays zero where heat and deformation exchange no energy, and with an integration of inertia whose
/// forces at work are means over the step. Collective.
/// @param deformation  MechanicalReport::deformation
void book_excess_work(const Phases& phases, const mechanics::StepDeformation& deformation,
                      EnergyAudit& energy);

/// The balance of energy at a deformation (4.43, 4.53); otherwise the same. Returns whether the iteration
/// reached its tolerance.
/// @param deformation  MechanicalReport::deformation, or held; empty where deformation does no heat
bool thermal_pass(const Phases& phases, const State& old, State& trial,
                  const mechanics::StepDeformation& deformation, const heat::ThermalPass& pass,
                  StepEffort& effort);

/// thermal_pass() with the return mapping that the monograph prints for the thermal phase (4.45, 4.49, 4.54):
/// the flow of solid metal at Θ_{n+1} from the internal variables at t_n, at the strain of the mechanical
/// phase. The two are solved in alternation until the temperatures stay; what the one does to the other is
/// about 1e-3, so that two or three iterations do. Throws StepRejected where they do not.
/// @param deformation  that of the mechanical pass; replaced
/// @param started      the mechanical state that the pass started from
/// @param pass         that pass
bool thermal_pass_with_flow(const Phases& phases, const State& old, State& trial,
                            mechanics::StepDeformation& deformation, heat::ThermalPass heat,
                            const mechanics::MechanicalState& started, const mechanics::MechanicalPass& pass,
                            StepEffort& effort);

}  // namespace solidus::coupling
