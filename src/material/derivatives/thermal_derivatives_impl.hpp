/// Bodies of the templates of thermal_derivatives.hpp. Included by thermal_derivatives.hpp only.
#pragma once

#include "material/derivatives/thermal_derivatives.hpp"
#include "material/hardening_heat.hpp"
#include "material/viscoplastic_impl.hpp"

namespace solidus::material {

template <class T>
Viscoplastic::Properties<Jet<T>> thermal_properties(const Viscoplastic& law, const T& temperature,
                                                    const T& initial_temperature, Frozen frozen) {
  const auto hold = [](Jet<T>& a) { a = Jet<T>(a.v); };
  auto p = law.properties_at(Jet<T>::variable(temperature), Jet<T>(initial_temperature));
  if (frozen.phase) {
    hold(p.elastic.solid_fraction);
    for (const PhaseChange& change : law.material().phase_changes)
      p.elastic.thermal_strain.d -= T(change.volume_change) * detail::slope(change.fraction, temperature);
  }
  if (frozen.flow_stress) hold(p.flow.flow_stress);
  if (frozen.viscosity) {
    hold(p.elastic.viscosity);
    hold(p.flow.heat_share);
    for (Jet<T>& a : p.flow.rate) hold(a);
  }
  if (frozen.recall)
    for (Jet<T>& a : p.flow.recall) hold(a);
  return p;
}

/// The update at its solution, with its derivatives in Θ and, through covectors, in ε. All temperature
/// derivatives are those of the properties it is given.
template <class T>
class Variation {
 public:
  using J = Jet<T>;
  using State = Viscoplastic::State<T>;

  [[gnu::always_inline]] Variation(const Viscoplastic& law, const Viscoplastic::Properties<J>& p,
                                   const State& start, const Sym<T>& strain, const TimeStep& step,
                                   const Viscoplastic::Response<T>& r)
      : law_(law),
        p_(p),
        start_(start),
        shear_(law.shear(p.elastic, step.dt)),
        dt_(step.dt),
        extrapolated_(step.extrapolated),
        trace_(trace(strain)),
        trial_(dev(strain) - start.plastic_strain - start.viscous_strain),
        elastic_(trial_),
        zeta_(r.state.back_strain),
        xi_(r.state.hardening) {
    if (law.material().flow && any(r.flow_increment > T(0.0))) add_flow(r);
  }

  /// dσ/dΘ.
  [[gnu::always_inline]] Sym<T> stress() const {
    const J pressure = p_.elastic.bulk * (J(trace_) - p_.elastic.thermal_strain);
    Sym<T> slope = shear_.twice_shear.d * elastic_ + shear_.twice_shear.v * f_.elastic_theta;
    for (int i = 0; i < 3; ++i) slope[i] += pressure.d;
    return slope;
  }

  Derivatives<T> flow_increment() const {
    return {f_.gamma, f_.gamma_theta, T(f_.inverse * shear_.twice_shear.v) * f_.normal};
  }

  /// @param in_strain  false: without the covector
  [[gnu::always_inline]] Derivatives<T> entropy(bool in_strain = true) const {
    const J& k = p_.elastic.bulk;
    const J pull = k * p_.elastic.thermal_strain;
    const J volumetric_part = volumetric_energy(law_.material(), k, p_.elastic.thermal_strain, trace_);
    const J q =
        spring_slope(law_.material(), p_.elastic.shear, shear_.twice_shear, p_.elastic.solid_fraction);
    const T squared = dot(elastic_, elastic_);
    const T volumetric = k.d * trace_ - pull.d;
    Derivatives<T> s;
    s.value = T(0.0) - volumetric_part.d - q.v * squared;
    s.temperature =
        T(0.0) - volumetric_part.dd - q.d * squared - T(2.0) * q.v * dot(elastic_, f_.elastic_theta);
    if (!law_.material().flow) {
      if (in_strain) s.strain = T(-2.0 * q.v) * elastic_;
    } else {
      const Flow& flow = *law_.material().flow;
      const J stored = hardening_energy<J>(flow.isotropic, flow.curves, p_.flow, J(xi_));
      const J& kinematic = p_.flow.kinematic_modulus;
      const T third(1.0 / 3.0), zeta2 = dot(zeta_, zeta_);
      s.value -= stored.d + third * kinematic.d * zeta2;
      s.temperature -= stored.dd + f_.stress_theta * f_.xi_theta + third * kinematic.dd * zeta2 +
                       T(2.0) * third * kinematic.d * dot(zeta_, f_.zeta_theta);
      if (in_strain)
        s.strain = along_strain(T(-2.0 * q.v) * elastic_, T(T(-2.0) * third * kinematic.d) * zeta_,
                                T(0.0) - f_.stress_theta * radius().v);
    }
    if (in_strain)
      for (int i = 0; i < 3; ++i) s.strain[i] -= volumetric;
    return s;
  }

