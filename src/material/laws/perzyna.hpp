/// No rate dependence, and a power of the overstress (monograph 2.109b; Perzyna, Norton):
///
///   γ̇ = m/η Φ (Φ/D)^(n − 1),   x = D (η γ̇/(m D))^(1/n)
///
/// Symbols: η [Pa s], n, D the drag stress [Pa]; for n = 1 the monograph's η, else η_2.109b = η D^(n − 1).
/// Validity: η >= 0 (zero: rate independent), n >= k_least_rate_exponent, D > 0.
#pragma once

#include <stdexcept>
#include <type_traits>

#include "material/laws/rate_law.hpp"

namespace solidus::material {

struct NoRate {
  static constexpr std::string_view name = "none",
                                    equation = "the stress cannot leave the yield surface (2.112)";
  template <class T>
  static Overstress<T> overstress(const FlowProperties<T>&, const T&) {
    return {T(0.0), T(0.0)};
  }
};

struct Perzyna {
  static constexpr std::string_view name = "perzyna";
  static constexpr std::string_view equation =
      "it can, and then gamma' = f_S/eta Phi (Phi/D)^(n - 1), with gamma' = |d(eps_vp)/dt|, the solid "
      "fraction f_S and "
      "the overstress Phi = |s - q| - sqrt(2/3) sigma_y (2.109b, whose eta is this eta times D^(n - 1))";
  enum : std::size_t { viscosity, exponent, drag_stress };
  static constexpr LawParameter parameters[] = {
      {.key = "viscosity",
       .unit = "Pa s",
       .doc =
           "eta of the overstress: with n = 1, Phi = eta |d(eps_vp)/dt|, which in a tensile test is 3/2 eta "
           "times "
           "the strain rate above the yield stress. Left out: twice_shear_viscosity, the single eta of the "
           "monograph (2.98).",
       .optional = true},
      {.key = "rate_exponent",
       .unit = "1",
       .doc = "n; left out: 1. Below 1 the overstress rises faster than the strain rate.",
       .least = k_least_rate_exponent,
       .greatest = 100,
       .above_least = false,
       .optional = true,
       .left_out = 1},
      {.key = "drag_stress",
       .unit = "Pa",
       .doc = "D: at the overstress Phi = D, gamma' = D/eta whatever n. Needed unless n = 1 everywhere, "
              "where it "
              "changes nothing.",
       .optional = true,
       .left_out = 1}};

  template <class T>
  static Overstress<T> overstress(const FlowProperties<T>& p, const T& rate) {
    const T &n = p.rate[exponent], &drag = p.rate[drag_stress];
    const T x = drag * power<T>(T(p.rate[viscosity] * rate / drag), T(T(1.0) / n));
    return {x, T(x / (n * rate))};
  }

  static bool linear(const RateTables& tables) {
    return tables[exponent].min_value() == 1 && tables[exponent].max_value() == 1;
  }
  static bool reads(std::size_t parameter, const RateTables& tables) {
    return parameter != drag_stress || !linear(tables);
  }
  /// The liquid's viscosity stands for η, and D is needed unless n = 1.
  static RateCompletion complete(RateTables& tables, const GivenRates& given, const Material& material);
};

/// x of a law, through RateLaw; types of automatic differentiation, which only tests have, know Perzyna
/// alone.
template <class T>
Overstress<T> overstress(RateDependence kind, const FlowProperties<T>& p, const T& rate) {
  if constexpr (std::is_base_of_v<RateOn<T>, RateLaw>)
    return rate_law(kind).overstress(p, rate);
  else if (kind == RateDependence::perzyna)
    return Perzyna::overstress(p, rate);
  throw std::logic_error("a law that was added knows no such type of numbers");
}

}  // namespace solidus::material
