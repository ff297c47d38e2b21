/// The heat balance of the nodes at the iterates of a stage, its tangent and the way along a direction:
///
///   F_i = (H_i − H*_i)/Δt + r_i(Θ, u) = 0                                              [W]
///
/// With the closed rule the nodal enthalpy is the unknown and Θ_i(H) follows: a node on a plateau has δΘ = 0
/// and takes its δH from its row (enthalpy_newton.hpp). With the open rule the temperature is the unknown.
/// Terms that depend on the displacements enter r through the contributions of the phase.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "heat/thermal_parts.hpp"

namespace solidus::heat {

class EnthalpyNewton;

/// The imbalance of heat at the last evaluation, over all processes.
struct HeatImbalance {
  double unbalanced = 0;  ///< Σ|F_i| where free [W]
  double moved = 0;       ///< heat moved per time [W]
  double tolerance = 0;   ///< of the phase, as a share of it
};

class ThermalEquations {
 public:
  /// @param now  the state of the iterates, ghosts up to date; both must outlive this object
  ThermalEquations(ThermalParts& parts, ThermalState& now);
  ~ThermalEquations();
  /// A stage begins, whose points have begun theirs where they store the heat.
  /// @param stored_from  H*, [local node], where the enthalpy of the nodes is the unknown; must live as long
  ///                     as the stage
  void begin(std::span<const double> stored_from, double dt);
  /// The state of now is another one, for a further attempt at the same stage.
  void restart();

  /// Evaluates F at the present Θ with the present contributions. Collective.
  void evaluate();
  /// F, [owned node] [W]; where the temperature is prescribed, the heat that holds it.
  std::span<const double> residual() const;
  HeatImbalance imbalance() const;
  /// The criterion of the phase, on the last evaluate().
  bool converged() const;
  /// ∂F/∂Θ with the exact conductivity and the storage, plateaus held. May move the plateaus (and F) of a
  /// start that lies far off. `iteration` counts from zero.
  linear::BlockMatrix& assemble(int iteration);
  /// −F, zero where δΘ is none, [owned node].
  std::span<const double> right_hand_side() const;
  /// Keeps the unknowns of now and sets out in the direction of δΘ.
  /// @param step_t   δΘ [local node]; made zero where it is none, and its ghosts brought up to date
  /// @param further  ∂F/∂u δu [W], [owned node]
  void set_direction(std::span<double> step_t, std::span<const double> further);
  /// The unknowns at α of the direction. Collective.
  void move(double alpha);

 private:
  double tolerance() const;
  double moved() const;

  ThermalParts& parts_;
  ThermalState& now_;
  ThermalState start_;                      ///< of the direction
  std::unique_ptr<EnthalpyNewton> newton_;  ///< where the enthalpy of the nodes is the unknown
  std::span<const double> stored_from_;
  std::vector<double> residual_, rhs_, step_;
  double dt_ = 0, unbalanced_ = 0;
};

}  // namespace solidus::heat