  /// Any function of the state.
  [[gnu::always_inline]] Derivatives<T> along(const StatePartials<T>& f) const {
    const T two(2.0);
    const Sym<T> by_elastic = T(two * f.elastic_squared) * elastic_;
    Derivatives<T> r;
    r.value = f.value;
    r.temperature = f.temperature + dot(by_elastic, f_.elastic_theta);
    if (!law_.material().flow) {
      r.strain = by_elastic;
    } else {
      const Sym<T> by_zeta = T(two * f.back_squared) * zeta_;
      r.temperature += f.hardening * f_.xi_theta + dot(by_zeta, f_.zeta_theta);
      r.strain = along_strain(by_elastic, by_zeta, f.hardening * radius().v);
    }
    for (int i = 0; i < 3; ++i) r.strain[i] += f.strain_trace;
    return r;
  }

  Derivatives<T> dissipation() const {
    const J viscous = J(T(1.0 / dt_)) * shear_.twice_shear * shear_.viscous_share;
    const T squared = dot(elastic_, elastic_);
    Derivatives<T> d;
    d.value = viscous.v * squared;
    d.temperature = viscous.d * squared + T(2.0) * viscous.v * dot(elastic_, f_.elastic_theta);
    const Sym<T> by_elastic = T(2.0 * viscous.v) * elastic_;
    if (!law_.material().flow) {
      d.strain = by_elastic;
      return d;
    }
    const T rate(1.0 / dt_);
    const Derivatives<T> free = unstored();
    const Derivatives<T> plastic = law_.material().flow->heat_share ? shared_heat(free) : free;
    d.value += rate * plastic.value;
    d.temperature += rate * plastic.temperature;
    d.strain = rate * plastic.strain + along_strain(by_elastic, zeros(), T(0.0));
    return d;
  }

  /// The energy of plastic work that is stored in addition to that of hardening, since the start of the step
  /// [J/m³]; the material has a Taylor–Quinney factor.
  Derivatives<T> cold_work() const {
    const Derivatives<T> free = unstored(), heat = shared_heat(free);
    return {free.value - heat.value, free.temperature - heat.temperature, free.strain - heat.strain};
  }

 private:
  J radius() const { return J(T(return_mapping::k_root_two_thirds)) * shear_.strength; }  // w √⅔

  /// D_plas Δt = γ f,  f = x + w √⅔ σ_0 + ⅔ K b ζ:ζ, without a Taylor–Quinney factor.
  Derivatives<T> unstored() const {
    const T zeta2 = dot(zeta_, zeta_);
    const J fixed = radius() * p_.flow.flow_stress;
    J recalled(T(0.0));
    T gained(0.0);  // in f with γ, as b does
    if (!law_.symmetric()) {
      const J modulus = J(T(return_mapping::k_two_thirds)) * p_.flow.kinematic_modulus;
      recalled = modulus * recall_;
      gained = modulus.v * recall_gamma_ * zeta2;
    }
    const T force = f_.overstress + fixed.v + recalled.v * zeta2;
    const T force_theta = f_.overstress_theta + f_.overstress_gamma * f_.gamma_theta + fixed.d +
                          recalled.d * zeta2 + T(2.0) * recalled.v * dot(zeta_, f_.zeta_theta) +
                          gained * f_.gamma_theta;
    return {f_.gamma * force, f_.gamma_theta * force + f_.gamma * force_theta,
            along_strain(zeros(), T(T(2.0) * f_.gamma * recalled.v) * zeta_,
                         force + f_.gamma * (f_.overstress_gamma + gained))};
  }

  /// β ⟨P⟩ of the plastic work P of the step.
  /// @param free  unstored()
  Derivatives<T> shared_heat(const Derivatives<T>& free) const {
    const T zero(0.0);
    const J& share = p_.flow.heat_share;
    const Derivatives<T> work = plastic_work(free);
    const auto heats = work.value > zero;
    const T beta = select(heats, share.v, zero), slope = select(heats, share.d, zero);
    return {beta * work.value, beta * work.temperature + slope * work.value, beta * work.strain};
  }

  /// K + ⅓ K ζ:ζ at the end of the step less that at its start, both at Θ.
  Derivatives<T> hardening_gain() const {
    const Flow& flow = *law_.material().flow;
    const J end = hardening_potential<J>(flow, p_.flow, J(xi_), J(dot(zeta_, zeta_)));
    const J begin = hardening_potential<J>(flow, p_.flow, J(start_.hardening),
                                           J(dot(start_.back_strain, start_.back_strain)));
    const Sym<T> by_zeta = T(T(return_mapping::k_two_thirds) * p_.flow.kinematic_modulus.v) * zeta_;
    return {end.v - begin.v, end.d - begin.d + f_.stress * f_.xi_theta + dot(by_zeta, f_.zeta_theta),
            along_strain(zeros(), by_zeta, f_.stress * radius().v)};
  }

