/// One step of the thermal phase piece by piece, for a Newton iteration that has further unknowns: the
/// displacements of the simultaneous scheme (monograph 4.1).
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

#include "heat/thermal_phase.hpp"

namespace solidus::heat {

class EnthalpyNewton;
class ExtrapolationGuard;

class ThermalIteration {
 public:
  /// The phase must outlive this object and must not solve between begin() and conclude().
  explicit ThermalIteration(ThermalPhase& phase);
  ~ThermalIteration();

  /// To `time` = t_n + dt from `old` at t_n, which is H* and must live until conclude().
  void begin(const ThermalState& old, double time, double dt) {
    begin(old, dt, LoadWindow::backward_euler(time - dt, time));
  }
  /// The same to loads.time, with these loads.
  void begin(const ThermalState& old, double dt, const LoadWindow& loads);
  /// The second stage of a two-stage method, from the first one: H* = H_n + factor (H_stage − H_n). Both
  /// states must live until conclude().
  void begin_stage(const ThermalState& old, const ThermalState& stage, double factor, double dt,
                   const LoadWindow& loads);
  /// Whether a second stage is worth a try from the extrapolation of the heats between `old` at t_n and
  /// `stage`, the end of the first stage (extrapolation_guard.hpp). Always with the open rule, whose
  /// temperatures have no bounds. Both states must live until overshoots(). Collective.
  /// @param loads  of the second stage
  bool may_extrapolate(const ThermalState& old, const ThermalState& stage, const LoadWindow& loads);
  /// Whether the second stage, which started from there and ended in `next`, went too far: by more than
  /// deformation alone heats and cools. Collective.
  bool overshoots(const ThermalState& next) const;

  /// Θ of now, [local node], ghosts up to date.
  std::span<const double> temperature() const { return now_.temperature; }
  /// The state of now, ghosts up to date.
  const ThermalState& state() const { return now_; }
  /// Evaluates F at the present Θ with the present contributions. Collective.
  void evaluate();
  /// F, [owned node] [W]; where the temperature is prescribed, the heat that holds it.
  std::span<const double> residual() const;
  double unbalanced() const { return unbalanced_; }  ///< Σ|F_i| where free, all processes [W]
  double moved() const;                              ///< heat moved per time at the last evaluate() [W]
  /// The criterion of the phase, on the last evaluate().
  bool converged() const;
  double tolerance() const;
  /// Goes back to a state that state() was in since the step or stage began, for a further attempt.
  void restart(const ThermalState& state);
  /// Limits conduction again where the Θ of now have left the range of those at t_n and around the bodies
  /// (conduction_limiter.hpp). True where that has changed F: the unknowns then solve it no more. Collective.
  bool revise_limits();
  int max_iterations() const { return phase_.options_.max_iterations; }

  /// Makes the matrix again where nodes meet that did not before; then true. Collective.
  bool follow_graph() { return phase_.follow_graph(); }
  /// ∂F/∂Θ with the exact conductivity and the storage, plateaus held. May move the plateaus (and F) of a
  /// start that lies far off. `iteration` counts from zero.
  linear::BlockMatrix& assemble(int iteration);
  linear::BlockMatrix& matrix();
  /// −F, zero where δΘ is none, [owned node].
  std::span<const double> right_hand_side() const;
  /// Keeps the unknowns of now and sets out in the direction of δΘ.
  /// @param step_t   δΘ [local node]; made zero where it is none, and its ghosts brought up to date
  /// @param further  ∂F/∂u δu [W], [owned node]
  void set_direction(std::span<double> step_t, std::span<const double> further);
  /// The unknowns at α of the direction. Collective.
  void move(double alpha);

  /// The state reached and its heat balance, against H*; latent heat is that between the temperatures at t_n
  /// and now.
  HeatBalance conclude(ThermalState& trial);
  [[noreturn]] void reject(const std::string& reason) const;

 private:
  bool nodal() const { return phase_.nodal(); }

  ThermalPhase& phase_;
  std::unique_ptr<EnthalpyNewton> newton_;  ///< where the enthalpy of the nodes is the unknown
  const ThermalState* old_ = nullptr;
  ThermalState now_, start_;         ///< start_: of the direction
  std::vector<double> stored_from_;  ///< H*, [local node]; where the enthalpy of the nodes is the unknown
  std::vector<double> residual_, rhs_, step_;
  double dt_ = 0, unbalanced_ = 0;
  std::unique_ptr<ExtrapolationGuard> guard_;  ///< of the step's two stages; null: none
  TemperatureRange allowed_;                   ///< to which the second one may lead
  TemperatureRange range_;     ///< within which conduction is to stay; open where something heats or cools
  TemperatureRange at_start_;  ///< of the temperatures at t_n and of the first stage
};

}  // namespace solidus::heat
