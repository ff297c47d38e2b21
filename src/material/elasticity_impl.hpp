/// Bodies of the templates of elasticity.hpp, for double, Lane and automatic differentiation. Included by
/// elasticity.hpp only.
#pragma once

#include <limits>
#include <type_traits>

#include "material/elasticity.hpp"
#include "numbers/jet.hpp"

namespace solidus::material {
namespace detail {

template <class T>
inline constexpr bool is_plain = std::is_same_v<T, double> || std::is_same_v<T, Lane>;

/// A piecewise-linear curve (Table, PhaseFraction) at any number type: one that carries derivatives sees the
/// line near its value.
template <class T, class Curve>
T value(const Curve& curve, const T& x) {
  if constexpr (is_plain<T>) {
    return curve.value(x);
  } else {
    const auto at = core(x);
    return T(curve.derivative(at)) * (x - T(at)) + T(curve.value(at));
  }
}
/// Value and slope of a table.
template <class T>
Table::Line<T> line(const Table& table, const T& x) {
  if constexpr (is_plain<T>) {
    return table.line(x);
  } else {
    return {value(table, x), T(table.derivative(core(x)))};
  }
}
template <class T>
T slope(const PhaseFraction& fraction, const T& x) {
  return T(fraction.derivative(core(x)));
}

}  // namespace detail

template <class T>
PhaseState<T> phase_state_at(const Material& material, const T& temperature, const T& initial_temperature) {
  PhaseState<T> phase{T(1.0), T(0.0)};
  for (const PhaseChange& change : material.phase_changes) {
    if (change.volume_change == 0 && !change.solidification) continue;
    const T fraction = detail::value(change.fraction, temperature);
    if (change.volume_change != 0)
      phase.straining += T(change.volume_change) *
                         (fraction - detail::value(change.fraction, initial_temperature));  // 2.75, 2.76a
    if (change.solidification) phase.solid_fraction = fraction;
  }
  return phase;
}

template <class T>
PointProperties<T> properties_at(const Material& material, const T& temperature, const T& initial_temperature,
                                 const PhaseState<T>& phase) {
  const T young = detail::value(material.young_modulus, temperature);
  const T poisson = detail::value(material.poisson_ratio, temperature);
  const T reference(material.expansion_reference);
  PointProperties<T> p;
  p.bulk = young / (T(3.0) * (T(1.0) - T(2.0) * poisson));
  p.shear = young / (T(2.0) * (T(1.0) + poisson));
  p.thermal_strain = T(3.0) * (detail::value(material.expansion, temperature) * (temperature - reference) -
                               detail::value(material.expansion, initial_temperature) *
                                   (initial_temperature - reference));  // 2.51
  p.thermal_strain += phase.straining;
  p.solid_fraction = phase.solid_fraction;
  p.viscosity = T(1.0);  // any positive number where the material is always solid
  if (material.solidification() != nullptr)
    p.viscosity = material.chooses_viscosity() ? T(std::numeric_limits<double>::quiet_NaN())
                                               : detail::value(material.liquid_viscosity, temperature);
  return p;
}

template <class T>
PointProperties<T> properties_at(const Material& material, const T& temperature,
                                 const T& initial_temperature) {
  return properties_at(material, temperature, initial_temperature,
                       phase_state_at(material, temperature, initial_temperature));
}

template <class T>
T expansion_slope(const Material& material, const T& temperature) {
  const auto alpha = detail::line(material.expansion, temperature);
  return T(3.0) * (alpha.value + alpha.slope * (temperature - T(material.expansion_reference)));
}

template <class T>
PointDerivatives<T> derivatives_at(const Material& material, const T& temperature,
                                   const T& /*initial_temperature*/) {
  const auto young = detail::line(material.young_modulus, temperature);
  const auto poisson = detail::line(material.poisson_ratio, temperature);
  const T q = T(1.0) / (T(1.0) - T(2.0) * poisson.value);
  const T r = T(1.0) / (T(1.0) + poisson.value);
  PointDerivatives<T> d;
  d.bulk = T(1.0 / 3.0) * q * (young.slope + T(2.0) * young.value * poisson.slope * q);
  d.shear = T(0.5) * r * (young.slope - young.value * poisson.slope * r);
  d.thermal_strain = expansion_slope(material, temperature);
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
  const auto young = detail::line(material.young_modulus, temperature);
  const auto poisson = detail::line(material.poisson_ratio, temperature);
  const T q = T(1.0) / (T(1.0) - T(2.0) * poisson.value);
  const T r = T(1.0) / (T(1.0) + poisson.value);
  PointCurvatures<T> c;
  c.bulk = T(4.0 / 3.0) * poisson.slope * q * q * (young.slope + T(2.0) * young.value * poisson.slope * q);
  c.shear = -poisson.slope * r * r * (young.slope - young.value * poisson.slope * r);
  c.thermal_strain = T(6.0) * detail::line(material.expansion, temperature).slope;
  return c;
}

extern template PointProperties<double> properties_at(const Material&, const double&, const double&);
extern template PointProperties<Lane> properties_at(const Material&, const Lane&, const Lane&);
extern template PointProperties<double> properties_at(const Material&, const double&, const double&,
                                                      const PhaseState<double>&);
extern template PointProperties<Lane> properties_at(const Material&, const Lane&, const Lane&,
                                                    const PhaseState<Lane>&);
extern template PointDerivatives<double> derivatives_at(const Material&, const double&, const double&);
extern template PointDerivatives<Lane> derivatives_at(const Material&, const Lane&, const Lane&);
extern template PointCurvatures<double> curvatures_at(const Material&, const double&);
extern template PointCurvatures<Lane> curvatures_at(const Material&, const Lane&);

}  // namespace solidus::material
