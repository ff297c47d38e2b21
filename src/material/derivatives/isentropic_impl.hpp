/// Bodies of the templates of isentropic.hpp, as viscoplastic_impl.hpp.
#pragma once

#include "material/derivatives/isentropic.hpp"
#include "material/derivatives/reduced_entropy.hpp"
#include "material/hardening_heat.hpp"
#include "material/viscoplastic_impl.hpp"

namespace solidus::material {
namespace detail {

/// Tolerance of ΔS^E as a share of C_v: a temperature of 1000 K is then exact to 1e-8 K. Rounding leaves
/// 1e-16, with a strain of 1 about 1e-14.
inline constexpr double k_entropy_tolerance = 1e-11;
inline constexpr int k_max_temperatures = 100;
/// A defect after which one more step of Newton's method, which squares it, reaches the tolerance.
inline constexpr double k_last_defect = 3e-6;
inline constexpr int k_max_coupled = 4;
/// Temperatures after which an iteration that Newton's method leads out of the range tries its end.
inline constexpr int k_before_the_end = 4;
/// Θ̄ lies within this factor of Θ_n.
inline constexpr double k_largest_factor = 2;
/// A property keeps this part of its value along its line.
inline constexpr double k_kept_share = 0.25;
/// Value added to hardening moduli before k_kept_share is required of them, as a part of Young's modulus.
inline constexpr double k_spare_modulus = 0.01;

/// Range of temperatures in which positive properties, extrapolated along their lines, stay above
/// k_kept_share of their values.
template <class T>
class Range {
 public:
  explicit Range(const T& middle)
      : middle_(middle), low_(T(1 / k_largest_factor) * middle), high_(T(k_largest_factor) * middle) {}
  void keep(const T& value, const T& slope) {
    const T zero(0.0), steep(1e-200);
    const T rise = select(slope < zero, T(-slope), slope);
    const T reach = T(1.0 - k_kept_share) * value / select(rise > steep, rise, steep);
    const T below = middle_ - select(slope > zero, reach, middle_);
    const T above = middle_ + select(slope < zero, reach, middle_);
    const auto positive = value > zero;
    low_ = select(positive, select(below > low_, below, low_), low_);
    high_ = select(positive, select(above < high_, above, high_), high_);
  }
  const T& low() const { return low_; }
  const T& high() const { return high_; }

 private:
  T middle_, low_, high_;
};

template <class T>
[[gnu::always_inline]] inline T magnitude(const T& a) {
  return select(a < T(0.0), T(T(0.0) - a), a);
}

/// F and Θ F', the latter the slope in ln Θ, in which sensible heat is linear.
template <class T>
struct Defect {
  T value, slope;

  /// Returns the next iterate of Newton's method from θ.
  [[gnu::always_inline]] T step(const T& theta) const {
    const T by = T(0.0) - value / slope;
    return theta * (T(1.0) + by * (T(1.0) + T(0.5) * by));
  }
};

/// ∫C_v/Θ dΘ from Θ_n, less S^E_n.
template <class T>
class SensibleEntropy {
 public:
  [[gnu::always_inline]] explicit SensibleEntropy(const Isentropic::Properties<T>& p)
      : start_(p.entropy),
        slope_(p.capacity.slope),
        base_(p.capacity.value - p.capacity.slope * p.temperature),
        temperature_(p.temperature),
        inverse_(T(1.0) / p.temperature) {}

  /// @param entropy, entropy_theta  S and dS/dΘ, γ eliminated
  [[gnu::always_inline]] Defect<T> defect(const T& theta, const T& entropy, const T& entropy_theta) const {
    using std::log;
    return {entropy + (base_ * T(log(T(theta * inverse_))) + slope_ * (theta - temperature_)) - start_,
            theta * entropy_theta + (base_ + slope_ * theta)};
  }

