/// The built-in laws of hardening on types of automatic differentiation. Included by hardening_on_duals.cpp
/// alone, which instantiates them: a test is not compiled again when a law changes.
#pragma once

#include <stdexcept>

#include "material/hardening.hpp"
#include "material/laws/measured_hardening.hpp"
#include "material/laws/swift.hpp"
#include "material/laws/voce.hpp"

namespace solidus::material::detail {

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
HardeningStress<T> built_in_stress(IsotropicHardening kind, const FlowCurves& curves,
                                   const FlowProperties<T>& p, const T& xi) {
  return with_built_in(kind, [&](auto law) { return stress_of<decltype(law), T>(curves, p, xi); });
}

template <class T>
T built_in_energy(IsotropicHardening kind, const FlowCurves& curves, const FlowProperties<T>& p,
                  const T& xi) {
  return with_built_in(kind, [&](auto law) { return energy_of<decltype(law), T>(curves, p, xi); });
}

template <class T>
HardeningSlopes<T> built_in_slopes(const Flow& flow, const FlowProperties<T>& values,
                                   const FlowProperties<T>& slopes, const T& line_temperature,
                                   const T& temperature, const T& xi) {
  return with_built_in(flow.isotropic, [&](auto law) {
    return HardeningLawOf<decltype(law)>::template slopes_of<T>(flow.curves, values, slopes, line_temperature,
                                                                temperature, xi);
  });
}

}  // namespace solidus::material::detail
