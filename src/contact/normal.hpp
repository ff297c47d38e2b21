/// Normal contact by a penalty (monograph 3.43):
///
///   t_N = ε_N ⟨g_N⟩        W_c = ½ ε_N ⟨g_N⟩²  (3.41a)
///
/// t_N [Pa]   contact pressure, positive
/// ε_N [Pa/m] penalty
/// g_N [m]    penetration, positive where the bodies overlap; ⟨g⟩ = max(g, 0)
///
/// Validity: ε_N large against the stiffness E/h of the elements next to the surface; the penetration left
/// over is t_N/ε_N. A point that touches with g_N = 0 exactly counts as closed: a body that rests on another
/// has support in the first iteration, before any load has pressed it in. Source:
/// monograph 3.41a, 3.42a, 3.43.
#pragma once

namespace solidus::contact {

struct NormalPenalty {
  double penalty = 0;  ///< ε_N [Pa/m]

  struct Response {
    double pressure;  ///< t_N [Pa]
    double tangent;   ///< ∂t_N/∂g_N [Pa/m]
    double energy;    ///< W_c [J/m²]
    bool closed;
  };
  Response update(double penetration) const {
    if (penetration < 0) return {0, 0, 0, false};
    const double pressure = penalty * penetration;
    return {pressure, penalty, 0.5 * pressure * penetration, true};
  }
};

}  // namespace solidus::contact