 private:
  T start_, slope_, base_;  ///< S^E_n, and C_v = base + slope Θ
  T temperature_, inverse_;
};

/// n of x ~ γ^(1/n) near a solution of the isothermal mapping.
template <class T>
[[gnu::always_inline]] inline T rate_exponent(const Material& material, const Isentropic::Properties<T>& p,
                                              double dt, const Viscoplastic::Response<T>& r) {
  if (!material.flow || !material.flow->added_rate()) return p.flow.rate[Perzyna::exponent];
  const T zero(0.0), one(1.0);
  const auto flows = r.overstress > zero;
  const T rate = select(flows, r.flow_increment, one) /
                 (T(dt) * select(flows, liquid_shares(material, p.solid_fraction).flow, one));
  const Overstress<T> x = overstress(material.flow->rate_dependence, p.flow, rate);
  return select(flows, T(x.stress / (rate * x.slope)), one);
}

/// Newton's method in γ and Θ̄ together (4.97) from a solution of the isothermal mapping, whose overstress it
/// continues as x ~ γ^(1/n).
/// @param r, at     the solution at `theta`
/// @param defect    F there
/// @param by_newton  Θ̄ of the first step
/// @return Θ̄, near enough for one more isothermal mapping; where a step fails, the one before it
template <class T>
[[gnu::always_inline]] inline T coupled_newton(const Material& material, const Isentropic::Properties<T>& p,
                                               const ReducedEntropy<T>& s, const SensibleEntropy<T>& sensible,
                                               const Viscoplastic::Response<T>& r,
                                               const typename ReducedEntropy<T>::Point& at, const T& theta,
                                               const T& defect, const T& by_newton) {
  const T zero(0.0), one(1.0);
  const auto flows = r.flow_increment > zero;
  const T old_gamma = select(flows, r.flow_increment, one);
  const T close = T(k_last_defect) * p.capacity.value;
  const T exponent = rate_exponent(material, p, s.dt(), r);
  T result = by_newton, largest = magnitude(defect);
  T gamma =
      r.flow_increment + select(flows, T(r.inverse_stiffness * at.flow.yield_theta * (result - theta)), zero);
  for (int i = 0; i < k_max_coupled && any(largest > close); ++i) {
    const auto next = s.at(p, elastic_along(material, p, result), result, gamma);
    T excess = zero, gamma_theta = zero;  // γ less the solution at this temperature
    if (any(flows)) {
      const T ratio = select(flows, T(gamma / old_gamma), one), &n = exponent;
      const T overstress =
          r.overstress * (material.flow->linear_rate() ? ratio : power<T>(ratio, T(one / n)));
      const T stiffness = overstress / (n * ratio * old_gamma) - next.flow.yield_gamma;  // x_γ − Φ_γ
      const T inverse = select(flows, T(one / select(flows, stiffness, one)), zero);
      excess = inverse * (next.flow.yield - overstress);
      gamma_theta = inverse * next.flow.yield_theta;
    }
    const Defect<T> f = sensible.defect(result, T(next.entropy + next.flow.entropy_gamma * excess),
                                        T(next.entropy_theta + next.flow.entropy_gamma * gamma_theta));
    const T to = f.step(result), size = magnitude(f.value);
    const T flow = gamma + excess + gamma_theta * (to - result);
    auto good = size < largest;
    good = both(good, flow >= zero);
    result = select(good, to, result);
    gamma = select(good, flow, gamma);
    largest = select(good, size, zero);
  }
  return result;
}

/// Returns the start temperature of the iteration. If nothing yields at Θ_n it is close enough to Θ̄ for one
/// isothermal mapping there to suffice; else it is Θ_n.
template <class T>
[[gnu::always_inline]] inline T first_temperature(const Material& material,
                                                  const Isentropic::Properties<T>& p,
                                                  const ReducedEntropy<T>& s,
                                                  const SensibleEntropy<T>& sensible) {
  const T close = T(k_last_defect) * p.capacity.value;
  T result = p.temperature;
  if (s.yields(p)) return result;
  for (int i = 0; i < k_max_coupled; ++i) {
    const auto at = s.at(p, elastic_along(material, p, result), result, T(0.0));
    const Defect<T> f = sensible.defect(result, at.entropy, at.entropy_theta);
    const T to = f.step(result);
    auto inside = to >= p.lowest;
    inside = both(inside, to <= p.highest);
    result = select(inside, to, p.temperature);
    if (!any(magnitude(f.value) > close)) break;
  }
  return result;
}

}  // namespace detail

template <class T>
Isentropic::Properties<T> Isentropic::properties_at(const T& temperature, const T& initial_temperature,
                                                    const PhaseState<T>& phase) const {
  const Material& m = law_.material();
  const T zero(0.0), one(1.0);
  const auto now = law_.properties_at(temperature, initial_temperature, phase);
  Properties<T> p;
  p.temperature = temperature;
  p.young = detail::line(m.young_modulus, temperature);
  p.poisson = detail::line(m.poisson_ratio, temperature);
  p.expansion = detail::line(m.expansion, temperature);
  p.capacity = detail::line(m.specific_heat, temperature);
  p.capacity.value *= T(m.density);
  p.capacity.slope *= T(m.density);
  p.strain_offset =
      now.elastic.thermal_strain - T(3.0) * p.expansion.value * (temperature - T(m.expansion_reference));
  p.solid_fraction = now.elastic.solid_fraction;
  p.viscosity = now.elastic.viscosity;
  p.held_shear = zero;
  if (holds_modulus(m.liquid_model) && m.solidification() != nullptr)
    p.held_shear = select(temperature < T(m.solidification()->fraction.solidus()), zero, now.elastic.shear);

  detail::Range<T> range(temperature);
  range.keep(p.young.value, p.young.slope);
  range.keep(one - T(2.0) * p.poisson.value, T(-2.0) * p.poisson.slope);
  range.keep(one + p.poisson.value, p.poisson.slope);
  range.keep(p.capacity.value, p.capacity.slope);
  if (m.flow) {
    const Flow& flow = *m.flow;
    p.flow = now.flow;
    FlowProperties<T>& d = p.flow_slope;
    d.hardening_origin = detail::line(flow.flow_stress, temperature).slope;
    for (std::size_t i = 0; i < k_hardening_parameters; ++i)
      d.hardening[i] = detail::line(flow.hardening[i], temperature).slope;
    d.kinematic_modulus = flow.kinematic == KinematicHardening::none
                              ? zero
                              : detail::line(flow.kinematic_modulus, temperature).slope;
    // Moduli of hardening that end in zero may pass it on their line: the update is unique while G outweighs
    // them, and a positive value that is all but gone would leave no range.
    const T spare = T(detail::k_spare_modulus) * p.young.value,
            spare_slope = T(detail::k_spare_modulus) * p.young.slope;
    const auto parameters = hardening_law(flow.isotropic).parameters();
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      const T &value = p.flow.hardening[i], &slope = d.hardening[i];
      if (parameters[i].continuation == Continuation::positive) range.keep(value, slope);
      if (parameters[i].continuation == Continuation::modulus) range.keep(value + spare, slope + spare_slope);
    }
    range.keep(p.flow.kinematic_modulus + spare, d.kinematic_modulus + spare_slope);
  }
  p.lowest = range.low();
  p.highest = range.high();
  return p;
}

