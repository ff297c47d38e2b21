/// The isothermal split (monograph 4.2.3, 4.36, 4.46–4.54) in its temperature form: first the mechanical
/// phase at Θ_n, then the thermal phase at the configuration found, with exact enthalpy differences and
/// structural heating (2.127b).
///
/// Conditionally stable: see docs/theory/coupling.md. With only one of the phases it is that phase alone.
#pragma once

#include "coupling/phases.hpp"
#include "coupling/scheme.hpp"

namespace solidus::coupling {

class IsothermalSplit : public CouplingScheme {
 public:
  /// The phases must outlive the scheme.
  explicit IsothermalSplit(Phases phases) : phases_(std::move(phases)) {}
  void synchronise(const State& state) override;
  void forget() override;
  StepEffort advance(const State& old, State& trial, double time, double dt) override;

 private:
  void mechanical_phase(const State& old, State& trial, double time, double dt, StepEffort& effort);
  void thermal_phase(const State& old, State& trial, double time, double dt, StepEffort& effort);

  Phases phases_;
};

}  // namespace solidus::coupling
