/// The parameters of the flow rule at one temperature, for the return mapping.
#pragma once

#include <array>

#include "material/elasticity.hpp"
#include "material/flow.hpp"
#include "numbers/jet.hpp"

namespace solidus::material {

/// Members as in Flow.
template <class T>
struct FlowProperties {
  T flow_stress{};       ///< σ_0 of the yield radius (2.107) [Pa]
  T hardening_origin{};  ///< σ_0 of the hardening potential (2.49d), equal unless frozen
  std::array<T, k_hardening_parameters> hardening{};  ///< the parameters of the law of isotropic hardening
  T kinematic_modulus{};                              ///< K [Pa]
  std::array<T, k_kinematic_parameters> recall{};     ///< those of the law of kinematic hardening besides K
  std::array<T, k_rate_parameters> rate{};            ///< those of the law of rate dependence
  T temperature{};                                    ///< Θ [K], for measured flow curves
  T beyond{};      ///< [K] from there along the line of the measured curves
  T softening{};   ///< −dσ_0/dΘ of the yield radius [Pa/K]
  T heat_share{};  ///< β of Taylor and Quinney; without meaning where Flow has none
};

/// @param T double, Lane, Jet or automatic differentiation; near its value a table is its line
template <class T>
FlowProperties<T> flow_properties_at(const Flow& flow, const T& temperature) {
  FlowProperties<T> p;
  const Table::Line<T> yield = detail::line(flow.flow_stress, temperature);
  p.flow_stress = p.hardening_origin = yield.value;
  p.softening = T(0.0) - yield.slope;
  p.heat_share = flow.heat_share ? detail::value(*flow.heat_share, temperature) : T(0.0);
  for (std::size_t i = 0; i < k_hardening_parameters; ++i)
    p.hardening[i] = detail::value(flow.hardening[i], temperature);
  p.kinematic_modulus = flow.kinematic == KinematicHardening::none
                            ? T(0.0)
                            : detail::value(flow.kinematic_modulus, temperature);
  for (std::size_t i = 0; i < k_kinematic_parameters; ++i)
    p.recall[i] = detail::value(flow.recall[i], temperature);
  for (std::size_t i = 0; i < k_rate_parameters; ++i) p.rate[i] = detail::value(flow.rate[i], temperature);
  p.temperature = temperature;
  p.beyond = T(0.0);  // a type of automatic differentiation need not start at zero
  return p;
}

/// Numbers N of the flow rule near Θ_n, each made by `along` of its value and its slope there. What is
/// dissipative is frozen: σ_0 of the yield radius, β, the parameters of recall and of rate dependence.
template <class N, class T, class Along>
[[gnu::always_inline]] inline FlowProperties<N> flow_along(const FlowProperties<T>& v,
                                                           const FlowProperties<T>& d,
                                                           const T& line_temperature, Along along) {
  static_assert(k_hardening_parameters == 4 && k_kinematic_parameters == 2 && k_rate_parameters == 3);
  return {.flow_stress = v.flow_stress,
          .hardening_origin = along(v.hardening_origin, d.hardening_origin),
          .hardening = {along(v.hardening[0], d.hardening[0]), along(v.hardening[1], d.hardening[1]),
                        along(v.hardening[2], d.hardening[2]), along(v.hardening[3], d.hardening[3])},
          .kinematic_modulus = along(v.kinematic_modulus, d.kinematic_modulus),
          .recall = {v.recall[0], v.recall[1]},
          .rate = {v.rate[0], v.rate[1], v.rate[2]},
          .temperature = line_temperature,
          .beyond = along(T(0.0), T(1.0)),
          .softening = v.softening,
          .heat_share = v.heat_share};
}
template <class T>
[[gnu::always_inline]] inline FlowProperties<T> flow_values(const FlowProperties<T>& values,
                                                            const FlowProperties<T>& slopes,
                                                            const T& line_temperature, const T& temperature) {
  const T change = temperature - line_temperature;
  return flow_along<T>(values, slopes, line_temperature,
                       [&](const T& value, const T& slope) { return T(value + slope * change); });
}
template <class T>
[[gnu::always_inline]] inline FlowProperties<Jet<T>> flow_jets(const FlowProperties<T>& values,
                                                               const FlowProperties<T>& slopes,
                                                               const T& line_temperature,
                                                               const T& temperature) {
  const T change = temperature - line_temperature;
  return flow_along<Jet<T>>(values, slopes, line_temperature, [&](const T& value, const T& slope) {
    return Jet<T>(value + slope * change, slope, T(0.0));
  });
}

}  // namespace solidus::material