template <class T>
Viscoplastic::Properties<Jet<T>> Isentropic::at_temperature(const Properties<T>& p,
                                                            const T& temperature) const {
  const ElasticAlong<T> e = elastic_along(law_.material(), p, temperature);
  return {{e.bulk, Jet<T>(T(0.5)) * e.twice_shear, e.thermal_strain, p.solid_fraction, p.viscosity},
          flow_jets(p, temperature)};
}

template <class T>
T Isentropic::entropy(const Properties<T>& p, const Sym<T>& strain, const State<T>& state) const {
  using J = Jet<T>;
  const T zero(0.0), one(1.0);
  const auto at = elastic_along(law_.material(), p, p.temperature);
  const Sym<T> elastic = dev(strain) - state.viscous_strain - state.plastic_strain;
  const T squared = dot(elastic, elastic), shear = T(0.5) * at.twice_shear.d;
  const T a = liquid_shares(law_.material(), p.solid_fraction).spring;
  T spring = shear * squared;
  if (has_dashpot(law_.material().liquid_model)) {
    const auto mushy = p.solid_fraction < one;
    const T kept = T(k_spring_strain * k_spring_strain) * a * a;
    const T held = select(squared < kept, squared, kept);
    spring = select(mushy, T(shear * held / select(a > zero, a, one)), spring);
  } else {
    spring *= a;
  }
  T s = elastic_entropy(volumetric_energy(law_.material(), at.bulk, at.thermal_strain, T(trace(strain))), one,
                        spring);
  if (law_.material().flow)
    s -= hardening_potential<J>(*law_.material().flow, flow_jets(p, p.temperature), J(state.hardening),
                                J(dot(state.back_strain, state.back_strain)))
             .d;
  return s;
}

