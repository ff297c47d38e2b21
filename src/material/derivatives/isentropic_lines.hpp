/// The law's numbers at a temperature near Θ_n, along the lines of Isentropic::Properties: as values for the
/// isothermal law and with their derivatives. Each is made of the few numbers that it needs, since a struct
/// of jets costs more to fill than the update that reads it. Included by isentropic.hpp only.
#pragma once

#include "material/derivatives/isentropic.hpp"
#include "material/liquid.hpp"

namespace solidus::material {

namespace detail {

/// a/b of two lines.
template <class T>
[[gnu::always_inline]] inline Jet<T> ratio(const Table::Line<T>& a, const Table::Line<T>& b,
                                           const T& change) {
  const T inverse = T(1.0) / (b.value + b.slope * change);
  const T value = (a.value + a.slope * change) * inverse, slope = (a.slope - value * b.slope) * inverse;
  return {value, slope, T(-2.0) * slope * b.slope * inverse};
}

}  // namespace detail

/// k, 2G and e^θ at Θ.
template <class T>
struct ElasticAlong {
  Jet<T> bulk, twice_shear, thermal_strain;

  /// (k e^θ)_Θ and its derivative.
  [[gnu::always_inline]] T pull_theta() const {
    return bulk.d * thermal_strain.v + bulk.v * thermal_strain.d;
  }
  [[gnu::always_inline]] T pull_theta2() const {
    return bulk.dd * thermal_strain.v + T(2.0) * bulk.d * thermal_strain.d + bulk.v * thermal_strain.dd;
  }
};

template <class T>
[[gnu::always_inline]] inline ElasticAlong<T> elastic_along(const Material& m,
                                                            const Isentropic::Properties<T>& p,
                                                            const T& temperature) {
  const T zero(0.0), one(1.0), change = temperature - p.temperature;
  const Table::Line<T>&nu = p.poisson, &alpha = p.expansion;
  const T from_reference = temperature - T(m.expansion_reference);
  const T thrice = T(3.0) * (alpha.value + alpha.slope * change);
  ElasticAlong<T> r{detail::ratio(p.young, {T(3.0) * (one - T(2.0) * nu.value), T(-6.0) * nu.slope}, change),
                    detail::ratio(p.young, {one + nu.value, nu.slope}, change),
                    {thrice * from_reference + p.strain_offset,
                     thrice + T(3.0) * alpha.slope * from_reference, T(6.0) * alpha.slope}};
  if (holds_modulus(m.liquid_model)) {
    const auto held = p.held_shear > zero;
    r.twice_shear = {select(held, T(T(2.0) * p.held_shear), r.twice_shear.v),
                     select(held, zero, r.twice_shear.d), select(held, zero, r.twice_shear.dd)};
  }
  return r;
}

/// The numbers of the isothermal law at Θ.
template <class T>
[[gnu::always_inline]] inline PointProperties<T> elastic_values(const Isentropic::Properties<T>& p,
                                                                const ElasticAlong<T>& e) {
  return {e.bulk.v, T(0.5) * e.twice_shear.v, e.thermal_strain.v, p.solid_fraction, p.viscosity};
}
/// The numbers of the flow rule at Θ, as values and with their temperature derivatives.
template <class T>
[[gnu::always_inline]] inline FlowProperties<T> flow_values(const Isentropic::Properties<T>& p,
                                                            const T& temperature) {
  return flow_values<T>(p.flow, p.flow_slope, p.temperature, temperature);
}
template <class T>
[[gnu::always_inline]] inline FlowProperties<Jet<T>> flow_jets(const Isentropic::Properties<T>& p,
                                                               const T& temperature) {
  return flow_jets<T>(p.flow, p.flow_slope, p.temperature, temperature);
}

}  // namespace solidus::material
