/// The local equation of the closest point projection in the flow multiplier γ (monograph 4.138–4.142).
///
///   Φ(γ) = ‖β̂(γ)‖ − (2Ĝ + ⅔w²K B) γ − w √⅔ [σ_0 + K_ξ(ξ)],   ξ = ξ* + w √⅔ γ
///   β̂(γ) = 2Ĝ ê + ⅔wK B ζ*,   B = 1/(1 + b γ),   b = w √⅔ r(ξ)  (Prager: b = 0, β̂ fixed)
///   Φ(γ) = x(γ/(m Δt)),  Perzyna: γ = m Δt/η x (x/D)^(n−1)                             (4.142, errata)
///
/// Newton's method inside a bracket. Φ falls with γ and is convex for every hardening that levels off: there
/// Newton's method converges by itself, and the bracket rules where a table makes Φ concave or where a back
/// stress beyond its saturation makes it rise at first. Nothing divides by η, f_S or the overstress x: both
/// limits (η = 0: Φ = 0; m = 0: γ = 0) are exact.
#pragma once

#include <limits>

#include "material/hardening.hpp"
#include "material/kinematic.hpp"
#include "material/laws/perzyna.hpp"
#include "numbers/tensor.hpp"

namespace solidus::material::return_mapping {

inline constexpr double k_two_thirds = 2.0 / 3.0;
inline constexpr double k_root_two_thirds = 0.81649658092772603;
/// A correction of γ below which one more reaches rounding, in γ and in the slope that the tangent uses.
inline constexpr double k_last_correction = 1e-7;
/// Rounding error of a sum, in parts of its largest terms.
inline constexpr double k_rounding = 8 * std::numeric_limits<double>::epsilon();
/// Bisection alone would get there: the bracket is never wider than 1e12 solutions or so.
inline constexpr int k_max_iterations = 80;
/// Bounds are taken that much larger, so that rounding does not put the solution outside.
inline constexpr double k_beyond = 1 + 1e-3;

/// ‖a‖ with a derivative at a = 0, for automatic differentiation; and a finite a/‖a‖ there.
template <class T>
[[gnu::always_inline]] inline T smooth_norm(const Sym<T>& a) {
  using std::sqrt;
  return sqrt(T(dot(a, a) + T(1e-300)));
}

template <class T>
struct Problem {
  IsotropicHardening isotropic;
  KinematicHardening kinematic;
  RateDependence rate_dependence;
  const FlowCurves* curves;
  const FlowProperties<T>* flow;
  bool recalls;               ///< b > 0
  T twice_shear, strength;    ///< 2Ĝ, w
  T rate;                     ///< m Δt [s]
  const Sym<T>& trial;        ///< 2Ĝ ê, the trial deviator
  const Sym<T>& back_strain;  ///< ζ*
  T hardening;                ///< ξ*