template <class T>
Isentropic::Response<T> Isentropic::update(const Properties<T>& p, const State<T>& start,
                                           const Sym<T>& strain, const TimeStep& step) const {
  const T zero(0.0), tolerance = T(detail::k_entropy_tolerance) * p.capacity.value;
  const ReducedEntropy<T> reduced(law_, start, strain, step.dt);
  const detail::SensibleEntropy<T> sensible(p);
  T theta = p.temperature, low = p.lowest, high = p.highest;
  if constexpr (detail::is_plain<T>) theta = detail::first_temperature(material(), p, reduced, sensible);
  bool solved = false;
  for (int i = 0;; ++i) {
    const auto elastic = elastic_along(material(), p, theta);
    auto r = law_.update<T>({elastic_values(p, elastic), flow_values(p, theta)}, start, strain, step);
    const auto at = reduced.at(p, elastic, theta, r.flow_increment);
    const auto f = sensible.defect(
        theta, at.entropy,
        T(at.entropy_theta + at.flow.entropy_gamma * r.inverse_stiffness * at.flow.yield_theta));

    // Beyond the end of its range the lines say nothing: Θ̄ stays there, and the update is the isothermal one.
    const T onward = f.step(theta), by = zero - f.value / f.slope;  // of ln Θ
    const T factor(detail::k_largest_factor);
    const auto above =
        both(theta >= p.highest, both(by > zero, theta * (T(1.0) + by) <= factor * p.temperature));
    const auto below =
        both(theta <= p.lowest, both(by < zero, factor * theta >= p.temperature * (T(1.0) - by)));
    const auto ended = either(above, below);

    // Types that carry derivatives take one step more, which their derivatives need.
    const bool last = solved || i == detail::k_max_temperatures;
    solved = all(either(ended, both(f.value <= tolerance, -f.value <= tolerance)));
    if (last || (solved && detail::is_plain<T>)) {
      if (!solved && r.status == Status::converged) r.status = Status::outside_range;
      const Sym<T> left = reduced.stress_slope(at, r.flow_increment, r.inverse_stiffness);
      return {r,
              theta,
              f.value,
              left,
              symmetric() ? left : reduced.minus_entropy_slope(at, r.flow_increment, r.inverse_stiffness),
              select(ended, zero, T(theta / f.slope))};
    }
    low = select(f.value < zero, theta, low);
    high = select(f.value > zero, theta, high);
    const auto inside = [&](const T& a, const T& otherwise) {
      return select(a >= low, select(a <= high, a, otherwise), otherwise);
    };
    T otherwise = T(0.5) * (low + high);
    if (i >= detail::k_before_the_end) {
      otherwise = select(both(f.value < zero, high >= p.highest), p.highest, otherwise);
      otherwise = select(both(f.value > zero, low <= p.lowest), p.lowest, otherwise);
    }
    const T coupled = detail::coupled_newton(material(), p, reduced, sensible, r, at, theta, f.value, onward);
    theta = inside(coupled, inside(onward, otherwise));
  }
}

// In isentropic.cpp. Entropy and update round alike there: a step without strain leaves no defect.
extern template Isentropic::Properties<double> Isentropic::properties_at(const double&, const double&,
                                                                         const PhaseState<double>&) const;
extern template Isentropic::Properties<Lane> Isentropic::properties_at(const Lane&, const Lane&,
                                                                       const PhaseState<Lane>&) const;
extern template Viscoplastic::Properties<Jet<double>> Isentropic::at_temperature(const Properties<double>&,
                                                                                 const double&) const;
extern template Viscoplastic::Properties<Jet<Lane>> Isentropic::at_temperature(const Properties<Lane>&,
                                                                               const Lane&) const;
extern template Lane Isentropic::entropy(const Properties<Lane>&, const Sym<Lane>&, const State<Lane>&) const;
extern template double Isentropic::entropy(const Properties<double>&, const Sym<double>&,
                                           const State<double>&) const;
extern template Isentropic::Response<double> Isentropic::update(const Properties<double>&,
                                                                const State<double>&, const Sym<double>&,
                                                                const TimeStep&) const;
extern template Isentropic::Response<Lane> Isentropic::update(const Properties<Lane>&, const State<Lane>&,
                                                              const Sym<Lane>&, const TimeStep&) const;

}  // namespace solidus::material
