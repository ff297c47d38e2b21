/// The equations of a step of the mechanical phase, for Newton's method and for iterations that have further
/// unknowns (coupling/simultaneous.hpp).
///
///   r(u) = ∫ B̄ᵀ σ dV − f(t) + contributions + inertia = 0
///
/// Newton's criterion measures the residual against the forces that the bodies exchange with the world
/// (loads, supports, contact, inertia), or a millionth of the internal forces where there are none.
#pragma once

#include <span>
#include <vector>

#include "material/time_integration.hpp"
#include "mechanics/mechanical_bodies.hpp"
#include "mechanics/mechanical_matrix.hpp"

namespace solidus::mechanics {

/// The effective step of the time integration. The first step, and one that grows beyond the limit of
/// stability of the two-step method, are backward Euler steps.
material::TimeStep time_step(const MechanicsOptions& options, const MechanicalState& old,
                             const MechanicalPass& pass);

/// The temperatures and plateau shares of which the solid fractions of a pass follow.
inline FractionPlace fraction_place(const MechanicalPass& pass) {
  return {pass.phase_temperature.empty() ? pass.temperature : pass.phase_temperature, pass.plateau_share};
}

/// The solid fractions at t_n that a pass works with; empty: those of its end.
inline std::span<const double> fractions_before(const MechanicalState& old, const MechanicalPass& pass) {
  return pass.at_rest ? std::span<const double>{} : std::span<const double>(old.solid_fraction);
}

class MechanicalEquations {
 public:
  /// Both must outlive this object.
  MechanicalEquations(MechanicalBodies& bodies, MechanicalMatrix& system);

  /// Loads, state at t_n and properties at the temperature of the pass; `old` must live until conclude().
  void begin(const MechanicalState& old, const MechanicalPass& pass);
  /// The properties at another temperature of the iterate, after begin().
  void prepare(const MechanicalState& old, const MechanicalPass& pass);
  /// As linear::NonlinearSystem has them.
  double residual(std::span<const double> x, std::span<double> r);
  linear::BlockMatrix& tangent(std::span<const double> x);
  /// Size of a step relative to the displacement since t_n: BodyBalance::relative_step, of the unknowns x and
  /// of the step d that has led to them.
  double relative_step(const MechanicalState& old, std::span<const double> x,
                       std::span<const double> d) const;
  /// A residual that is rounding [N].
  double round_off() const { return round_off_; }
  /// The kernels have been given another step, or their equations have changed: the last residual is no
  /// longer theirs.
  void forget_residual() { residual_is_known_ = false; }
  /// MechanicalBodies::finish() at the solution; the state and the report that follow from it, the latter
  /// without that of Newton's iteration.
  MechanicalReport conclude(const MechanicalState& old, const MechanicalPass& pass, std::vector<double> x,
                            MechanicalState& trial);
  /// Wall time so far [s].
  struct Seconds {
    double assembly = 0;  ///< tangents
    double residual = 0;  ///< forces and the constitutive update
  };
  const Seconds& seconds() const { return seconds_; }
  std::size_t bytes() const;

 private:
  void add_residual_to_balance(std::span<const double> r);
  MechanicalReport measure(const MechanicalState& old, const MechanicalPass& pass, std::span<const double> x,
                           const BlockWork& sums, MechanicalState& next);

  MechanicalBodies& bodies_;
  MechanicalMatrix& system_;
  std::vector<BlockHistory> start_;  ///< z* of the two-step method, one per block
  double round_off_ = 0;
  std::vector<double> x_;           ///< unknowns of the last residual
  std::vector<double> residual_;    ///< there
  bool residual_is_known_ = false;  ///< for the arguments of the last prepare()
  std::vector<double> forces_;      ///< internal forces, [local node][component]; ghost rows are scrap
  std::vector<double> external_;    ///< loads at t_{n+1}, [owned node][component]
  std::vector<double> inertial_;    ///< J at the last residual, [owned node][component]; with inertia
  Seconds seconds_;
};

}  // namespace solidus::mechanics
