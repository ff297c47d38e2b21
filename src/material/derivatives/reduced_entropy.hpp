/// Elastic entropy and yield function of an update as functions of two numbers, the flow multiplier γ and the
/// temperature Θ, with their derivatives: the unknowns of Newton's method for 4.97. The tensors of the trial
/// state enter through tr ε, ê:ê, ê:ζ* and ζ*:ζ* only.
///
///   β̂ = s ê + m ζ*,  s = 2Ĝ,  m = ⅔wK B,  B = 1/(1 + b(ξ) γ),  ν = ‖β̂‖,  n = β̂/ν
///   Φ = ν − (s + w m) γ − w√⅔ [σ_0 + K_ξ(ξ, Θ)],  ξ = ξ* + w√⅔ γ                        (4.138, errata)
///   S = −½ k_Θ tr² + (k e^θ)_Θ tr − R_Θ − ½ s_Θ a:a − K_Θ(ξ, Θ) − ⅓ K_Θ ζ:ζ             (2.52b)
///   a:a = ê:ê − 2γ n:ê + γ²,  ζ:ζ = B² (ζ*:ζ* − 2wγ n:ζ* + w²γ²)
///
/// R is that of volumetric_energy(); K with arguments is the hardening potential, alone the kinematic
/// modulus; other symbols are those of viscoplastic.hpp. S is S^E without its sensible part. What is frozen
/// keeps its value while Θ varies, the rest follows its line; then S_γ = Φ_Θ, but where back strain is
/// recalled (b > 0). Included by isentropic.hpp only.
#pragma once

#include "material/derivatives/isentropic_lines.hpp"
#include "material/hardening.hpp"
#include "material/return_mapping.hpp"

namespace solidus::material {

/// The elastic part of S.
/// @param volumetric     volumetric_energy()
/// @param spring_slope   ½ s_Θ
/// @param squared        a:a
template <class T>
[[gnu::always_inline]] inline T elastic_entropy(const Jet<T>& volumetric, const T& spring_slope,
                                                const T& squared) {
  return T(0.0) - volumetric.d - spring_slope * squared;
}

namespace detail {

template <class T>
[[gnu::always_inline]] inline HardeningSlopes<T> hardening_slopes(const Flow& flow,
                                                                  const Isentropic::Properties<T>& p,
                                                                  const T& temperature, const T& xi) {
  const T zero(0.0);
  if (flow.isotropic == IsotropicHardening::none) return {zero, zero, zero, zero, zero};
  if (flow.isotropic == IsotropicHardening::linear) {
    const T slope = p.flow_slope.hardening[LinearHardening::modulus];
    const T modulus = p.flow.hardening[LinearHardening::modulus] + slope * (temperature - p.temperature);
    return {T(-0.5) * slope * xi * xi, zero, modulus * xi, slope * xi, modulus};
  }
  return curved_slopes<T>(flow, p.flow, p.flow_slope, p.temperature, temperature, xi);
}

}  // namespace detail

template <class T>
class ReducedEntropy {
 public:
  using Properties = Isentropic::Properties<T>;

  /// Terms of plastic flow at one (γ, Θ); zero without flow.
  struct Flowing {
    T squared, back_squared;            ///< a:a − ê:ê, ζ:ζ − ζ*:ζ*
    T entropy_theta, entropy_gamma;     ///< in S_Θ by n alone, S_γ
    T yield, yield_theta, yield_gamma;  ///< Φ, Φ_Θ, Φ_γ
    T inverse_norm;                     ///< 1/ν
    T along_trial, along_back;          ///< n:ê, n:ζ*
    T pull, pull_theta, pull_gamma;     ///< m, m_Θ, m_γ
    T kinematic_theta;                  ///< ⅔wK_Θ B²
  };
  /// All at one (γ, Θ).
  struct Point {
    T entropy, entropy_theta;      ///< S, S_Θ
    T pressure_theta;              ///< dp/dΘ
    T stiffness, stiffness_theta;  ///< s, s_Θ
    Flowing flow;
  };

  /// @param start, strain, dt  arguments of the update
  [[gnu::always_inline]] ReducedEntropy(const Viscoplastic& law, const Viscoplastic::State<T>& start,
                                        const Sym<T>& strain, double dt)
      : law_(law),
        flow_(law.material().flow ? &*law.material().flow : nullptr),
        dt_(dt),
        trace_(trace(strain)),
        hardening_(start.hardening),
        trial_(dev(strain) - start.plastic_strain - start.viscous_strain),
        back_(start.back_strain),
        ee_(dot(trial_, trial_)),
        ez_(dot(trial_, back_)),
        zz_(dot(back_, back_)) {}

  double dt() const { return dt_; }

