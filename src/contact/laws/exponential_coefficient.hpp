/// A coefficient of friction that runs in, or wears off, towards a last value:
///
///   μ = μ_∞ + (μ_0 − μ_∞) exp(−z/z_0)
///
/// Symbols: z internal variable in the unit of the data, z_0 of the same, μ_0, μ_∞ numbers. Validity: z >= 0.
#pragma once

#include "contact/laws/coefficient_law.hpp"

namespace solidus::contact {

struct ExponentialCoefficient {
  static constexpr std::string_view name = "exponential",
                                    doc =
                                        "last_coefficient + (initial_coefficient - last_coefficient) "
                                        "exp(-z / running_in)";
  double initial = 0, last = 0, running_in = 0;  ///< μ_0, μ_∞, z_0

  static void keys(Section<ExponentialCoefficient>& s) {
    s.key("initial_coefficient", &ExponentialCoefficient::initial)
        .positive()
        .doc("mu_0 of a surface that has not slid.");
    s.key("last_coefficient", &ExponentialCoefficient::last)
        .positive()
        .doc("mu_inf, the coefficient after running in.");
    s.key("running_in", &ExponentialCoefficient::running_in)
        .positive()
        .doc("z_0, the internal variable in its unit at which 63 % of the change has happened.");
  }
  template <class T>
  T coefficient(const T& z) const {
    using std::exp;
    return T(last) + T(initial - last) * T(exp(T(z * T(-1 / running_in))));
  }
  template <class T>
  T integral(const T& z) const {
    using std::exp;
    return T(last) * z + T((initial - last) * running_in) * (T(1.0) - T(exp(T(z * T(-1 / running_in)))));
  }
};

}  // namespace solidus::contact
