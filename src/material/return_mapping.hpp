/// The local equation of the closest point projection in the flow multiplier γ (monograph 4.138–4.142).
///
///   Φ(γ) = ‖β̂(γ)‖ − (2Ĝ + ⅔w²K B) γ − w √⅔ [σ_0 + K_ξ(ξ* + w √⅔ γ)]
///   β̂(γ) = 2Ĝ ê + ⅔wK B ζ*,   B = 1/(1 + b γ)  (Prager: b = 0, β̂ fixed)
///   Φ(γ) = x,  γ = m Δt/η x (x/D)^(n−1)                                                (4.142, errata)
///
/// Φ falls with γ and is convex for every hardening that levels off, so Newton's method converges; a bracket
/// guards it where a table makes it neither. Nothing divides by η, f_S or the overstress x: both limits
/// (η = 0: Φ = 0, m = 0: γ = 0) are exact.
#pragma once

#include "base/tensor.hpp"
#include "material/hardening.hpp"

namespace solidus::material::return_mapping {

inline constexpr double k_two_thirds = 2.0 / 3.0;
inline constexpr double k_root_two_thirds = 0.81649658092772603;
/// Newton's correction below which one more iteration reaches rounding (quadratic convergence).
inline constexpr double k_last_correction = 1e-7;
inline constexpr int k_max_iterations = 80;

/// ‖a‖ with a derivative at a = 0, for automatic differentiation.
template <class T>
T smooth_norm(const Sym<T>& a) {
  using std::sqrt;
  return sqrt(T(dot(a, a) + T(1e-300)));
}

template <class T>
struct Problem {
  IsotropicHardening isotropic;
  const FlowCurves* curves;
  const FlowProperties<T>* flow;
  bool recalls;             ///< b > 0
  T twice_shear, strength;  ///< 2Ĝ, w
  T rate;                   ///< m Δt [s]
  T recall;                 ///< b
  Sym<T> trial;             ///< 2Ĝ ê, the trial deviator
  Sym<T> back_strain;       ///< ζ*
  T hardening;              ///< ξ*
};

/// Φ and what belongs to it at one γ.
template <class T>
struct Yield {
  T value, slope;    ///< Φ, Φ' < 0
  Sym<T> direction;  ///< n
  T norm;            ///< ‖β̂‖
  T fading;          ///< B
  Sym<T> drift;      ///< ∂β̂/∂γ (Armstrong–Frederick)
};

template <class T>
Yield<T> yield(const Problem<T>& p, const T& gamma) {
  const T w = p.strength, modulus = T(k_two_thirds) * w * p.flow->kinematic_modulus;  // ⅔wK
  Yield<T> y;
  y.fading = p.recalls ? T(T(1.0) / (T(1.0) + p.recall * gamma)) : T(1.0);
  const Sym<T> relative = p.trial + T(modulus * y.fading) * p.back_strain;
  y.norm = smooth_norm(relative);
  y.direction = T(T(1.0) / y.norm) * relative;
  const T step = T(k_root_two_thirds) * w;
  const auto k = hardening_stress<T>(p.isotropic, *p.curves, *p.flow, T(p.hardening + step * gamma));
  y.value =
      y.norm - (p.twice_shear + w * modulus * y.fading) * gamma - step * (p.flow->flow_stress + k.stress);
  y.slope = -(p.twice_shear + w * modulus * y.fading * y.fading) - step * step * k.slope;
  if (p.recalls) {
    y.drift = T(-modulus * p.recall * y.fading * y.fading) * p.back_strain;
    y.slope += dot(y.direction, y.drift);
  }
  return y;
}

template <class T>
struct Solution {
  T gamma;
  T overstress;         ///< x [Pa]
  T inverse_stiffness;  ///< dγ/dΦ^trial = 1/(dx/dγ − Φ') [1/Pa]
  bool converged;
};

/// n = 1: m Δt Φ(γ) = η γ.
template <class T>
Solution<T> solve_linear_rate(const Problem<T>& p, const Yield<T>& trial) {
  using Mask = decltype(trial.value > trial.value);
  const T eta = p.flow->viscosity, c = p.rate;
  const Mask plastic = (trial.value > T(0.0)) & (c > T(0.0)), at_rest = !plastic;
  const bool linear =
      !p.recalls && (p.isotropic == IsotropicHardening::none || p.isotropic == IsotropicHardening::linear);
  // From γ = 0 Newton's first step is the solution of a linear equation, and lies below it otherwise.
  const T one(1.0), tiny(1e-200);
  T stiffness = select(plastic, T(eta - c * trial.slope), one);
  T gamma = select(plastic, T(c * trial.value / stiffness), T(0.0));
  bool converged = true;
  if (!linear) {
    const T elastic =
        p.twice_shear +
        (p.recalls ? T(0.0) : T(T(k_two_thirds) * p.strength * p.strength * p.flow->kinematic_modulus));
    T low(0.0), high = T(1.001) * trial.value / select(elastic > tiny, elastic, tiny);
    converged = false;
    for (int i = 0; i < k_max_iterations; ++i) {
      const Yield<T> y = yield(p, gamma);
      const T f = c * y.value - eta * gamma;
      stiffness = select(plastic, T(eta - c * y.slope), one);
      low = select(f > T(0.0), gamma, low);
      high = select(f < T(0.0), gamma, high);
      T next = gamma + f / stiffness;
      const Mask outside = (next < low) | (next > high);
      if (converged) {  // the last correction, free of the bracket, so that derivatives pass through it
        gamma = select(plastic, next, gamma);
        break;
      }
      next = select(outside, T(T(0.5) * (low + high)), next);
      const T change = next - gamma;
      gamma = select(plastic, next, gamma);
      const T small = T(k_last_correction) * gamma;
      converged = all(at_rest | ((change <= small) & (T(0.0) - change <= small)));
    }
  }
  Solution<T> s;
  s.gamma = gamma;
  s.overstress = select(plastic, T(eta * gamma / select(plastic, c, one)), T(0.0));
  s.inverse_stiffness = select(plastic, T(c / stiffness), T(0.0));
  s.converged = converged;
  return s;
}

/// n >= 1: γ = A y^n with y = x/D, A = m Δt D/η. Newton's tangent is the same in γ and in y; the iterate goes
/// back to the curve at the new y where viscosity rules (A small) and at the new γ where plasticity does, so
/// that neither the infinite slope of γ^(1/n) at zero nor an infinite A is met.
template <class T>
Solution<T> solve_power_rate(const Problem<T>& p, const Yield<T>& trial) {
  using Mask = decltype(trial.value > trial.value);
  const T zero(0.0), one(1.0), tiny(1e-200);
  const T n = p.flow->exponent, drag = p.flow->drag_stress, eta = p.flow->viscosity;
  const Mask plastic = (trial.value > zero) & (p.rate > zero), at_rest = !plastic;
  const T inverse_a = eta / (select(plastic, p.rate, one) * drag);
  const T a = select(inverse_a > tiny, T(one / select(inverse_a > tiny, inverse_a, one)), T(1e200));

  const T y_trial = select(plastic, T(trial.value / drag), one);
  const T gamma_rigid = select(plastic, T(T(0.0) - trial.value / trial.slope), one);
  const T gamma_viscous = a * power<T>(y_trial, n);
  const Mask viscous = gamma_viscous < gamma_rigid;
  const T elastic =
      p.twice_shear +
      (p.recalls ? zero : T(T(k_two_thirds) * p.strength * p.strength * p.flow->kinematic_modulus));
  T v = select(viscous, y_trial, gamma_rigid);
  T low = zero,
    high =
        T(1.001) * select(viscous, y_trial,
                          T(T(select(plastic, trial.value, zero)) / select(elastic > tiny, elastic, tiny)));
  Solution<T> s{zero, zero, zero, false};
  for (int i = 0; i < k_max_iterations; ++i) {
    const T base = select(viscous, v, T(v * inverse_a));
    const T raised =
        select(base > tiny, power<T>(select(base > tiny, base, one), select(viscous, n, T(one / n))), zero);
    const T gamma = select(viscous, T(a * raised), v), y = select(viscous, v, raised);
    const Yield<T> at = yield(p, gamma);
    const T r = at.value - drag * y;
    // dγ/dx, finite where viscosity rules, and dx/dγ, finite elsewhere
    const T compliance = select(viscous, T(n * gamma / (drag * select(viscous, y, one))), zero);
    const T stiffness = select(viscous, zero, T(drag * y / (n * select(gamma > tiny, gamma, one))));
    const T softening = one - at.slope * compliance;
    const T inverse = select(viscous, T(compliance / softening), T(one / (stiffness - at.slope)));
    const T dx = select(viscous, T(r / softening), T(stiffness * inverse * r)), dgamma = inverse * r;
    if (s.converged) {  // the last correction, free of the bracket, so that derivatives pass through it
      s.gamma = select(plastic, T(gamma + dgamma), zero);
      s.overstress = select(plastic, T(drag * y + dx), zero);
      s.inverse_stiffness = select(plastic, inverse, zero);
      break;
    }
    low = select(r > zero, v, low);
    high = select(r < zero, v, high);
    const T newton = v + select(viscous, T(dx / drag), dgamma);
    const Mask outside = (newton < low) | (newton > high);
    const T next = select(outside, T(T(0.5) * (low + high)), newton);
    const T moved = next - v, small = T(k_last_correction) * next;
    s.converged = all(at_rest | ((moved <= small) & (zero - moved <= small)));
    v = select(plastic, next, v);
  }
  return s;
}

}  // namespace solidus::material::return_mapping