  T pull() const { return T(k_two_thirds) * strength * flow->kinematic_modulus; }  ///< ⅔wK
  T stiffness() const { return twice_shear + strength * pull(); }                  ///< 2Ĝ + ⅔w²K
};

/// Φ and its derivatives and noise at one γ.
template <class T>
struct Yield {
  T value, slope;   ///< Φ, Φ'
  T noise;          ///< rounding error of Φ [Pa]
  Sym<T> relative;  ///< β̂; n = β̂/‖β̂‖
  T norm;           ///< ‖β̂‖
  T fading;         ///< B
  T recall;         ///< b, zero where nothing is recalled
  T drift;          ///< ∂β̂/∂γ = drift ζ*, zero where nothing is recalled
};

/// b, B and −B_γ/B² = b + γ b_γ of a law that recalls.
template <class T>
struct Fading {
  T recall, value, fall;
};
/// @param strength, xi  w, and ξ at the end
template <class T>
[[gnu::always_inline]] inline Fading<T> fading(KinematicHardening kind, const FlowProperties<T>& flow,
                                               const T& strength, const T& xi, const T& gamma) {
  const Recall<T> r = kinematic_recall(kind, flow, xi);
  const T step = T(k_root_two_thirds) * strength, recall = step * r.value;
  return {recall, T(T(1.0) / (T(1.0) + recall * gamma)), recall + gamma * (step * step * r.slope)};
}

/// Subtracts the radius from Φ and its slope from Φ'.
/// @return what enters the rounding of the radius [Pa]: hardening cancels (saturation) or is steep in ξ
template <class T>
[[gnu::always_inline]] inline T subtract_radius(const Problem<T>& p, const T& gamma, T& value, T& slope) {
  const T step = T(k_root_two_thirds) * p.strength, xi = p.hardening + step * gamma;
  const auto k = hardening_stress<T>(p.isotropic, *p.curves, *p.flow, xi);
  value -= step * (p.flow->flow_stress + k.stress);
  slope -= step * step * k.slope;
  T terms = k.slope * xi;
  if (p.isotropic != IsotropicHardening::none && p.isotropic != IsotropicHardening::linear)
    terms += k.cancelled;
  return step * terms;
}

template <class T>
[[gnu::always_inline]] inline Yield<T> yield(const Problem<T>& p, const T& gamma) {
  const T modulus = p.pull(), zero(0.0), one(1.0), w = p.strength;
  Fading<T> f{zero, one, zero};
  if (p.recalls)
    f = fading(p.kinematic, *p.flow, w, T(p.hardening + T(k_root_two_thirds) * w * gamma), gamma);
  const T pull = modulus * f.value;
  const Sym<T> relative = p.trial + pull * p.back_strain;
  const T norm = smooth_norm(relative);
  T value = norm - (p.twice_shear + w * pull) * gamma, slope = -(p.twice_shear + w * pull * f.value);
  T drift = zero, terms = norm;
  if (p.recalls) {
    drift = -pull * f.fall * f.value;
    slope += drift * dot(relative, p.back_strain) / norm + w * pull * f.value * gamma * (f.fall - f.recall);
    terms = smooth_norm(p.trial) + modulus * smooth_norm(p.back_strain);
  }
  const T noise = T(k_rounding) * (terms + subtract_radius(p, gamma, value, slope));
  return {value, slope, noise, relative, norm, f.value, f.recall, drift};
}

/// The scalars of Yield alone, which suffice for the iteration.
template <class T>
struct YieldScalars {
  T value, slope, noise;
};
template <class T>
[[gnu::always_inline]] inline YieldScalars<T> point(const Problem<T>& p, const Yield<T>& trial,
                                                    const T& gamma) {
  if (p.recalls) {
    const Yield<T> y = yield(p, gamma);
    return {y.value, y.slope, y.noise};
  }
  const T stiffness = p.stiffness();  // β̂ stays
  T value = trial.norm - stiffness * gamma, slope = -stiffness;
  const T noise = T(k_rounding) * (trial.norm + subtract_radius(p, gamma, value, slope));
  return {value, slope, noise};
}

/// A γ with Φ(γ) <= 0. Prager: Φ falls at least as fast as (2Ĝ + ⅔w²K) γ. With recall:
/// Φ <= (2Ĝ‖ê‖ − 2Ĝ γ) + ⅔wK B (‖ζ*‖ − w γ) − R, and both terms are negative beyond ‖ê‖ and ‖ζ*‖/w.
template <class T>
T upper_bound(const Problem<T>& p, const Yield<T>& trial) {
  const auto ratio = [](const T& a, const T& b) {
    const auto fine = b > T(0.0);
    return select(fine, T(a / select(fine, b, T(1.0))), T(0.0));
  };
  if (!p.recalls) return T(k_beyond) * ratio(trial.value, p.stiffness());
  const T elastic = ratio(smooth_norm(p.trial), p.twice_shear);
  const T kinematic = ratio(smooth_norm(p.back_strain), p.strength);
  return T(k_beyond) * select(elastic > kinematic, elastic, kinematic);
}

/// The largest Φ(γ) that recall allows: ‖β̂‖ is convex in B and stays below its values at B = 1 and 0.
template <class T>
T largest_overstress(const Problem<T>& p, const Yield<T>& trial) {
  const T freed = smooth_norm(p.trial) - trial.norm;
  return trial.value + select(freed > T(0.0), freed, T(0.0));
}

/// Guards Newton's method on a function that falls through zero between 0 and `high`: every iterate becomes
/// an end of the bracket, and a step that leaves it, or is not a number, goes to its middle.
template <class T>
class Bracket {
 public:
  explicit Bracket(const T& high) : low_(0.0), high_(high) {}

  T inside(const T& v) const { return select(both(v > low_, v < high_), v, T(T(0.5) * (low_ + high_))); }
  /// The next iterate.
  /// @param v, f    the last one and the function there
  /// @param newton  where Newton's method goes from there
  T next(const T& v, const T& f, const T& newton) {
    low_ = select(f > T(0.0), v, low_);
    high_ = select(f < T(0.0), v, high_);
    return inside(newton);
  }

