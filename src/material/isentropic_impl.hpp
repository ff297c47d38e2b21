/// Bodies of the templates of isentropic.hpp. Included by isentropic.hpp only.
#pragma once

#include "material/isentropic.hpp"

namespace solidus::material {
namespace detail {

/// What may be left of ΔS^E, in parts of C_v: a temperature of 1000 K is then exact to 1e-8 K. Rounding
/// leaves 1e-16, with a strain of 1 about 1e-14.
inline constexpr double k_entropy_tolerance = 1e-11;
inline constexpr int k_max_temperatures = 100;
/// A property keeps this part of its value along its line.
inline constexpr double k_kept_share = 0.25;

/// A line in the temperature.
template <class T>
Jet<T> along(const Table::Line<T>& line, const T& change) {
  return {line.value + line.slope * change, line.slope, T(0.0)};
}
template <class T>
Jet<T> along(const T& value, const T& slope, const T& change) {
  return {value + slope * change, slope, T(0.0)};
}

/// Where positive numbers stay above k_kept_share of their values.
template <class T>
class Range {
 public:
  explicit Range(const T& middle) : middle_(middle), low_(T(0.5) * middle), high_(T(2.0) * middle) {}
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

/// Values of jets.
template <class T>
[[gnu::always_inline]] inline Viscoplastic::Properties<T> values(const Viscoplastic::Properties<Jet<T>>& p) {
  const auto& e = p.elastic;
  const auto& f = p.flow;
  return {{e.bulk.v, e.shear.v, e.thermal_strain.v, e.solid_fraction.v, e.viscosity.v},
          {f.flow_stress.v, f.hardening_origin.v, f.saturation_stress.v, f.saturation_rate.v,
           f.hardening_modulus.v, f.reference_strain.v, f.hardening_exponent.v, f.kinematic_modulus.v,
           f.recall.v, f.viscosity.v, f.exponent.v, f.drag_stress.v, f.temperature.v, f.beyond.v}};
}

}  // namespace detail

template <class T>
Isentropic::Properties<T> Isentropic::properties_at(const T& temperature,
                                                    const T& initial_temperature) const {
  const Material& m = law_.material();
  const T zero(0.0), one(1.0);
  const auto now = law_.properties_at(temperature, initial_temperature);
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
  if (m.liquid_model == LiquidModel::modified_shear && m.solidification() != nullptr)
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
    d.saturation_stress = detail::line(flow.saturation_stress, temperature).slope;
    d.saturation_rate = detail::line(flow.saturation_rate, temperature).slope;
    d.hardening_modulus = detail::line(flow.hardening_modulus, temperature).slope;
    d.reference_strain = detail::line(flow.reference_strain, temperature).slope;
    d.hardening_exponent = detail::line(flow.hardening_exponent, temperature).slope;
    d.kinematic_modulus = detail::line(flow.kinematic_modulus, temperature).slope;
    range.keep(p.flow.saturation_rate, d.saturation_rate);
    range.keep(p.flow.hardening_modulus, d.hardening_modulus);
    range.keep(p.flow.reference_strain, d.reference_strain);
    range.keep(p.flow.kinematic_modulus, d.kinematic_modulus);
  }
  p.lowest = range.low();
  p.highest = range.high();
  return p;
}

template <class T>
[[gnu::always_inline]] inline Viscoplastic::Properties<Jet<T>> Isentropic::at_temperature(
    const Properties<T>& p, const T& temperature) const {
  using J = Jet<T>;
  const T change = temperature - p.temperature;
  const J young = detail::along(p.young, change), poisson = detail::along(p.poisson, change);
  const J from_reference = J::variable(temperature) - J(T(law_.material().expansion_reference));
  Viscoplastic::Properties<J> r;
  auto& e = r.elastic;
  e.bulk = young / (J(3.0) * (J(1.0) - J(2.0) * poisson));
  e.shear = young / (J(2.0) * (J(1.0) + poisson));
  if (law_.material().liquid_model == LiquidModel::modified_shear)
    e.shear = select(p.held_shear > T(0.0), J(p.held_shear), e.shear);
  e.thermal_strain = J(3.0) * detail::along(p.expansion, change) * from_reference + J(p.strain_offset);
  e.solid_fraction = p.solid_fraction;
  e.viscosity = p.viscosity;
  if (!law_.material().flow) return r;

  auto& f = r.flow;
  const FlowProperties<T>&v = p.flow, &d = p.flow_slope;
  f.flow_stress = v.flow_stress;
  f.hardening_origin = detail::along(v.hardening_origin, d.hardening_origin, change);
  f.saturation_stress = detail::along(v.saturation_stress, d.saturation_stress, change);
  f.saturation_rate = detail::along(v.saturation_rate, d.saturation_rate, change);
  f.hardening_modulus = detail::along(v.hardening_modulus, d.hardening_modulus, change);
  f.reference_strain = detail::along(v.reference_strain, d.reference_strain, change);
  f.hardening_exponent = detail::along(v.hardening_exponent, d.hardening_exponent, change);
  f.kinematic_modulus = detail::along(v.kinematic_modulus, d.kinematic_modulus, change);
  f.recall = v.recall;
  f.viscosity = v.viscosity;
  f.exponent = v.exponent;
  f.drag_stress = v.drag_stress;
  f.temperature = p.temperature;
  f.beyond = J(change, T(1.0), T(0.0));
  return r;
}

template <class T>
T Isentropic::entropy(const Properties<T>& p, const Sym<T>& strain, const State<T>& state) const {
  using J = Jet<T>;
  const T zero(0.0), one(1.0);
  const auto at = at_temperature(p, p.temperature);
  const Sym<T> elastic = dev(strain) - state.viscous_strain - state.plastic_strain;
  const T squared = dot(elastic, elastic), tr = trace(strain), f = p.solid_fraction;
  T spring = at.elastic.shear.d * squared;
  switch (law_.material().liquid_model) {
    case LiquidModel::modified_shear:
      spring *= f;
      break;
    case LiquidModel::degenerated:
      break;
    case LiquidModel::maxwell: {
      const auto mushy = f < one;
      const T kept = T(k_spring_strain * k_spring_strain) * f * f;
      const T held = select(squared < kept, squared, kept);
      spring = select(mushy, T(at.elastic.shear.d * held / select(f > zero, f, one)), spring);
      break;
    }
  }
  const J pull = at.elastic.bulk * at.elastic.thermal_strain;
  T s = pull.d * tr - T(0.5) * at.elastic.bulk.d * tr * tr - spring;
  if (law_.material().flow)
    s -= hardening_potential<J>(*law_.material().flow, at.flow, J(state.hardening),
                                J(dot(state.back_strain, state.back_strain)))
             .d;
  return s;
}

template <class T>
Isentropic::Response<T> Isentropic::update(const Properties<T>& p, const State<T>& start,
                                           const Sym<T>& strain, double dt) const {
  using std::log;
  const T zero(0.0);
  T theta = p.temperature, low = p.lowest, high = p.highest;
  const T tolerance = T(detail::k_entropy_tolerance) * p.capacity.value;
  const T base = p.capacity.value - p.capacity.slope * p.temperature;  // C_v at Θ = 0 on its line
  bool solved = false;
  for (int i = 0;; ++i) {
    const auto at = at_temperature(p, theta);
    Response<T> r;
    static_cast<Viscoplastic::Response<T>&>(r) = law_.update(detail::values(at), start, strain, dt);
    const Variation<T> variation(law_, at, start, strain, dt, r);
    const Derivatives<T> s = variation.entropy(false);
    const T change = theta - p.temperature;
    const T sensible = base * T(log(T(theta / p.temperature))) + p.capacity.slope * change;
    const T slope = s.temperature + (base + p.capacity.slope * theta) / theta;  // F' = C/Θ̄
    const T f = s.value + sensible - p.entropy;

    // Types that carry derivatives take one step more, which their derivatives need.
    const bool last = solved || i == detail::k_max_temperatures;
    solved = all(f <= tolerance) && all(-f <= tolerance);
    if (last || (solved && detail::is_plain<T>)) {
      r.temperature = theta;
      r.entropy_defect = f;
      r.thermal_left = variation.stress();
      r.thermal_right = symmetric() ? r.thermal_left : T(-1.0) * variation.entropy().strain;
      r.thermal_factor = T(1.0) / slope;
      if (!solved && r.status == Status::converged) r.status = Status::outside_range;
      return r;
    }
    low = select(f < zero, theta, low);
    high = select(f > zero, theta, high);
    const T step = T(0.0) - f / (theta * slope);  // of ln Θ, in which sensible heat is linear
    const T newton = theta * (T(1.0) + step * (T(1.0) + T(0.5) * step));
    const T middle = T(0.5) * (low + high);
    theta = select(newton >= low, select(newton <= high, newton, middle), middle);
  }
}

}  // namespace solidus::material
