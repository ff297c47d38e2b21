/// Velocity and acceleration as functions of the displacement of a step, and the time within the step at
/// which forces balance.
///
///   β Δt² a_1 = Δu − Δt v_n − μ Δt² a_n          v_1 = v_n + Δt [(1−γ) a_n + γ a_1]
///   M [(1−α_m) a_1 + α_m a_n] + (1−α_f) g_1 + α_f g_n = 0        g: internal and contact forces less loads
///
///                        γ           β               μ        α_m            α_f        order
///   backward Euler       1           1               0        0              0          1
///   Newmark              γ           β               1/2 − β  0              0          2 for γ = 1/2
///   generalised-α        1/2−α_m+α_f (1−α_m+α_f)²/4  1/2 − β  (2ρ−1)/(1+ρ)   ρ/(1+ρ)    2
///
/// Newmark 1959; J. Chung, G. M. Hulbert, J. Appl. Mech. 60 (1993) 371. All are stable for every step in
/// linear dynamics. Energy: docs/theory/dynamics.md.
#pragma once

namespace solidus::mechanics {

struct Motion {
  double gamma = 1, beta = 1;
  double memory = 0;  ///< μ
  double alpha_m = 0, alpha_f = 0;
  /// The share of t_{n+1} in the stress and the forces whose work a step does, (1−w) σ_n + w σ_1: one with
  /// backward Euler, whose stability proof needs it, else a half, which makes no heat out of vibration.
  double work_share = 1;

  static Motion backward_euler() { return {}; }
  /// Throws std::invalid_argument unless γ >= 1/2 and β >= (γ + 1/2)²/4: stable for every step.
  static Motion newmark(double gamma, double beta);
  static Motion trapezoidal() { return newmark(0.5, 0.25); }
  /// @param spectral_radius ρ in [0, 1]: what is left of the highest frequencies in a step. Throws
  /// std::invalid_argument outside.
  static Motion generalised_alpha(double spectral_radius);
  /// The least β for a γ.
  static double least_beta(double gamma) { return 0.25 * (gamma + 0.5) * (gamma + 0.5); }

  /// ∂a_1/∂u_1 [1/s²].
  double slope(double dt) const { return 1.0 / (beta * dt * dt); }
  double acceleration(double increment, double v, double a, double dt) const {
    return slope(dt) * (increment - dt * (v + memory * dt * a));
  }
  double velocity(double v, double a, double a_new, double dt) const {
    return v + dt * ((1.0 - gamma) * a + gamma * a_new);
  }
  /// Share of the forces at t_{n+1} in the change of velocity, for forces that act as a mean over the step
  /// (contact/interface/normal.hpp). With it a force that has ended leaves nothing that grows.
  double force_share() const { return alpha_f > 0 ? 1 - alpha_f : gamma; }
  /// Whether a step needs the forces and the stress of t_n.
  bool remembers() const { return work_share < 1 || alpha_f > 0; }
};

}  // namespace solidus::mechanics
