/// Hardening by the logarithm of the strain, a law that the sources do not have:
///
///   K_ξ = B ln(1 + ξ/ε_0),  K = B [(ε_0 + ξ) ln(1 + ξ/ε_0) − ξ]
///
/// Symbols: ξ equivalent plastic strain, B [Pa], ε_0 a number. Validity: ξ >= 0.
#pragma once

#include "material/laws/hardening_law.hpp"

namespace solidus::test {

struct Logarithmic {
  static constexpr std::string_view name = "logarithmic", equation = "sigma_y = sigma_0 + B ln(1 + xi/eps_0)";
  enum : std::size_t { factor, strain };
  static constexpr material::LawParameter parameters[] = {
      {.key = "log_factor", .unit = "Pa", .doc = "B.", .above_least = false},
      {.key = "log_strain",
       .unit = "1",
       .doc = "eps_0; the initial slope is B/eps_0.",
       .continuation = material::Continuation::positive}};

  template <class T>
  static material::HardeningStress<T> stress(const material::FlowProperties<T>& p, const T& xi) {
    using std::log;
    const T &b = p.hardening[factor], &e = p.hardening[strain];
    return {b * T(log(T(T(1.0) + xi / e))), b / (e + xi)};
  }
  template <class T>
  static T energy(const material::FlowProperties<T>& p, const T& xi) {
    using std::log;
    const T &b = p.hardening[factor], &e = p.hardening[strain];
    return b * ((e + xi) * T(log(T(T(1.0) + xi / e))) - xi);
  }
};

inline const material::AddHardening<Logarithmic> k_logarithmic;

}  // namespace solidus::test
