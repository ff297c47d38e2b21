/// Bodies of the templates of elasticity.hpp, for double, Lane and automatic differentiation. Included by
/// elasticity.hpp only.
#pragma once

#include <type_traits>

#include "material/elasticity.hpp"

namespace solidus::material {
namespace detail {

template <class T>
inline constexpr bool is_plain = std::is_same_v<T, double> || std::is_same_v<T, Lane>;

/// A piecewise-linear curve (Table, PhaseFraction) at any number type. An automatic-differentiation type x
/// has x.value(), and near it the curve is its line.
template <class T, class Curve>
T value(const Curve& curve, const T& x) {
  if constexpr (is_plain<T>) {
    return curve.value(x);
  } else {
    const double at = x.value();
    return T(curve.derivative(at)) * (x - T(at)) + T(curve.value(at));
  }
}
template <class T, class Curve>
T slope(const Curve& curve, const T& x) {
  if constexpr (is_plain<T>)
    return curve.derivative(x);
  else
    return T(curve.derivative(x.value()));
}

}  // namespace detail

template <class T>
PointProperties<T> properties_at(const Material& material, const T& temperature,
                                 const T& initial_temperature) {
  const T young = detail::value(material.young_modulus, temperature);
  const T poisson = detail::value(material.poisson_ratio, temperature);
  const T reference(material.expansion_reference);
  PointProperties<T> p;
  p.bulk = young / (T(3.0) * (T(1.0) - T(2.0) * poisson));
  p.shear = young / (T(2.0) * (T(1.0) + poisson));
  p.thermal_strain = T(3.0) * (detail::value(material.expansion, temperature) * (temperature - reference) -
                               detail::value(material.expansion, initial_temperature) *
                                   (initial_temperature - reference));  // 2.51
  p.solid_fraction = T(1.0);
  p.viscosity = T(1.0);  // any positive number where the material is always solid
  for (const PhaseChange& change : material.phase_changes) {
    if (change.volume_change == 0 && !change.solidification) continue;
    const T fraction = detail::value(change.fraction, temperature);
    if (change.volume_change != 0)
      p.thermal_strain += T(change.volume_change) *
                          (fraction - detail::value(change.fraction, initial_temperature));  // 2.75, 2.76a
    if (change.solidification) {
      p.solid_fraction = fraction;
      p.viscosity = detail::value(material.liquid_viscosity, temperature);
    }
  }
  return p;
}

template <class T>
PointDerivatives<T> derivatives_at(const Material& material, const T& temperature,
                                   const T& /*initial_temperature*/) {
  const T young = detail::value(material.young_modulus, temperature);
  const T poisson = detail::value(material.poisson_ratio, temperature);
  const T young_slope = detail::slope(material.young_modulus, temperature);
  const T poisson_slope = detail::slope(material.poisson_ratio, temperature);
  const T q = T(1.0) / (T(1.0) - T(2.0) * poisson);
  const T r = T(1.0) / (T(1.0) + poisson);
  PointDerivatives<T> d;
  d.bulk = T(1.0 / 3.0) * q * (young_slope + T(2.0) * young * poisson_slope * q);
  d.shear = T(0.5) * r * (young_slope - young * poisson_slope * r);
  d.thermal_strain = T(3.0) * (detail::value(material.expansion, temperature) +
                               detail::slope(material.expansion, temperature) *
                                   (temperature - T(material.expansion_reference)));
  d.solid_fraction = T(0.0);
  for (const PhaseChange& change : material.phase_changes) {
    if (change.volume_change == 0 && !change.solidification) continue;
    const T slope = detail::slope(change.fraction, temperature);
    d.thermal_strain += T(change.volume_change) * slope;
    if (change.solidification) d.solid_fraction = slope;
  }
  return d;
}

template <class T>
PointCurvatures<T> curvatures_at(const Material& material, const T& temperature) {
  const T young = detail::value(material.young_modulus, temperature);
  const T poisson = detail::value(material.poisson_ratio, temperature);
  const T young_slope = detail::slope(material.young_modulus, temperature);
  const T poisson_slope = detail::slope(material.poisson_ratio, temperature);
  const T q = T(1.0) / (T(1.0) - T(2.0) * poisson);
  const T r = T(1.0) / (T(1.0) + poisson);
  PointCurvatures<T> c;
  c.bulk = T(4.0 / 3.0) * poisson_slope * q * q * (young_slope + T(2.0) * young * poisson_slope * q);
  c.shear = -poisson_slope * r * r * (young_slope - young * poisson_slope * r);
  c.thermal_strain = T(6.0) * detail::slope(material.expansion, temperature);
  return c;
}

extern template PointProperties<double> properties_at(const Material&, const double&, const double&);
extern template PointProperties<Lane> properties_at(const Material&, const Lane&, const Lane&);
extern template PointDerivatives<double> derivatives_at(const Material&, const double&, const double&);
extern template PointDerivatives<Lane> derivatives_at(const Material&, const Lane&, const Lane&);
extern template PointCurvatures<double> curvatures_at(const Material&, const double&);
extern template PointCurvatures<Lane> curvatures_at(const Material&, const Lane&);

}  // namespace solidus::material