 private:
  T low_, high_;
};

template <class T>
struct Solution {
  T gamma;
  T overstress;         ///< x [Pa]
  T inverse_stiffness;  ///< dγ/dΦ^trial = 1/(dx/dγ − Φ') [1/Pa]
  bool converged;
};

/// Whether there is plastic flow: outside the yield surface, and neither liquid nor without any stiffness.
template <class T>
[[gnu::always_inline]] inline auto flows(const Problem<T>& p, const Yield<T>& trial) {
  const T zero(0.0);
  return both(both(trial.value > zero, p.rate > zero), p.stiffness() > zero);
}

/// The correction after which one more ends the iteration, as a part of γ. Between the kinks of a law (points
/// of a table) Newton's method is exact, but one may lie within any distance: there only Φ tells.
template <class T>
T last_correction(const Problem<T>& p) {
  return T(detail::hardening_kinks[static_cast<std::size_t>(p.isotropic)]
               ? std::numeric_limits<double>::epsilon()
               : k_last_correction);
}

/// |a| <= b.
template <class T>
auto within(const T& a, const T& b) {
  return both(a <= b, T(0.0) - a <= b);
}

/// n = 1: m Δt Φ(γ) = η γ.
template <class T>
[[gnu::always_inline]] inline Solution<T> solve_linear_rate(const Problem<T>& p, const Yield<T>& trial) {
  const T zero(0.0), one(1.0), eta = p.flow->rate[Perzyna::viscosity], c = p.rate;
  const auto plastic = flows(p, trial);
  // The first step of Newton's method solves a linear equation.
  const T first = c / select(plastic, T(eta - c * trial.slope), one);
  Solution<T> s{select(plastic, T(first * trial.value), zero), zero, select(plastic, first, zero), true};
  const bool linear =
      !p.recalls && (p.isotropic == IsotropicHardening::none || p.isotropic == IsotropicHardening::linear);
  if (!linear) {
    const T last = last_correction(p);
    Bracket<T> bracket(upper_bound(p, trial));
    T gamma = select(plastic, bracket.inside(s.gamma), zero);
    auto done = !plastic;
    s.converged = false;
    for (int i = 0; i < k_max_iterations; ++i) {
      const YieldScalars<T> at = point(p, trial, gamma);
      const T f = c * at.value - eta * gamma, stiffness = select(plastic, T(eta - c * at.slope), one);
      const T newton = gamma + f / stiffness;
      done = either(done, within(f, T(c * at.noise)));
      s.converged = all(done);
      if (s.converged) {  // the last correction, free of the bracket, so that derivatives pass through it
        s.gamma = select(both(plastic, newton > zero), newton, gamma);
        s.inverse_stiffness = select(plastic, T(c / stiffness), zero);
        break;
      }
      const T next = select(done, gamma, bracket.next(gamma, f, newton));  // a lane that is done stays
      done = either(done, within(T(next - gamma), T(last * next)));
      gamma = next;
    }
  }
  s.overstress = eta * s.gamma / select(plastic, c, one);
  return s;
}

/// n >= 1: γ = A y^n with y = x/D, A = m Δt D/η. Newton's tangent is the same in γ and in y; the iterate goes
/// back to the curve at the new y where viscosity rules (A small) and at the new γ where plasticity does, so
/// that neither the infinite slope of γ^(1/n) at zero nor an infinite A is met.
template <class T>
Solution<T> solve_power_rate(const Problem<T>& p, const Yield<T>& trial) {
  const T zero(0.0), one(1.0), tiny(1e-280);
  const T n = p.flow->rate[Perzyna::exponent], inverse_n = one / n, drag = p.flow->rate[Perzyna::drag_stress];
  const auto plastic = flows(p, trial);
  const T inverse_a = p.flow->rate[Perzyna::viscosity] / (select(plastic, p.rate, one) * drag);
  const auto flow_curve = [&](const T& base, const T& exponent) {  // base^exponent, base >= 0
    return select(base > tiny, power<T>(select(base > tiny, base, one), exponent), zero);
  };
  // Viscosity rules where the whole overstress flows less than the rate-independent solution.
  const T y_trial = select(plastic, T(trial.value / drag), one), bound = upper_bound(p, trial);
  const T rigid = select(plastic, Bracket<T>(bound).inside(T(trial.value / (zero - trial.slope))), one);
  const T y_rigid = flow_curve(T(rigid * inverse_a), inverse_n);
  const auto viscous = y_trial < y_rigid;
  const T a = select(viscous, T(one / select(viscous, inverse_a, one)), zero);

  const T last = last_correction(p);
  T y_bound = T(k_beyond) * y_trial;
  if (p.recalls) {  // Φ may rise at first
    const T overstress = largest_overstress(p, trial) / drag,
            flow = flow_curve(T(bound * inverse_a), inverse_n);
    y_bound = T(k_beyond) * select(overstress < flow, overstress, flow);
  }
  Bracket<T> bracket(select(viscous, y_bound, bound));
  // x changes little with γ where plasticity rules; at the least Newton's first iterate from `rigid`.
  const T share = one - y_rigid / y_trial, least = one / (n + one);
  T v = select(viscous, y_trial, T(rigid * select(share > least, share, least)));
  auto done = !plastic;
  Solution<T> s{zero, zero, zero, false};
  for (int i = 0; i < k_max_iterations; ++i) {
    const T raised = flow_curve(select(viscous, v, T(v * inverse_a)), select(viscous, n, inverse_n));
    const T gamma = select(viscous, T(a * raised), v), y = select(viscous, v, raised);
    const YieldScalars<T> at = point(p, trial, gamma);
    const T r = at.value - drag * y;
    // dγ/dx, finite where viscosity rules, and dx/dγ, finite elsewhere
    const T compliance = select(viscous, T(n * gamma / (drag * select(viscous, y, one))), zero);
    const T stiffness = select(viscous, zero, T(drag * y / (n * select(gamma > tiny, gamma, one))));
    const T softening = one - at.slope * compliance;
    const T inverse = select(viscous, compliance, one) / select(viscous, softening, T(stiffness - at.slope));
    const T dx = select(viscous, T(r / softening), T(stiffness * inverse * r)), dgamma = inverse * r;
    done = either(done, within(r, at.noise));
    s.converged = all(done);
    if (s.converged) {  // the last correction, free of the bracket, so that derivatives pass through it
      const T flow = gamma + dgamma, x = drag * y + dx;
      s.gamma = select(plastic, select(flow > zero, flow, gamma), zero);
      s.overstress = select(plastic, select(x > zero, x, T(drag * y)), zero);
      s.inverse_stiffness = select(plastic, inverse, zero);
      break;
    }
    const T newton = v + select(viscous, T(dx / drag), dgamma);
    const T next = select(done, v, bracket.next(v, r, newton));  // a lane that is done stays
    done = either(done, within(T(next - v), T(last * next)));
    v = next;
  }
  return s;
}

/// Any law x(γ̇) that rises from zero: Newton's method in γ for Φ(γ) = x(γ/(m Δt)), and in ln γ where that
/// would leave the bracket, since x may rise with a small power of γ.
template <class T>
Solution<T> solve_rate_law(const Problem<T>& p, const Yield<T>& trial) {
  using std::exp;
  const T zero(0.0), one(1.0);
  const auto plastic = flows(p, trial);
  const T time = select(plastic, p.rate, one), per_time = one / time, last = last_correction(p);
  Bracket<T> bracket(upper_bound(p, trial));
  T gamma = select(plastic, bracket.inside(trial.value / select(plastic, T(zero - trial.slope), one)), one);
  auto done = !plastic;
  Solution<T> s{zero, zero, zero, false};
  for (int i = 0; i < k_max_iterations; ++i) {
    const YieldScalars<T> at = point(p, trial, gamma);
    const Overstress<T> x = overstress(p.rate_dependence, *p.flow, T(gamma * per_time));
    const T rise = x.slope * per_time, inverse = one / select(plastic, T(rise - at.slope), one);
    const T r = at.value - x.stress, by = inverse * r;
    done = either(done, within(r, at.noise));
    s.converged = all(done);
    if (s.converged) {  // the last correction, free of the bracket, so that derivatives pass through it
      const T flow = gamma + by, stress = x.stress + rise * by;
      s.gamma = select(plastic, select(flow > zero, flow, gamma), zero);
      s.overstress = select(plastic, select(stress > zero, stress, x.stress), zero);
      s.inverse_stiffness = select(plastic, inverse, zero);
      break;
    }
    const T newton = gamma + by, scaled = gamma * T(exp(T(by / gamma)));
    const T next = select(done, gamma, bracket.next(gamma, r, select(newton > zero, newton, scaled)));
    done = either(done, within(T(next - gamma), T(last * next)));  // a lane that is done stays
    gamma = next;
  }
  return s;
}

extern template Solution<double> solve_power_rate(const Problem<double>&, const Yield<double>&);
extern template Solution<Lane> solve_power_rate(const Problem<Lane>&, const Yield<Lane>&);
extern template Solution<double> solve_rate_law(const Problem<double>&, const Yield<double>&);
extern template Solution<Lane> solve_rate_law(const Problem<Lane>&, const Yield<Lane>&);

}  // namespace solidus::material::return_mapping
