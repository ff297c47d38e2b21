/// The double-pass product formula (Strang 1969; monograph 4.21) on the isentropic or the isothermal split:
/// half a mechanical phase, a thermal phase, half a mechanical phase. Second order where everything is
/// smooth.
///
///   0  Θ^p        thermal phase over Δt/2 at (ε_n, z_n)
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
///
/// Isothermal passes hold a temperature in steps 1 and 3 and do not know what their own deformation does to
/// it. Each of them is therefore repeated at the temperature that its deformation leads to, by a thermal
/// phase over Δt/2 in step 1 and by step 4 in step 3, until that settles; one iteration gains a factor of the
/// coupling number. Where deformation exchanges no heat one iteration is all.
///
/// With inertia each half is a step of the integrator over Δt/2, whose means over its ends make the forces of
/// a half of second order, and each half works with the stress of its own (docs/theory/dynamics.md).
#pragma once

#include <functional>

#include "coupling/phases.hpp"
#include "coupling/scheme.hpp"
#include "coupling/thermal_flow.hpp"

namespace solidus::coupling {

class DoublePass final : public CouplingScheme {
 public:
  /// The phases must outlive the scheme. Throws std::invalid_argument unless both are there, the mechanical
  /// one isothermal or isentropic, and what structural heat they exchange is in the energy or the entropy
  /// form; an isentropic one needs it.
  /// @param flow  of metal in steps 2 and 4
  explicit DoublePass(Phases phases, ThermalFlow flow = ThermalFlow::kept);

  void synchronise(const State& state) override;
  void forget() override;
  StepEffort advance(const State& old, State& trial, double time, double dt) override;

 private:
  /// Steps 0 to 2, from t_n; and 3, 4.
  /// @param in_middle  forces in the middle of the step; those whose work both halves do without inertia
  StepEffort first_half(const State& old, State& half, double time, double dt,
                        mechanics::ForcesAtWork& in_middle);
  StepEffort second_half(const State& half, State& trial, double time, double dt,
                         const mechanics::ForcesAtWork& in_middle);
  /// Finds the temperatures to which a deformation leads.
  using Answer = std::function<void(const mechanics::StepDeformation& deformation, State& led)>;
  /// A mechanical half that has been solved.
  struct Half {
    mechanics::MechanicalReport report;  ///< of its last pass
    std::vector<double> held;            ///< the temperature of that pass, where it was found; else empty
  };
  /// Step 1 or 3.
  /// @param pass  begins at the temperature that is held first; becomes the last pass, which refers to `half`
  void mechanical_half(const State& start, State& end, mechanics::MechanicalPass& pass, const Answer& answer,
                       Half& half, StepEffort& effort) const;
  /// Whether a mechanical pass is repeated at the temperature that it leads to.
  bool repeats() const;

  /// Step 2 or 4 after a mechanical pass from `start`.
  /// @param deformation  of that pass; replaced where metal flows again
  void thermal_half(const State& start, State& end, mechanics::StepDeformation& deformation,
                    const heat::ThermalPass& heat, const mechanics::MechanicalPass& moved,
                    StepEffort& effort) const;

  Phases phases_;
  ThermalFlow flow_;
};

}  // namespace solidus::coupling
