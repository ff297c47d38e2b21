/// Rate dependence by a hyperbolic sine, a law that the sources do not have (F. Garofalo 1963):
///
///   γ̇/m = A sinh(Φ/S),   x = S asinh(γ̇/(m A)) = S ln(z + √(1 + z²)),  z = γ̇/(m A)
///
/// Symbols: S [Pa], A [1/s]. Validity: S, A > 0.
#pragma once

#include "material/laws/rate_law.hpp"

namespace solidus::test {

struct HyperbolicSine {
  static constexpr std::string_view name = "hyperbolic_sine",
                                    equation = "gamma' = f_S A sinh(Phi/S) (Garofalo)";
  enum : std::size_t { scale, rate };
  static constexpr material::LawParameter parameters[] = {
      {"sinh_stress", "Pa", "S."}, {"sinh_rate", "1/s", "A, the rate at an overstress of 0.88 S."}};

  template <class T>
  static material::Overstress<T> overstress(const material::FlowProperties<T>& p, const T& flow_rate) {
    using std::log;
    const T one(1.0), z = flow_rate / p.rate[rate], root = power<T>(T(one + z * z), T(0.5));
    return {T(p.rate[scale] * T(log(T(z + root)))), T(p.rate[scale] / (p.rate[rate] * root))};
  }
};

inline const material::AddRate<HyperbolicSine> k_hyperbolic_sine;

}  // namespace solidus::test
