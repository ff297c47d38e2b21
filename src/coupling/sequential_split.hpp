/// The base of the isothermal and the isentropic split, which solve the two phases in turn, each once a step.
/// mechanics::Mapping decides whether the mechanical phase holds temperature or entropy.
///
///   mechanics_first  (4.31–4.54)  equilibrium at t_{n+1} from Θ_n; gaps and conductances; then heat at the
///                                 configuration and the internal variables found. Displacements and stresses
///                                 of t_{n+1} belong to the temperatures of t_n.
///   heat_first       heat at the configuration of t_n, Θ_n to Θ*; equilibrium at t_{n+1} from Θ*; then what
///                    the deformation has taken up or released, with nothing that flows: Θ* to Θ_{n+1}. What
///                    the step ends with is in equilibrium with its own temperatures; gaps and structural
///                    heat act on the conduction of the next step.
///
/// Both are products of the same two dissipative operators (docs/theory/coupling_stability.md, section 3).
#pragma once

#include "coupling/phase_order.hpp"
#include "coupling/phases.hpp"
#include "coupling/scheme.hpp"
#include "coupling/thermal_flow.hpp"

namespace solidus::coupling {

class SequentialSplit : public CouplingScheme {
 public:
  void synchronise(const State& state) override;
  void forget() override;
  StepEffort advance(const State& old, State& trial, double time, double dt) override;
  std::optional<StepEffort> advance_unless(const State& old, State& trial, double time, double dt,
                                           const HeatJudge& stop) override;

 protected:
  /// The phases must outlive the scheme; the order means nothing where one of them is missing. Throws
  /// std::invalid_argument when the mechanical phase was built for another mapping.
  /// @param flow  of metal in the thermal phase that follows the mechanical one
  SequentialSplit(Phases phases, mechanics::Mapping mapping, PhaseOrder order, ThermalFlow flow);
  const Phases& phases() const { return phases_; }

 private:
  StepEffort mechanics_first(const State& old, State& trial, double time, double dt);
  std::optional<StepEffort> heat_first(const State& old, State& trial, double time, double dt,
                                       const HeatJudge& stop);
  /// Heat at the configuration of t_n.
  StepEffort heat_at_rest(const State& old, State& warm, double time, double dt);
  /// Equilibrium at t_{n+1}, and the works of contact.
  void mechanical_phase(const State& old, const State& warm, State& trial, double time, double dt,
                        StepEffort& effort);
  /// Heat at the configuration found, from `warm`, with the flow of the mechanical phase or a new one.
  void thermal_phase(const State& old, const State& warm, State& trial, const heat::ThermalPass& pass,
                     StepEffort& effort);

  Phases phases_;
  PhaseOrder order_;
  ThermalFlow flow_;
};

}  // namespace solidus::coupling
