/// A thick tube without axial strain under inner pressure, elastic and perfectly plastic: R. Hill, The
/// Mathematical Theory of Plasticity, 1950, chapter V.
///
///        axis     a     c        b
///          |   p →├▒▒▒▒▒┼────────┤      ▒ plastic, r < c
///
/// With the yield stress in shear k = σ_0/√3 (von Mises) and the axial stress the mean of the other two, von
/// Mises' criterion is σ_θ − σ_r = 2k, and equilibrium dσ_r/dr = (σ_θ − σ_r)/r gives
///
///   plastic:  σ_r = −p + 2k ln(r/a)               elastic:  σ_r, σ_θ = k c²/b² (1 ∓ b²/r²)
///   front:    p = 2k [ln(c/a) + (1 − c²/b²)/2]    first yield c = a, collapse c = b
///
/// That the axial stress is the mean is exact when the material is elastically incompressible, ν = 1/2: then
/// the axial deviator starts at zero and no flow moves it. The displacement is then u = k c²/(2 G r)
/// everywhere. For ν < 1/2 the axial stress of the elastic tube is ν (σ_r + σ_θ), so von Mises' stress is
/// larger by the term with (1 − 2ν)² and the tube yields earlier: first_yield(ν). The collapse pressure is
/// the same for every ν: at collapse the stresses do not change any more, so all strain rates are plastic and
/// the axial deviator must be zero.
#pragma once

#include <cmath>

namespace solidus::analytic {

struct PlasticTube {
  double inner, outer;  ///< a, b [m]
  double yield_stress;  ///< σ_0 [Pa]
  double pressure;      ///< p [Pa], below collapse()

  double k() const { return yield_stress / std::sqrt(3.0); }
  double pressure_at_front(double c) const {
    return 2 * k() * (std::log(c / inner) + (1 - c * c / (outer * outer)) / 2);
  }
  double first_yield() const { return pressure_at_front(inner); }
  double collapse() const { return pressure_at_front(outer); }
  /// The pressure of first yield at the bore of a compressible tube, from Lamé's stresses.
  double first_yield(double poisson) const {
    const double ratio = outer * outer / (inner * inner), compressible = 1 - 2 * poisson;
    return yield_stress * (ratio - 1) / std::sqrt(3 * ratio * ratio + compressible * compressible);
  }

  /// c; a below first yield. The pressure rises with c, so bisection finds it.
  double front() const {
    double low = inner, high = outer;
    if (pressure <= first_yield()) return inner;
    for (int i = 0; i < 100; ++i) {
      const double c = 0.5 * (low + high);
      (pressure_at_front(c) < pressure ? low : high) = c;
    }
    return 0.5 * (low + high);
  }

  double radial(double r) const {
    const double c = front();
    if (r < c) return -pressure + 2 * k() * std::log(r / inner);
    return elastic_scale(c) * (1 - outer * outer / (r * r));
  }
  double hoop(double r) const {
    const double c = front();
    if (r < c) return radial(r) + 2 * k();
    return elastic_scale(c) * (1 + outer * outer / (r * r));
  }
  double axial(double r) const { return 0.5 * (radial(r) + hoop(r)); }

  /// Radial displacement. The dilatation is elastic, (r u)'/r = (1 + ν)(1 − 2ν)/E (σ_r + σ_θ), and
  /// σ_r + σ_θ = (r² σ_r)'/r: so u = (1 + ν)(1 − 2ν)/E r σ_r + const/r. Exact for ν = 1/2; for ν < 1/2 in so
  /// far as no plastic strain is axial (Hill's assumption, exact with Tresca's flow rule).
  double displacement(double r, double young, double poisson) const {
    return (1 + poisson) / young *
           ((1 - 2 * poisson) * r * radial(r) +
            2 * (1 - poisson) * elastic_scale(front()) * outer * outer / r);
  }

 private:
  /// k c²/b² beyond first yield, Lamé's p a²/(b² − a²) before.
  double elastic_scale(double c) const {
    if (pressure <= first_yield()) return pressure * inner * inner / (outer * outer - inner * inner);
    return k() * c * c / (outer * outer);
  }
};

}  // namespace solidus::analytic
