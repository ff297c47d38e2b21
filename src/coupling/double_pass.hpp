/// The double-pass product formula (Strang 1969; monograph 4.21) on the isentropic split: half a mechanical
/// phase, a thermal phase, half a mechanical phase. Second order where everything is smooth.
///
///   0  Θ^p        thermal phase over Δt/2 at (ε_n, z_n): what the entropy in the middle will be
///   1  ε_½, z_½   equilibrium at t_n + Δt/2, from z_n:  S^E(ε_½, z_½, Θ̄) = S^E(ε_n, z_n, Θ^p)
///   2  Θ*         thermal phase over Δt at (ε_½, z_½), SDIRK2, storing
///                 E(ε_½, Θ*) − E(ε_n, Θ_n) − σ_½ : (ε_½ − ε_n)
///   3  ε_1, z_1   equilibrium at t_{n+1}, from z_½:  S^E(ε_1, z_1, Θ̄) = S^E(ε_½, z_½, Θ*)
///   4  Θ_{n+1}    nothing flows:  E(ε_1, Θ_{n+1}) − E(ε_½, Θ*) − σ_½ : (ε_1 − ε_½) = 0
///
/// Step 0 is not in 4.21. Without inertia the mechanical phase is a constraint, not an evolution: its passes
/// do not commute with the thermal one to second order, and 4.21 alone is of first order, because the
/// configuration of the thermal pass lags half a step behind the entropy (docs/theory/coupling.md). Step 4
/// brings the adiabatic change of temperature to the nodes. Friction heats step 2 by twice what step 1 has
/// dissipated, and step 4 by the difference of step 3 to that. Both halves work with σ_½, which is in
/// equilibrium: a midpoint rule, so the first law closes in the energy form.
#pragma once

#include "coupling/phases.hpp"
#include "coupling/scheme.hpp"

namespace solidus::coupling {

class DoublePass final : public CouplingScheme {
 public:
  /// The phases must outlive the scheme. Throws std::invalid_argument unless both are there, quasi-static,
  /// isentropic, and exchange heat.
  explicit DoublePass(Phases phases);

  void synchronise(const State& state) override;
  void forget() override;
  StepEffort advance(const State& old, State& trial, double time, double dt) override;

 private:
  /// Steps 0 to 2, from t_n; and 3, 4.
  StepEffort first_half(const State& old, State& half, double time, double dt);
  StepEffort second_half(const State& half, State& trial, double time, double dt);

  Phases phases_;
};

}  // namespace solidus::coupling