  /// Whether the trial state at Θ_n lies beyond the yield surface in any lane.
  [[gnu::always_inline]] bool yields(const Properties& p) const {
    if (flow_ == nullptr) return false;
    const auto shear = law_.shear(elastic_values(p, elastic_along(law_.material(), p, p.temperature)), dt_);
    const T s = shear.twice_shear, w = shear.strength;
    const T m = w * T(return_mapping::k_two_thirds) * p.flow.kinematic_modulus;
    const T stress = hardening_stress<T>(flow_->isotropic, flow_->curves, p.flow, hardening_).stress;
    const T radius = T(return_mapping::k_root_two_thirds) * w * (p.flow.flow_stress + stress);
    return any(s * (s * ee_ + T(2.0) * m * ez_) + m * m * zz_ > radius * radius);
  }

  /// @param p, e   the numbers of Θ_n, and those of Θ
  /// @param gamma  γ, zero where nothing flows
  [[gnu::always_inline]] Point at(const Properties& p, const ElasticAlong<T>& e, const T& temperature,
                                  const T& gamma) const {
    const T zero(0.0), half(0.5);
    const auto shear = law_.shear(elastic_values(p, e), dt_);
    const Jet<T>& t = e.twice_shear;
    T share = liquid_shares(law_.material(), p.solid_fraction).spring,
      curvature = zero;  // of t_Θ in s_Θ; −(s_Θ/t_Θ)_t/(s_Θ/t_Θ)
    if (any(shear.viscous_share > zero)) {
      const T inverse = T(1.0) / t.v, ratio = shear.twice_shear * inverse;
      share *= ratio * ratio;
      curvature = T(2.0) * shear.viscous_share * inverse;
    }
    const T s = shear.twice_shear, s_theta = share * t.d, s_theta2 = share * (t.dd - curvature * t.d * t.d);
    const Jet<T> volumetric = volumetric_energy(law_.material(), e.bulk, e.thermal_strain, trace_);
    const T volumetric_theta = T(0.0) - volumetric.dd;
    const T pressure_theta = e.bulk.d * trace_ - e.pull_theta();
    if (flow_ == nullptr)
      return {elastic_entropy(volumetric, T(half * s_theta), ee_),
              volumetric_theta - half * s_theta2 * ee_,
              pressure_theta,
              s,
              s_theta,
              none()};
    const T xi = hardening_ + T(return_mapping::k_root_two_thirds) * shear.strength * gamma;
    const HardeningSlopes<T> hardening = detail::hardening_slopes<T>(*flow_, p, temperature, xi);
    const Flowing f = any(gamma > zero)
                          ? flowing(p, temperature, s, s_theta, shear.strength, hardening, xi, gamma)
                          : none();
    const T squared = ee_ + f.squared, back_squared = zz_ + f.back_squared;
    return {elastic_entropy(volumetric, T(half * s_theta), squared) + hardening.entropy -
                T(1.0 / 3.0) * p.flow_slope.kinematic_modulus * back_squared,
            volumetric_theta - half * s_theta2 * squared + hardening.entropy_theta + f.entropy_theta,
            pressure_theta,
            s,
            s_theta,
            f};
  }

  /// dσ/dΘ at fixed strain, γ eliminated by Φ = x(γ).
  /// @param inverse  ∂γ/∂Φ, zero where nothing flows
  [[gnu::always_inline]] Sym<T> stress_slope(const Point& at, const T& gamma, const T& inverse) const {
    const T gamma_theta = inverse * at.flow.yield_theta;
    const T turning = at.stiffness * gamma * at.flow.inverse_norm;
    const T pull = at.flow.pull_theta + at.flow.pull_gamma * gamma_theta;
    const T along_normal = turning * (at.stiffness_theta * at.flow.along_trial + pull * at.flow.along_back) -
                           at.stiffness_theta * gamma - at.stiffness * gamma_theta;
    return combined(at, turning, pull, along_normal);
  }

  /// −dS/dε at fixed temperature, γ eliminated: stress_slope but where back strain is recalled.
  [[gnu::always_inline]] Sym<T> minus_entropy_slope(const Point& at, const T& gamma, const T& inverse) const {
    const T turning = at.stiffness * gamma * at.flow.inverse_norm;
    const T along_normal =
        turning * (at.stiffness_theta * at.flow.along_trial + at.flow.kinematic_theta * at.flow.along_back) -
        at.stiffness_theta * gamma - at.stiffness * inverse * at.flow.entropy_gamma;
    return combined(at, turning, at.flow.kinematic_theta, along_normal);
  }

 private:
  static Flowing none() {
    const T zero(0.0);
    return {zero, zero, zero, zero, zero, zero, zero, zero, zero, zero, zero, zero, zero, zero};
  }

