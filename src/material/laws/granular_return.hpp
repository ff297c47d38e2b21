/// The stress of a granular solid at one temperature: a Drucker–Prager cone, cut off in tension and, where
/// the material is crushed, in compression.
///
/// Compression is negative; p = tr σ/3, s = dev σ, q = √(½ s : s):
///
///   q + η p ≤ ξc,   −p_c ≤ p ≤ p_t ≤ ξc/η
///   Δε^p = Δγ (s/2q + ⅓ η̄ 1) + ⅓ (Δμ_t − Δμ_c) 1
///
/// η, η̄ [1] slopes of cone and potential, ξc [Pa] shear strength without pressure, p_t [Pa] tension cut-off,
/// p_c [Pa] pressure of crushing, K and G [Pa] moduli. A trial stress outside returns to the cone, to one of
/// the two planes or to the edge where they meet; all of these are closed forms (E. A. de Souza Neto, D.
/// Perić, D. R. J. Owen, Computational Methods for Plasticity, Wiley 2008, section 8.3, of the cone and its
/// apex). An apex at p_t = ξc/η is the edge of radius zero.
///
/// η and ξ are those of the cone through the compressive corners of Mohr and Coulomb's pyramid, so that
/// triaxial compression has the friction angle φ and the cohesion c themselves:
///
///   η = 6 sin φ/(√3 (3 − sin φ)),   ξ = 6 cos φ/(√3 (3 − sin φ)),   ξ/η = cot φ
///
/// Validity: infinitesimal strain, 0 < φ < π/2, 0 ≤ η̄ ≤ η.
#pragma once

#include <algorithm>
#include <cmath>

#include "numbers/index_casts.hpp"
#include "numbers/tensor.hpp"

namespace solidus::material {

/// η of an angle of friction or dilatancy [rad].
inline double cone_slope(double angle) {
  return 6 * std::sin(angle) / (std::sqrt(3.0) * (3 - std::sin(angle)));
}
/// ξ of the angle of friction.
inline double cone_cohesion_factor(double angle) {
  return 6 * std::cos(angle) / (std::sqrt(3.0) * (3 - std::sin(angle)));
}

struct GranularStrength {
  double slope = 0, dilation = 0;      ///< η, η̄
  double shear = 0;                    ///< ξc [Pa]
  double tension = 0, crushing = 0;    ///< p_t, p_c [Pa]; p_c may be infinite
  double bulk = 0, shear_modulus = 0;  ///< K, G [Pa]
};

struct GranularReturn {
  Sym<double> stress;
  Sym4<double> tangent;  ///< ∂σ/∂ε of the step, on engineering shears
  double broken = 0;     ///< Δγ + Δμ_t: what shears or opens the solid, no compaction
  bool yields = false;
};

namespace detail {

/// Where a trial state (p, q) goes: new p and q, and the multiplier of the cone.
struct GranularPlace {
  enum class Face { elastic, cone, plane, edge } face = Face::elastic;
  double mean = 0, radius = 0;  ///< p, q [Pa]
  double slip = 0;              ///< Δγ
};

inline GranularPlace granular_place(const GranularStrength& m, double mean, double radius) {
  using Face = GranularPlace::Face;
  const double bounded = std::clamp(mean, -m.crushing, m.tension);
  const double excess = radius + m.slope * mean - m.shear;
  if (bounded == mean && excess <= 0) return {Face::elastic, mean, radius, 0};
  const auto at_plane = [&](double p) { return std::max(m.shear - m.slope * p, 0.0); };
  // The deviator may stay where the plane is met within the cone.
  if (bounded != mean && radius <= at_plane(bounded)) return {Face::plane, bounded, radius, 0};
  // Return to the cone; what leaves it beyond one of the planes belongs to their edge.
  const double slip = excess / (m.shear_modulus + m.bulk * m.slope * m.dilation);
  const double on_cone = mean - m.bulk * m.dilation * slip, left = radius - m.shear_modulus * slip;
  if (slip > 0 && left > 0 && on_cone <= m.tension && on_cone >= -m.crushing)
    return {Face::cone, on_cone, left, slip};
  const double p = mean > 0 || on_cone > m.tension || left <= 0 ? m.tension : -m.crushing;
  const double edge = at_plane(p);
  return {Face::edge, p, edge, (radius - edge) / m.shear_modulus};
}

}  // namespace detail

/// @param trial  stress without further flow [Pa]
inline GranularReturn granular_return(const GranularStrength& m, const Sym<double>& trial) {
  using Face = detail::GranularPlace::Face;
  const double k = m.bulk, g = m.shear_modulus;
  const double mean = trace(trial) / 3;
  const Sym<double> s = dev(trial);
  const double q = std::sqrt(0.5 * dot(s, s));
  const detail::GranularPlace to = detail::granular_place(m, mean, q);
  GranularReturn r;
  r.yields = to.face != Face::elastic;
  const double shrink = q > 0 ? to.radius / q : 1;
  r.stress = shrink * s;
  for (int i = 0; i < 3; ++i) r.stress[i] += to.mean;
  // Opening counts with slip: p = p_trial − K (η̄ Δγ + Δμ_t − Δμ_c).
  const double opened = r.yields ? (mean - to.mean) / k - m.dilation * to.slip : 0;
  r.broken = to.slip + std::max(to.face == Face::cone ? 0.0 : opened, 0.0);

  // dσ = 2G a dev dε + s (b s : dε + c tr dε) + 1 (d tr dε + e s : dε); a = shrink.
  double b = 0, c = 0, d = k, e = 0;
  if (to.face == Face::cone) {
    const double stiffness = g + k * m.slope * m.dilation;
    b = (to.slip / q - 1 / stiffness) * (g / q) * (g / q);
    c = -(g / q) * m.slope * k / stiffness;
    d = k - k * k * m.slope * m.dilation / stiffness;
    e = -k * m.dilation * g / (q * stiffness);
  } else if (to.face == Face::plane) {
    d = 0;
  } else if (to.face == Face::edge) {
    b = -shrink * g / (q * q);
    d = 0;
  }
  r.tangent = Sym4<double>::isotropic(d, 2 * g * shrink);
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) {
      const auto column = as_size(j);
      r.tangent[i][column] += b * s[i] * s[j];
      if (j < 3) r.tangent[i][column] += c * s[i];
      if (i < 3) r.tangent[i][column] += e * s[j];
    }
  return r;
}

}  // namespace solidus::material
