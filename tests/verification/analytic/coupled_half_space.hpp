/// A thermoelastic half space, suddenly heated at its free surface, with both directions of the coupling and
/// inertia: V. I. Danilovskaya (1950, 1952) without the heat of straining, R. E. Nickell, J. L. Sackman,
/// J. Appl. Mech. 35 (1968) 255–266 with it.
///
///        Θ_0 + ΔΘ │▒▒▒▒░░░░                 │ front ξ = τ
///        σ = 0    │────────────────→ ξ
///
/// With ξ = x c/a, τ = t c²/a, a = k/C, c² = (λ+2μ)/ρ, temperature θ = (Θ − Θ_0)/ΔΘ, displacement
/// û = u (λ+2μ) c/(β ΔΘ a), stress σ̂ = σ/(β ΔΘ), β = 3αK, the linear equations of uniaxial strain are
///
///   ∂²û/∂ξ² − ∂θ/∂ξ = ∂²û/∂τ²,  ∂²θ/∂ξ² = ∂θ/∂τ + δ ∂²û/∂ξ∂τ,  σ̂ = ∂û/∂ξ − θ,  δ = β²Θ_0/(C (λ+2μ))
///
/// at rest for τ < 0. At ξ = 0: σ̂ = 0, and θ = 1 or a film −∂θ/∂ξ = η (1 − θ), η = h a/(k c).
/// The transforms are sums of two modes e^{−mξ} with m⁴ − m² s (s + 1 + δ) + s³ = 0. The first,
/// m_1 = s + δ/2 + …, is the wave: nothing before ξ = τ, then a jump of σ̂ that decays like e^{−δξ/2} (for
/// θ = 1). It is inverted without its delay e^{−sξ}.
///
/// Each mode alone has branch points at 1 − δ ± 2i√δ that cancel in the sum, and grows like e^{(1−δ)τ}.
/// Validity: linear theory, |ΔΘ| << Θ_0; 0 <= δ <= 1, τ <= 10, to 1e-8 (where the tests compare).
#pragma once

#include <algorithm>
#include <limits>

#include "laplace_inversion.hpp"

namespace solidus::analytic {

struct CoupledHalfSpace {
  double coupling;                                        ///< δ
  double film = std::numeric_limits<double>::infinity();  ///< η; infinite: the surface is at θ = 1

  double temperature(double xi, double tau) const {
    return invert(xi, tau, [](const Mode& mode) { return mode.temperature; });
  }
  double displacement(double xi, double tau) const {
    return invert(xi, tau, [](const Mode& mode) { return mode.displacement; });
  }
  double stress(double xi, double tau) const {
    return invert(xi, tau, [](const Mode& mode) { return mode.stress; });
  }

 private:
  using Complex = std::complex<double>;
  /// The factors of e^{−mξ}, the first mode's of e^{−(m−s)ξ}.
  struct Mode {
    Complex exponent, temperature, displacement, stress;
  };
  struct Modes {
    Mode wave, heat;
  };

  Modes modes(Complex s) const {
    const double d = coupling;
    // √((s+1+δ)² − 4s) with cuts to the left of its zeros, ~ s far out
    const Complex zero(1 - d, 2 * std::sqrt(d)), root = std::sqrt(s - zero) * std::sqrt(s - std::conj(zero));
    // m_1² − s² without the difference of large numbers; m_1² m_2² = s³
    const Complex excess = 0.5 * s * (1 + d + (2 * (d - 1) * s + (1 + d) * (1 + d)) / (root + s));
    const Complex m1 = std::sqrt(s * s + excess), m2 = s * std::sqrt(s) / m1;
    // With A_2 = 1: U_2 from the equation of motion, U_1 from σ̂ = 0, A_1 from the equation of heat.
    const Complex u2 = -m2 / (m2 * m2 - s * s), u1 = -m1 * u2 / m2, a1 = -d * s * m1 * u1 / (m1 * m1 - s);
    const Complex scale =
        std::isinf(film) ? 1.0 / (s * (1.0 + a1)) : film / (s * ((m1 + film) * a1 + m2 + film));
    return {{excess / (m1 + s), scale * a1, scale * u1, -scale * s * s * u1 / m1},
            {m2, scale, scale * u2, -scale * s * s * u2 / m2}};
  }

  template <class Part>
  double invert(double xi, double tau, const Part& part) const {
    if (tau <= 0) return 0;
    const double rightmost = std::max(0.0, 1 - coupling);
    const auto heat = [&](Complex s) {
      const Mode mode = modes(s).heat;
      return part(mode) * std::exp(-mode.exponent * xi);
    };
    const auto wave = [&](Complex s) {
      const Mode mode = modes(s).wave;
      return part(mode) * std::exp(-mode.exponent * xi);
    };
    const double arrived = tau > xi ? inverse_laplace(wave, rightmost, tau - xi) : 0;
    return inverse_laplace(heat, rightmost, tau) + arrived;
  }
};

/// The units of the half space's dimensionless numbers.
struct HalfSpaceScales {
  double length, time, displacement, stress;  ///< of ξ [m], τ [s], û [m], σ̂ [Pa]
  double coupling;                            ///< δ
  /// @param k_th conductivity [W/(m K)]; @param c capacity [J/(m³ K)]; @param rho density [kg/m³]
  /// @param stiffness λ + 2μ [Pa]; @param beta 3αK [Pa/K]; @param start Θ_0 [K]; @param rise ΔΘ [K]
  HalfSpaceScales(double k_th, double c, double rho, double stiffness, double beta, double start,
                  double rise) {
    const double diffusivity = k_th / c, speed = std::sqrt(stiffness / rho);
    length = diffusivity / speed;
    time = length / speed;
    displacement = beta * rise * length / stiffness;
    stress = beta * rise;
    coupling = beta * beta * start / (c * stiffness);
  }
};

}  // namespace solidus::analytic
