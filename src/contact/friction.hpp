/// Coulomb friction with a coefficient that hardens, softens and wears (monograph 3.5–3.7), as a point law in
/// the magnitude of the traction: the return mapping is radial (3.54, 5.30), so direction is the caller's.
///
///   Φ_c = ‖T‖ − μ(ζ_c, Θ_c) t_N <= 0                       (3.51, 3.63)
///   T   = T^trial (1 − ε_T γ/‖T^trial‖)                     (5.31a);  γ = Δt γ_c >= 0 is the slip of the
///   step μ   = μ_0(Θ_c) + Σ μ_p(Θ_c) ζ_c^p, or a table of ζ_c    (3.62) ζ_c grows by  γ t_N (3.53b),  γ μ
///   t_N (frictional work),  or γ (slip distance)
///
/// Conventions, validity and thermodynamics: docs/theory/friction.md.
#pragma once

namespace solidus::contact {

/// What the law is asked for at a point.
struct FrictionInput {
  double trial = 0;              ///< ‖T_n + ε_T ΔG‖ [Pa]
  double pressure = 0;           ///< t_N [Pa], >= 0
  double internal_variable = 0;  ///< ζ_c at t_n
  double temperature = 0;        ///< Θ_c at t_n [K]
};

struct FrictionResponse {
  bool sticks = true;
  double slip = 0;               ///< γ [m]
  double traction = 0;           ///< ‖T‖ [Pa]
  double coefficient = 0;        ///< μ at the end
  double internal_variable = 0;  ///< ζ_c at t_{n+1}
  double temperature = 0;        ///< Θ_c: as it was (isothermal), intermediate (isentropic, 5.24)
  double dissipation = 0;        ///< D_c,mech Δt [J/m²] (3.58)
  /// ∂‖T‖/∂‖T^trial‖ (1 where it sticks) and ∂‖T‖/∂t_N, of the law as it was solved.
  double trial_slope = 1, pressure_slope = 0;
};

}  // namespace solidus::contact
