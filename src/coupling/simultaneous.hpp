/// The simultaneous scheme (monograph 4.1.1): displacement and temperature at t_{n+1} by one Newton iteration
/// with the exact unsymmetric tangent (coupled_newton.hpp). Backward Euler, or the two stages of Alexander's
/// method of second order,
///
///   Y_1 = y_n + γ Δt f(t_n + γ Δt, Y_1),   y_{n+1} = y* + γ Δt f(t_{n+1}, y_{n+1}),   γ = 1 − 1/√2,
///   y* = y_n + (1−γ)/γ (Y_1 − y_n),
///
/// each a backward Euler step over γ Δt; y holds displacement, history, heat content and, at the quadrature
/// points, structural entropy and energy. Work and heat of a step are (1−γ)/γ times those of the first stage
/// plus those of the second, so the energy form closes the first law in both. The phase fractions that the
/// mechanics sees follow the temperatures of the end of each stage (phase_iterate.hpp).
/// Where y* is no place to start from (heat/iteration/extrapolation_guard.hpp), the second stage is backward
/// Euler over the rest of the step, from Y_1: two stages of second order are not monotone in steps far beyond
/// what a chill takes. R. Alexander, SIAM J. Numer. Anal. 14 (1977) 1006.
#pragma once

#include <optional>

#include "coupling/coupled_newton.hpp"
#include "coupling/scheme.hpp"

namespace solidus::coupling {

class PhaseIterate;

class ContactWork;

struct SimultaneousOptions {
  enum class Integration { backward_euler, sdirk2 };
  Integration integration = Integration::backward_euler;
  linear::CoupledSolverKind solver = linear::CoupledSolverKind::automatic;
};

class SimultaneousScheme final : public CouplingScheme {
 public:
  /// The phases must outlive the scheme. Throws std::invalid_argument unless both are there, the mechanical
  /// one built for Mapping::simultaneous and, with two stages, quasi-static with backward Euler, and what
  /// structural heat they exchange is in the energy or the entropy form.
  SimultaneousScheme(Phases phases, SimultaneousOptions options = {});

  void synchronise(const State& state) override;
  void forget() override;
  void conditions_changed() override { newton_.emplace(phases_, options_.solver); }
  StepEffort advance(const State& old, State& trial, double time, double dt) override;

  /// Report of the last stage.
  const CoupledReport& report() const { return report_; }

 private:
  /// @param deformation  that of the whole step, written
  StepEffort backward_euler(const State& old, State& trial, double time, double dt,
                            mechanics::StepDeformation& deformation);
  /// @param extrapolated  the second stage may start from y*; otherwise it starts from Y_1
  /// @return  nothing where the second stage started from y* and should not have: `trial` is of no use then
  std::optional<StepEffort> two_stages(const State& old, State& trial, double time, double dt,
                                       bool extrapolated, ContactWork& contact,
                                       mechanics::StepDeformation& deformation);
  /// Mechanics from `old`, heat as thermal() has begun.
  /// @param coherency    at t_n
  /// @param deformation  of the stage, written
  /// @param fractions    of phase changes, which follow the temperatures; null: those of `pass` are held
  StepEffort stage(const mechanics::MechanicalState& old, const std::vector<contact::ContactState>& contacts,
                   std::span<const double> coherency, mechanics::MechanicalPass pass, State& trial,
                   mechanics::StepDeformation& deformation, PhaseIterate* fractions = nullptr);
  /// Says once in a run that a step holds fractions that its temperatures do not lead to.
  void warn_of_held_fractions(double time);
  /// Whether the solution found agrees with the fractions that it was found with.
  bool settled(const PhaseIterate& fractions, int iteration);
  /// Returns the deformation of the last stage, counted over the whole step.
  mechanics::StepDeformation drop_carried();

  Phases phases_;
  SimultaneousOptions options_;
  std::optional<CoupledNewton> newton_;  ///< refers to the phases' matrices
  CoupledReport report_;
  bool warned_ = false;  ///< of fractions that are held
};

}  // namespace solidus::coupling
