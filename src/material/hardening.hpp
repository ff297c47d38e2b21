/// Isotropic hardening: the part of the free energy that plastic flow stores, and the stress that it adds to
/// the flow stress (monograph 2.49d, 2.60).
///
///   K_ξ = ∂K/∂ξ, the flow stress is σ_0 + K_ξ:
///   linear      K_ξ = H ξ
///   saturation  K_ξ = (σ_∞ − σ_0)(1 − exp(−δ ξ)) + H ξ                                   (2.60; Voce 1948)
///   power       K_ξ = σ_0 [(1 + ξ/ε_0)^m − 1]                                            (Swift 1952)
///   table       K_ξ = σ(ξ, Θ) − σ(0, Θ), measured flow curves
///
/// Symbols: ξ equivalent plastic strain, σ_0, σ_∞, H [Pa], δ, ε_0, m numbers. Validity: ξ >= 0.
#pragma once

#include "base/jet.hpp"
#include "material/flow_properties.hpp"

namespace solidus::material {

template <class T>
struct HardeningStress {
  T stress, slope;  ///< K_ξ and K_ξξ [Pa]
};

namespace detail {

template <class T>
struct CurvePoint {
  T stress, slope, energy, stress_theta, slope_theta, energy_theta;  ///< FlowCurves::Value
};

inline CurvePoint<double> curve_point(const FlowCurves& curves, double xi, double theta) {
  const FlowCurves::Value v = curves.at(xi, theta);
  return {v.stress, v.slope, v.energy, v.stress_theta, v.slope_theta, v.energy_theta};
}
inline CurvePoint<Lane> curve_point(const FlowCurves& curves, Lane xi, Lane theta) {
  CurvePoint<Lane> r;
  for (int i = 0; i < k_lanes; ++i) {
    const FlowCurves::Value v = curves.at(xi[i], theta[i]);
    r.stress.set(i, v.stress);
    r.slope.set(i, v.slope);
    r.energy.set(i, v.energy);
    r.stress_theta.set(i, v.stress_theta);
    r.slope_theta.set(i, v.slope_theta);
    r.energy_theta.set(i, v.energy_theta);
  }
  return r;
}

}  // namespace detail

namespace detail {

/// The kinds that bend.
template <class T>
HardeningStress<T> curved_stress(IsotropicHardening kind, const FlowCurves& curves,
                                 const FlowProperties<T>& p, const T& xi) {
  using std::exp;
  switch (kind) {
    case IsotropicHardening::saturation: {
      const T rise = p.saturation_stress - p.hardening_origin;
      const T decay = exp(T(-p.saturation_rate * xi));
      return {rise * (T(1.0) - decay) + p.hardening_modulus * xi,
              rise * p.saturation_rate * decay + p.hardening_modulus};
    }
    case IsotropicHardening::power: {
      const T base = T(1.0) + xi / p.reference_strain;
      const T raised = power<T>(base, p.hardening_exponent);
      return {p.hardening_origin * (raised - T(1.0)),
              p.hardening_origin * p.hardening_exponent * raised / (base * p.reference_strain)};
    }
    case IsotropicHardening::table: {
      const auto at = detail::curve_point(curves, core(xi), core(p.temperature));
      const T dx = xi - T(core(xi)), dt = p.temperature - T(core(p.temperature)) + p.beyond;
      const T slope = T(at.slope) + T(at.slope_theta) * dt;
      return {T(at.stress) + slope * dx + T(at.stress_theta) * dt, slope};
    }
    case IsotropicHardening::none:
    case IsotropicHardening::linear:
      break;
  }
  return {T(0.0), T(0.0)};
}

}  // namespace detail

/// @param curves read by kind table only
// Inline where it is short: a call would make a return mapping keep all of its numbers in memory.
template <class T>
[[gnu::always_inline]] inline HardeningStress<T> hardening_stress(IsotropicHardening kind,
                                                                  const FlowCurves& curves,
                                                                  const FlowProperties<T>& p, const T& xi) {
  if (kind == IsotropicHardening::none) return {T(0.0), T(0.0)};
  if (kind == IsotropicHardening::linear) return {p.hardening_modulus * xi, p.hardening_modulus};
  return detail::curved_stress(kind, curves, p, xi);
}

/// K(ξ, Θ) [J/m³], the stored energy of isotropic hardening. On a Jet in temperature it carries K_Θ and
/// K_ΘΘ.
template <class T>
T hardening_energy(IsotropicHardening kind, const FlowCurves& curves, const FlowProperties<T>& p,
                   const T& xi) {
  using std::exp;
  switch (kind) {
    case IsotropicHardening::linear:
      return T(0.5) * p.hardening_modulus * xi * xi;
    case IsotropicHardening::saturation: {
      const T rise = p.saturation_stress - p.hardening_origin;
      const T decay = exp(T(-p.saturation_rate * xi));
      return rise * (xi - (T(1.0) - decay) / p.saturation_rate) + T(0.5) * p.hardening_modulus * xi * xi;
    }
    case IsotropicHardening::power: {
      const T base = T(1.0) + xi / p.reference_strain;
      const T above = p.hardening_exponent + T(1.0);
      return p.hardening_origin * (p.reference_strain * (power<T>(base, above) - T(1.0)) / above - xi);
    }
    case IsotropicHardening::table: {
      const auto at = detail::curve_point(curves, core(xi), core(p.temperature));
      const T dx = xi - T(core(xi)), dt = p.temperature - T(core(p.temperature)) + p.beyond;
      const T slope = T(at.slope) + T(at.slope_theta) * dt;
      return T(at.energy) + (T(at.stress) + T(0.5) * slope * dx + T(at.stress_theta) * dt) * dx +
             T(at.energy_theta) * dt;
    }
    case IsotropicHardening::none:
      break;
  }
  return T(0.0);
}

}  // namespace solidus::material
