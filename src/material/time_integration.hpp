/// Time integration of the history: backward Euler, and the two-step method of Gear (BDF2) with variable
/// steps (monograph 4.64–4.73, errata to 4.66, 4.70).
///
///   ż(t_{n+1}) ≈ (z_{n+1} − z*)/Δt_eff
///   backward Euler  z* = z_n,                                          Δt_eff = Δt
///   two-step        z* = ((1 + ω)² z_n − ω² z_{n−1})/(1 + 2ω),         Δt_eff = Δt (1 + ω)/(1 + 2ω)
///
/// Symbols: z history, Δt = t_{n+1} − t_n, ω = Δt/(t_n − t_{n−1}). A law sees z*, Δt_eff and whether z* is a
/// state. Order 1 and 2; the two-step method is stable for steps that grow by less than 1 + √2 (Grigorieff
/// 1983).
#pragma once

#include "numbers/tensor.hpp"

namespace solidus::material {

/// 1 + √2: of a step against the one before, in the two-step method.
inline constexpr double k_largest_growth = 2.4142135623730951;

/// z* = now z_n + before z_{n−1}, and the effective step.
struct TimeStep {
  double dt;  ///< Δt_eff [s]
  double now = 1, before = 0;
  /// Whether z* combines states instead of being one. The step then adds f_z (z_{n+1} − z*) to a function
  /// f(z), since f(z*) is not the same combination of the values of f.
  bool extrapolated = false;

  /// Backward Euler over `step` [s], positive, from a state.
  TimeStep(double step)
      : dt(step) {}  // NOLINT: implicit, since a law is asked for a step from a state mostly

  static TimeStep backward_euler(double dt) { return dt; }
  /// @param dt, dt_before  Δt and t_n − t_{n−1} [s], both positive
  static TimeStep two_step(double dt, double dt_before) {
    const double ratio = dt / dt_before, divisor = 1 + 2 * ratio;
    TimeStep step(dt * (1 + ratio) / divisor);
    step.now = (1 + ratio) * (1 + ratio) / divisor;
    step.before = -ratio * ratio / divisor;
    step.extrapolated = true;
    return step;
  }
};

/// Alexander's method of two stages, of second order and L-stable: each a backward Euler step over γ Δt, the
/// second from y* = y_n + (1−γ)/γ (Y_1 − y_n). R. Alexander, SIAM J. Numer. Anal. 14 (1977) 1006.
inline constexpr double k_sdirk_share = 0.29289321881345248;   ///< γ = 1 − 1/√2
inline constexpr double k_sdirk_carried = 2.4142135623730951;  ///< (1−γ)/γ = 1 + √2

/// Returns z* of the history of a viscoplastic point (Viscoplastic::State) at t_n and t_{n−1}.
template <class State>
State start_state(const TimeStep& step, const State& now, const State& before) {
  using T = decltype(now.hardening);
  const T a(step.now), b(step.before);
  State start = now;
  start.viscous_strain = a * now.viscous_strain + b * before.viscous_strain;
  start.plastic_strain = a * now.plastic_strain + b * before.plastic_strain;
  start.back_strain = a * now.back_strain + b * before.back_strain;
  start.hardening = a * now.hardening + b * before.hardening;
  start.inelastic_entropy = a * now.inelastic_entropy + b * before.inelastic_entropy;
  start.cold_work = a * now.cold_work + b * before.cold_work;
  return start;
}

}  // namespace solidus::material
