/// The parameters of the flow rule at one temperature, for the return mapping.
#pragma once

#include "material/elasticity.hpp"
#include "material/flow.hpp"

namespace solidus::material {

/// Members as in Flow.
template <class T>
struct FlowProperties {
  T flow_stress{};                           ///< σ_0 of the yield radius (2.107) [Pa]
  T hardening_origin{};                      ///< σ_0 of the hardening potential (2.49d), equal unless frozen
  T saturation_stress{}, saturation_rate{};  ///< σ_∞ [Pa], δ
  T hardening_modulus{};                     ///< H [Pa]
  T reference_strain{}, hardening_exponent{};  ///< ε_0, m
  T kinematic_modulus{};                       ///< K [Pa]
  T recall{};                                  ///< of Armstrong–Frederick
  T viscosity{};                               ///< η of the overstress [Pa s]
  T exponent{}, drag_stress{};                 ///< n, D [Pa]
  T temperature{};                             ///< Θ [K], for measured flow curves
  T beyond{};                                  ///< [K] from there along the line of the measured curves
};

/// @param T double, Lane, Jet or automatic differentiation; near its value a table is its line
template <class T>
FlowProperties<T> flow_properties_at(const Flow& flow, const T& temperature) {
  FlowProperties<T> p;
  p.flow_stress = detail::value(flow.flow_stress, temperature);
  p.hardening_origin = p.flow_stress;
  p.saturation_stress = detail::value(flow.saturation_stress, temperature);
  p.saturation_rate = detail::value(flow.saturation_rate, temperature);
  p.hardening_modulus = detail::value(flow.hardening_modulus, temperature);
  p.reference_strain = detail::value(flow.reference_strain, temperature);
  p.hardening_exponent = detail::value(flow.hardening_exponent, temperature);
  p.kinematic_modulus = flow.kinematic == KinematicHardening::none
                            ? T(0.0)
                            : detail::value(flow.kinematic_modulus, temperature);
  p.recall = detail::value(flow.recall, temperature);
  p.viscosity = detail::value(flow.viscosity, temperature);
  p.exponent = detail::value(flow.exponent, temperature);
  p.drag_stress = detail::value(flow.drag_stress, temperature);
  p.temperature = temperature;
  p.beyond = T(0.0);  // a type of automatic differentiation need not start at zero
  return p;
}

}  // namespace solidus::material
