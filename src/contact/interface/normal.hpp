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
/// s = 1/2 for the trapezoidal rule (mechanics/loads/motion.hpp). p_1 may alternate about t_N; displacements
/// and velocities do not feel that, they depend on t_N alone.
///
/// Wet contact. Between a melt and its wall there is no air: the atmosphere p_a that stands on the melt's
/// free surface and outside of the wall holds it there. Pressures are counted from p_a, so a wet interface
/// carries tension down to −p_a, and a gap that opens in it is void: t_N + p_a >= 0 and the gap exclude each
/// other. That is each of the laws above with another lower bound,
///
///   penalty               t_N = max(ε_N g_N, −p_a)
///   augmented Lagrangian  t_N = max(λ_N + ε_N g_N, −p_a),  λ_N >= −p_a
///   energy                W_c = ½ ε_N g_N² for g_N >= −p_a/ε_N, beyond it the line that goes on from there
///
/// monotone and with a convex energy as before. Which point is wet is known at t_n (ContactPair::begin).
///
/// Validity: ε_N large against the stiffness E/h of the elements next to the surface; the penetration left
/// over by the penalty is t_N/ε_N. A point that touches with g_N = 0 exactly counts as closed: a body that
/// rests on another has support in the first iteration, before any load has pressed it in. Source: monograph
/// 3.41a, 3.42a, 3.43, 5.19; J. C. Simo, T. A. Laursen, Comput. Struct. 42 (1992) 97 (multipliers);
/// T. A. Laursen, V. Chawla, Int. J. Numer. Meth. Eng. 40 (1997) 863 (quotient).
#pragma once

namespace solidus::contact {

enum class NormalKind { penalty, augmented_lagrangian, energy_conserving };

/// Quantities of t_n that the normal law depends on.
struct NormalHistory {
  bool partnered = false;       ///< there was a partner: the rest holds
  double penetration = 0;       ///< g_0 [m]
  double balance_pressure = 0;  ///< p_0 [Pa]
  double multiplier = 0;        ///< λ_N of now [Pa]
  double suction = 0;           ///< p_a of a wet point, of a dry one zero [Pa]
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
    if (kind == NormalKind::energy_conserving && old.partnered)
      return old.suction > 0 ? wet_quotient(penetration, old, share) : quotient(penetration, old, share);
    const double pressure = old.multiplier + penalty * penetration;
    if (old.suction > 0) {
      if (pressure < -old.suction) return {-old.suction, 0, -old.suction, 0, false};
      return {pressure, penalty, pressure, penalty, true};
    }
    if (pressure < 0 || (penetration < 0 && kind != NormalKind::augmented_lagrangian)) return {};
    return {pressure, penalty, pressure, penalty, true};
  }
  /// W_c [J/m²].
  /// @param suction  p_a of a wet point, of a dry one zero [Pa]
  double energy(double penetration, double suction = 0) const {
    if (suction == 0) return penetration > 0 ? 0.5 * penalty * penetration * penetration : 0.0;
    const double reach = -suction / penalty, spring = penetration > reach ? penetration : reach;
    return 0.5 * penalty * spring * spring + suction * (spring - penetration);
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
  /// The same quotient of the energy of a wet point.
  Response wet_quotient(double g1, const NormalHistory& old, double share) const {
    const double g0 = old.penetration, half = 0.5 * penalty, reach = -old.suction / penalty;
    Response r;
    if (g1 >= reach && g0 >= reach) {
      r = {half * (g1 + g0), half, 0, 0, true};
    } else if (g1 <= reach && g0 <= reach) {
      r = {-old.suction, 0, 0, 0, false};
    } else {
      const double high = g1 > g0 ? g1 : g0, low = g1 > g0 ? g0 : g1;
      r.pressure = (half * (high - reach) * (high + reach) - old.suction * (reach - low)) / (high - low);
      r.tangent = ((g1 > reach ? penalty * g1 : -old.suction) - r.pressure) / (g1 - g0);
      r.closed = true;
    }
    r.balance_pressure = (r.pressure - (1 - share) * old.balance_pressure) / share;
    r.balance_tangent = r.tangent / share;
    return r;
  }
};

}  // namespace solidus::contact
