/// Hardening by a power of the strain (Swift 1952):
///
///   K_ξ = σ_0 [(1 + ξ/ε_0)^m − 1]
///
/// Symbols: ξ equivalent plastic strain, σ_0 [Pa], ε_0, m numbers. Validity: ξ >= 0, 0 <= m <= 1.
#pragma once

#include "material/laws/hardening_law.hpp"

namespace solidus::material {

struct Swift {
  static constexpr std::string_view name = "power", equation = "sigma_y = sigma_0 (1 + xi/eps_0)^m (Swift)";
  enum : std::size_t { reference_strain, exponent };
  static constexpr LawParameter parameters[] = {
      {.key = "reference_strain",
       .unit = "1",
       .doc = "eps_0; the initial slope is sigma_0 m/eps_0.",
       .continuation = Continuation::positive},
      {.key = "hardening_exponent", .unit = "1", .doc = "m.", .greatest = 1, .above_least = false}};

  template <class T>
  static HardeningStress<T> stress(const FlowProperties<T>& p, const T& xi) {
    const T &strain = p.hardening[reference_strain], &m = p.hardening[exponent];
    const T base = T(1.0) + xi / strain;
    const T raised = power<T>(base, m);
    return {p.hardening_origin * (raised - T(1.0)), p.hardening_origin * m * raised / (base * strain)};
  }
  template <class T>
  static T energy(const FlowProperties<T>& p, const T& xi) {
    const T &strain = p.hardening[reference_strain], &m = p.hardening[exponent];
    const T base = T(1.0) + xi / strain;
    const T above = m + T(1.0);
    return p.hardening_origin * (strain * (power<T>(base, above) - T(1.0)) / above - xi);
  }
};

}  // namespace solidus::material
