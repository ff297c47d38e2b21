/// Isotropic hardening: the part of the free energy that plastic flow stores, and the stress that it adds to
/// the flow stress (monograph 2.49d, 2.60). K_ξ = ∂K/∂ξ, the flow stress is σ_0 + K_ξ.
///
/// Each law has a file in laws/. The return mapping calls those without a curve directly, the others through
/// HardeningLaw; types of automatic differentiation, which only tests have, call built-in laws directly.
///
/// Symbols: ξ equivalent plastic strain, σ_0 [Pa]. Validity: ξ >= 0.
#pragma once

#include <stdexcept>
#include <type_traits>

#include "material/laws/linear.hpp"
#include "material/laws/measured_hardening.hpp"
#include "material/laws/swift.hpp"
#include "material/laws/voce.hpp"

namespace solidus::material {
namespace detail {

/// Number types on which a HardeningLaw answers.
template <class T>
inline constexpr bool k_on_laws = std::is_base_of_v<HardeningOn<T>, HardeningLaw>;
template <class T>
inline constexpr bool k_along_laws = std::is_base_of_v<HardeningAlong<T>, HardeningLaw>;

/// use(law) of a built-in law.
template <class Use>
auto with_built_in(IsotropicHardening kind, Use use) {
  switch (kind) {
    case IsotropicHardening::none:
      return use(NoHardening());
    case IsotropicHardening::linear:
      return use(LinearHardening());
    case IsotropicHardening::saturation:
      return use(Voce());
    case IsotropicHardening::power:
      return use(Swift());
    case IsotropicHardening::table:
      return use(MeasuredHardening());
  }
  throw std::logic_error("a law that was added knows no such type of numbers");
}

template <class T>
HardeningStress<T> curved_stress(IsotropicHardening kind, const FlowCurves& curves,
                                 const FlowProperties<T>& p, const T& xi) {
  if constexpr (k_on_laws<T>)
    return hardening_law(kind).stress(curves, p, xi);
  else
    return with_built_in(kind, [&](auto law) { return detail::stress_of<decltype(law), T>(curves, p, xi); });
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
    return with_built_in(flow.isotropic, [&](auto law) {
      return HardeningLawOf<decltype(law)>::template slopes_of<T>(flow.curves, values, slopes,
                                                                  line_temperature, temperature, xi);
    });
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
    return detail::with_built_in(
        kind, [&](auto law) { return detail::energy_of<decltype(law), T>(curves, p, xi); });
}

}  // namespace solidus::material