  /// The plastic work P of the step: what is not stored and what hardening gains; from an extrapolated start
  /// s γ (n : ê − γ).
  Derivatives<T> plastic_work(const Derivatives<T>& free) const {
    if (!extrapolated_) {
      const Derivatives<T> gain = hardening_gain();
      return {free.value + gain.value, free.temperature + gain.temperature, free.strain + gain.strain};
    }
    const T left = dot(f_.normal, trial_) - f_.gamma;
    const J& s = shear_.twice_shear;
    const T by_gamma = s.v * (left - f_.gamma);
    const Sym<T> by_normal = T(s.v * f_.gamma) * across(trial_);
    const T work_theta = s.d * f_.gamma * left + by_gamma * f_.gamma_theta + dot(by_normal, f_.normal_theta);
    const T through_gamma = by_gamma + f_.per_norm * dot(by_normal, f_.drift);
    const Sym<T> by_strain = T(s.v * f_.gamma) * f_.normal + T(s.v * f_.per_norm) * by_normal +
                             T(through_gamma * f_.inverse * s.v) * f_.normal;
    return {s.v * f_.gamma * left, work_theta, by_strain};
  }

  /// a − n (n : a).
  Sym<T> across(const Sym<T>& a) const { return a - dot(f_.normal, a) * f_.normal; }

  [[gnu::always_inline]] void add_flow(const Viscoplastic::Response<T>& r) {
    const T zero(0.0), one(1.0);
    const auto flows = r.flow_increment > zero;
    f_.gamma = select(flows, r.flow_increment, zero);
    f_.inverse = select(flows, r.inverse_stiffness, zero);
    f_.overstress = select(flows, r.overstress, zero);
    const T inverse_norm = one / select(flows, r.relative_norm, one);
    for (int i = 0; i < 6; ++i) f_.normal[i] = select(flows, r.direction[i], zero);
    elastic_ = trial_ - f_.gamma * f_.normal;

    const Flow& flow = *law_.material().flow;
    const J& stiff = shear_.twice_shear;
    const J& w = shear_.strength;
    const J modulus = J(T(return_mapping::k_two_thirds)) * w * p_.flow.kinematic_modulus;
    const J xi = J(start_.hardening) + radius() * J(f_.gamma);
    J fading(one);
    T fading_gamma = zero;
    if (!law_.symmetric()) {
      const auto b = return_mapping::fading(flow.kinematic, p_.flow, w, xi, J(f_.gamma));
      fading = b.value;
      fading_gamma = T(0.0) - b.fall.v * fading.v * fading.v;
      recall_ = b.recall;
      recall_gamma_ = select(flows, T((b.fall.v - b.recall.v) / select(flows, f_.gamma, one)), zero);
    }
    const HardeningStress<J> k = hardening_stress<J>(flow.isotropic, flow.curves, p_.flow, xi);
    f_.stress = k.stress.v;
    f_.stress_theta = k.stress.d - k.slope.v * xi.d;

    // Φ at the solution as a function of temperature, n held: Φ_n is zero.
    const J pull = modulus * fading;
    const J phi = stiff * J(dot(f_.normal, trial_)) + pull * J(dot(f_.normal, start_.back_strain)) -
                  (stiff + w * pull) * J(f_.gamma) - radius() * (p_.flow.flow_stress + k.stress);
    rate_derivatives(flow);
    f_.gamma_theta = f_.inverse * (phi.d - f_.overstress_theta);

    // β̂ turns with temperature and, where back strain is recalled, with γ
    f_.per_norm = inverse_norm;
    f_.drift = across(T(modulus.v * fading_gamma) * start_.back_strain);
    const Sym<T> turn = across(stiff.d * trial_ + pull.d * start_.back_strain) + f_.gamma_theta * f_.drift;
    const Sym<T> normal_theta = inverse_norm * turn;
    f_.normal_theta = normal_theta;
    f_.elastic_theta = T(zero - f_.gamma_theta) * f_.normal - f_.gamma * normal_theta;

    // ζ = B (ζ* − w γ n)
    const T by_fading = one / fading.v;
    f_.zeta_gamma = T(fading_gamma * by_fading) * zeta_ - T(fading.v * w.v) * f_.normal;
    f_.zeta_turn = fading.v * w.v * f_.gamma;
    f_.zeta_theta = T(fading.d * by_fading) * zeta_ - T(fading.v * w.d * f_.gamma) * f_.normal +
                    f_.gamma_theta * f_.zeta_gamma - f_.zeta_turn * normal_theta;
    f_.xi_theta = xi.d + radius().v * f_.gamma_theta;
  }

