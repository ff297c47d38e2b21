/// A coefficient of friction that wears off as a hyperbola and falls with temperature, a law that the sources
/// do not have:
///
///   μ = (μ_∞ + (μ_0 − μ_∞)/(1 + z/z_0)) (1 − (Θ − 300 K)/5000 K)
///
/// Symbols: z internal variable, z_0 of the same unit, Θ temperature [K]. Validity: z >= 0.
#pragma once

#include "contact/laws/coefficient_law.hpp"

namespace solidus::test {

struct HyperbolicCoefficient {
  static constexpr std::string_view name = "hyperbolic",
                                    doc = "(last + (first - last)/(1 + z/half)) (1.06 - T/5000 K)";
  double first = 0, last = 0, half = 1;

  static void keys(Section<HyperbolicCoefficient>& s) {
    s.key("first", &HyperbolicCoefficient::first).positive().doc("mu_0 at 300 K.");
    s.key("last", &HyperbolicCoefficient::last).positive().doc("mu_inf at 300 K.");
    s.key("half", &HyperbolicCoefficient::half).positive().doc("z_0.");
  }
  template <class T>
  T coefficient(const T& z, const T& temperature) const {
    return (T(last) + T(first - last) / (T(1.0) + z / T(half))) * (T(1.06) - temperature * T(2e-4));
  }
  template <class T>
  T integral(const T& z, const T& temperature) const {
    using std::log;
    const T worn = T(log(T(T(1.0) + z / T(half))));
    return (T(last) * z + T((first - last) * half) * worn) * (T(1.06) - temperature * T(2e-4));
  }
};

inline const contact::AddCoefficientLaw<HyperbolicCoefficient> k_hyperbolic_coefficient;

}  // namespace solidus::test
