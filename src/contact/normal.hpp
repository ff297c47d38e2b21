/// Normal contact (monograph 3.41a, 3.42a, 3.43), as a point law in the penetration g_N at t_{n+1}:
///
///   penalty               t_N = ε_N ⟨g_N⟩                                          W_c = ½ ε_N ⟨g_N⟩²
///   augmented Lagrangian  t_N = ⟨λ_N + ε_N g_N⟩, λ_N grows until g_N is small      W_c = ½ ε_N ⟨g_N⟩²
///   energy-conserving     t_N = ½ ε_N (⟨g_1⟩² − ⟨g_0⟩²)/(g_1 − g_0)   (5.19)       W_c = ½ ε_N ⟨g_N⟩²
///
/// t_N [Pa]   contact pressure, positive
/// ε_N [Pa/m] penalty
/// g_N [m]    penetration, positive where the bodies overlap; ⟨g⟩ = max(g, 0); g_0 at t_n, g_1 at t_{n+1}
/// λ_N [Pa]   multiplier
///
/// The quotient is a mean over the step: t_N (g_1 − g_0) is exactly what W_c gains. An integrator that works
/// with the mean s f_1 + (1 − s) f_0 of the forces at both ends gets it from a pressure in the balance
///
///   p_1 = [t_N − (1 − s) p_0]/s,
///
/// s = 1/2 for the trapezoidal rule (mechanics/motion.hpp). p_1 may alternate about t_N; displacements and
/// velocities do not feel that, they depend on t_N alone.
///
/// Validity: ε_N large against the stiffness E/h of the elements next to the surface; the penetration left
/// over by the penalty is t_N/ε_N. A point that touches with g_N = 0 exactly counts as closed: a body that
/// rests on another has support in the first iteration, before any load has pressed it in. Source: monograph
/// 3.41a, 3.42a, 3.43, 5.19; J. C. Simo, T. A. Laursen, Comput. Struct. 42 (1992) 97 (multipliers);
/// T. A. Laursen, V. Chawla, Int. J. Numer. Meth. Eng. 40 (1997) 863 (quotient).
#pragma once

namespace solidus::contact {

enum class NormalKind { penalty, augmented_lagrangian, energy_conserving };

/// What the law remembers of t_n.
struct NormalHistory {
  bool partnered = false;       ///< there was a partner: the rest holds
  double penetration = 0;       ///< g_0 [m]
  double balance_pressure = 0;  ///< p_0 [Pa]
  double multiplier = 0;        ///< λ_N of now [Pa]
};

struct NormalLaw {
  NormalKind kind = NormalKind::penalty;
  double penalty = 0;  ///< ε_N [Pa/m]

  struct Response {
    double pressure = 0, tangent = 0;                  ///< t_N [Pa], ∂t_N/∂g_N [Pa/m]
    double balance_pressure = 0, balance_tangent = 0;  ///< p_1 and its derivative
    bool closed = false;
  };
  /// @param share s, of t_{n+1} in the mean that the integrator works with
  Response update(double penetration, const NormalHistory& old, double share) const {
    if (kind == NormalKind::energy_conserving && old.partnered) return quotient(penetration, old, share);
    const double pressure = old.multiplier + penalty * penetration;
    if (pressure < 0 || (penetration < 0 && kind != NormalKind::augmented_lagrangian)) return {};
    return {pressure, penalty, pressure, penalty, true};
  }
  double energy(double penetration) const {  ///< W_c [J/m²]
    return penetration > 0 ? 0.5 * penalty * penetration * penetration : 0.0;
  }

 private:
  Response quotient(double g1, const NormalHistory& old, double share) const {
    const double g0 = old.penetration, half = 0.5 * penalty;
    Response r;
    if (g1 >= 0 && g0 >= 0) {
      r = {half * (g1 + g0), half, 0, 0, true};
    } else if (g1 >= 0) {
      const double path = g1 - g0;  // > 0
      r = {half * g1 * (g1 / path), half * (g1 / path) * (2 - g1 / path), 0, 0, true};
    } else if (g0 > 0) {
      const double path = g0 - g1;
      r = {half * g0 * (g0 / path), half * (g0 / path) * (g0 / path), 0, 0, true};
    }
    r.balance_pressure = (r.pressure - (1 - share) * old.balance_pressure) / share;
    r.balance_tangent = r.tangent / share;
    return r;
  }
};

}  // namespace solidus::contact