  /// x_γ and x_Θ of x(γ/(m Δt), Θ), each at fixed other; Perzyna: γ = m Δt/η x (x/D)^(n−1).
  [[gnu::always_inline]] void rate_derivatives(const Flow& flow) {
    const T zero(0.0), one(1.0);
    const J& m = shear_.flow_share;
    if (flow.added_rate()) {
      const auto flows = f_.overstress > zero;
      const J time =
          J(T(dt_)) * J(select(flows, m.v, one), select(flows, m.d, zero), select(flows, m.dd, zero));
      const Overstress<J> x =
          material::overstress<J>(flow.rate_dependence, p_.flow, J(select(flows, f_.gamma, one)) / time);
      f_.overstress_gamma = select(flows, T(x.slope.v / time.v), zero);
      f_.overstress_theta = select(flows, x.stress.d, zero);
      return;
    }
    const J &eta = p_.flow.rate[Perzyna::viscosity], &n = p_.flow.rate[Perzyna::exponent],
            &d = p_.flow.rate[Perzyna::drag_stress];
    const auto liquid = !(m.v > zero);
    const auto viscous = f_.overstress > zero;
    const T x = f_.overstress, m_safe = select(liquid, one, m.v);
    const T per_n = one / n.v;
    f_.overstress_gamma = select(viscous, T(x * per_n / select(viscous, f_.gamma, one)), zero);
    if (flow.linear_rate()) {
      f_.overstress_theta = select(liquid, zero, T((eta.d * f_.gamma / T(dt_) - x * m.d) / m_safe));
      return;
    }
    using std::log;
    const T eta_safe = select(viscous, eta.v, one);
    const T size = log(T(select(viscous, x, d.v) / d.v));
    f_.overstress_theta =
        x * (d.d / d.v * (one - per_n) + per_n * (eta.d / eta_safe - m.d / m_safe - n.d * size));
  }

  /// The covector of a function of a, ζ and γ from its partial derivatives.
  Sym<T> along_strain(const Sym<T>& by_elastic, const Sym<T>& by_zeta, const T& by_gamma) const {
    const Sym<T> by_normal = across(f_.gamma * by_elastic + f_.zeta_turn * by_zeta);
    const T through_gamma = by_gamma - dot(by_elastic, f_.normal) + dot(by_zeta, f_.zeta_gamma) -
                            f_.per_norm * dot(by_normal, f_.drift);
    const T stiff = shear_.twice_shear.v;
    return by_elastic - T(stiff * f_.per_norm) * by_normal +
           T(through_gamma * f_.inverse * stiff) * f_.normal;
  }

  static Sym<T> zeros() { return {{T(0.0), T(0.0), T(0.0), T(0.0), T(0.0), T(0.0)}}; }

  const Viscoplastic& law_;
  const Viscoplastic::Properties<J>& p_;
  const State& start_;
  Viscoplastic::Shear<J> shear_;
  double dt_;
  bool extrapolated_;  ///< TimeStep::extrapolated
  T trace_;
  Sym<T> trial_, elastic_;  ///< ê, a
  Sym<T> zeta_;
  T xi_;
  J recall_{T(0.0)};     ///< b at fixed γ, of a law that recalls
  T recall_gamma_{0.0};  ///< b_γ
  /// What follows from plastic flow; zero without it.
  struct OfFlow {
    T gamma{0.0}, inverse{0.0}, per_norm{0.0}, overstress{0.0};
    T overstress_gamma{0.0}, overstress_theta{0.0};  ///< x_γ, x_Θ
    T stress{0.0}, stress_theta{0.0};                ///< K_ξ, K_ξΘ
    T gamma_theta{0.0}, xi_theta{0.0};
    T zeta_turn{0.0};  ///< ζ turns with n by −zeta_turn dn
    Sym<T> normal = zeros(), drift = zeros(), elastic_theta = zeros(), zeta_theta = zeros(),
           zeta_gamma = zeros(), normal_theta = zeros();
  };
  OfFlow f_;
};

template <class T>
ThermalDerivatives<T> thermal_derivatives(const Viscoplastic& law, const Viscoplastic::Properties<Jet<T>>& p,
                                          const Viscoplastic::State<T>& start, const Sym<T>& strain,
                                          const TimeStep& step, const Viscoplastic::Response<T>& response) {
  const Variation<T> v(law, p, start, strain, step, response);
  return {v.stress(), v.entropy(), v.dissipation(), v.flow_increment()};
}

}  // namespace solidus::material