  [[gnu::always_inline]] Flowing flowing(const Properties& p, const T& temperature, const T& s,
                                         const T& s_theta, const T& w, const HardeningSlopes<T>& k,
                                         const T& xi, const T& gamma) const {
    // All that depends on γ in ΔS^E and in the yield condition, with derivatives by temperature and γ (4.97),
    // at frozen flow stress. β̂ is the reduced stress s ê + m ζ*, whose norm is that of the yield function.
    const T zero(0.0), one(1.0), two(2.0);
    const bool recalls = !law_.symmetric();
    const T radius = T(return_mapping::k_root_two_thirds) * w;
    return_mapping::Fading<T> b{zero, one, zero};
    if (recalls) b = return_mapping::fading(flow_->kinematic, p.flow, w, xi, gamma);
    const T fading = b.value;
    const T modulus_slope = T(return_mapping::k_two_thirds) * p.flow_slope.kinematic_modulus;
    const T modulus = T(return_mapping::k_two_thirds) * p.flow.kinematic_modulus +
                      modulus_slope * (temperature - p.temperature);
    const T m = w * fading * modulus, m_theta = w * fading * modulus_slope;
    const T m_gamma = recalls ? T(zero - m * b.fall * fading) : zero;

    // First β̂:ê and β̂:ζ* and the norm, then their derivatives by temperature.
    const T by_e = s * ee_ + m * ez_, by_z = s * ez_ + m * zz_;  // β̂:ê, β̂:ζ*
    const T norm2 = s * by_e + m * by_z;
    using std::sqrt;
    const T norm = sqrt(select(gamma > zero, select(norm2 > zero, norm2, one), one)), inverse = one / norm;
    const T e = by_e * inverse, z = by_z * inverse;
    const T norm_theta = s_theta * e + m_theta * z;
    const T e_theta = (s_theta * ee_ + m_theta * ez_ - e * norm_theta) * inverse;
    const T z_theta = (s_theta * ez_ + m_theta * zz_ - z * norm_theta) * inverse;

    // Without recall of the back strain the yield condition is a straight line in γ but for hardening.
    const T back_squared = fading * fading * (zz_ + w * gamma * (w * gamma - two * z));
    const T kinematic_theta = m_theta * fading;
    const T yield_theta = norm_theta - (s_theta + w * m_theta) * gamma - radius * k.stress_theta;
    T yield_gamma = zero - (s + w * m) - radius * radius * k.slope, entropy_gamma = yield_theta;
    // With recall m depends on γ, and so do direction and norm.
    if (recalls) {
      const T norm_gamma = m_gamma * z;
      const T e_gamma = (m_gamma * ez_ - e * norm_gamma) * inverse;
      const T z_gamma = (m_gamma * zz_ - z * norm_gamma) * inverse;
      yield_gamma += norm_gamma - w * m_gamma * gamma;
      entropy_gamma = s_theta * (e + gamma * (e_gamma - one)) +
                      kinematic_theta * (z + gamma * (z_gamma - w)) - radius * k.stress_theta +
                      modulus_slope * b.fall * fading * back_squared;
    }
    return {.squared = gamma * (gamma - two * e),
            .back_squared = back_squared - zz_,
            .entropy_theta = gamma * (s_theta * e_theta + kinematic_theta * z_theta),
            .entropy_gamma = entropy_gamma,
            .yield = norm - (s + w * m) * gamma - radius * (p.flow.flow_stress + k.stress),
            .yield_theta = yield_theta,
            .yield_gamma = yield_gamma,
            .inverse_norm = inverse,
            .along_trial = e,
            .along_back = z,
            .pull = m,
            .pull_theta = m_theta,
            .pull_gamma = m_gamma,
            .kinematic_theta = kinematic_theta};
  }

  /// dp/dΘ 1 + s_Θ ê + along_normal n − turning (s_Θ ê + pull ζ*).
  [[gnu::always_inline]] Sym<T> combined(const Point& at, const T& turning, const T& pull,
                                         const T& along_normal) const {
    const T e = at.stiffness_theta * (T(1.0) - turning) + along_normal * at.stiffness * at.flow.inverse_norm;
    const T z = along_normal * at.flow.pull * at.flow.inverse_norm - turning * pull, p = at.pressure_theta;
    const Sym<T> r = e * trial_ + z * back_;
    return {{r[0] + p, r[1] + p, r[2] + p, r[3], r[4], r[5]}};
  }

  const Viscoplastic& law_;
  const Flow* flow_;
  double dt_;
  T trace_, hardening_;
  Sym<T> trial_, back_;  ///< ê, ζ*
  T ee_, ez_, zz_;
};

}  // namespace solidus::material
