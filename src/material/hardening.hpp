/// Isotropic hardening: the part of the free energy that plastic flow stores, and the stress that it adds to
/// the flow stress (monograph 2.49d, 2.60). K_ξ = ∂K/∂ξ, the flow stress is σ_0 + K_ξ.
///
/// Each law has a file in laws/. The return mapping calls those without a curve directly, the others through
/// HardeningLaw: hardening_laws.cpp is all of the program that is compiled again when one of them changes.
///
/// Symbols: ξ equivalent plastic strain, σ_0 [Pa]. Validity: ξ >= 0.
#pragma once

#include <type_traits>

#include "material/laws/linear.hpp"

namespace solidus::material {
namespace detail {

/// Number types on which a HardeningLaw answers.
template <class T>
inline constexpr bool k_on_laws = std::is_base_of_v<HardeningOn<T>, HardeningLaw>;
template <class T>
inline constexpr bool k_along_laws = std::is_base_of_v<HardeningAlong<T>, HardeningLaw>;

/// The built-in laws on a type of automatic differentiation. Only tests have such types and define these
/// (tests/unit/material/built_in_hardening.hpp), so that no other file reads the laws.
template <class T>
HardeningStress<T> built_in_stress(IsotropicHardening kind, const FlowCurves& curves,
                                   const FlowProperties<T>& p, const T& xi);
template <class T>
T built_in_energy(IsotropicHardening kind, const FlowCurves& curves, const FlowProperties<T>& p, const T& xi);
template <class T>
HardeningSlopes<T> built_in_slopes(const Flow& flow, const FlowProperties<T>& values,
                                   const FlowProperties<T>& slopes, const T& line_temperature,
                                   const T& temperature, const T& xi);

template <class T>
HardeningStress<T> curved_stress(IsotropicHardening kind, const FlowCurves& curves,
                                 const FlowProperties<T>& p, const T& xi) {
  if constexpr (k_on_laws<T>)
    return hardening_law(kind).stress(curves, p, xi);
  else
    return built_in_stress<T>(kind, curves, p, xi);
}

template <class T>
[[gnu::always_inline]] inline HardeningSlopes<T> curved_slopes(const Flow& flow,
                                                               const FlowProperties<T>& values,
                                                               const FlowProperties<T>& slopes,
                                                               const T& line_temperature,
                                                               const T& temperature, const T& xi) {
  if constexpr (k_along_laws<T>)
    return hardening_law(flow.isotropic)
        .slopes(flow.curves, values, slopes, line_temperature, temperature, xi);
  else
    return built_in_slopes<T>(flow, values, slopes, line_temperature, temperature, xi);
}

}  // namespace detail

/// @param curves read by kind table only
// Inline where it is short: a call would make a return mapping keep all of its numbers in memory.
template <class T>
[[gnu::always_inline]] inline HardeningStress<T> hardening_stress(IsotropicHardening kind,
                                                                  const FlowCurves& curves,
                                                                  const FlowProperties<T>& p, const T& xi) {
  if (kind == IsotropicHardening::none) return {T(0.0), T(0.0)};
  if (kind == IsotropicHardening::linear) return LinearHardening::stress(p, xi);
  return detail::curved_stress(kind, curves, p, xi);
}

/// K(ξ, Θ) [J/m³], the stored energy of isotropic hardening. On a Jet in temperature it carries K_Θ and
/// K_ΘΘ.
template <class T>
T hardening_energy(IsotropicHardening kind, const FlowCurves& curves, const FlowProperties<T>& p,
                   const T& xi) {
  if constexpr (detail::k_on_laws<T>)
    return hardening_law(kind).energy(curves, p, xi);
  else
    return detail::built_in_energy<T>(kind, curves, p, xi);
}

}  // namespace solidus::material
