/// No hardening, and linear hardening: K_ξ = H ξ. Symbols: ξ equivalent plastic strain, H [Pa].
#pragma once

#include "material/laws/hardening_law.hpp"

namespace solidus::material {

/// H, of all laws that end in a line.
inline constexpr LawParameter k_hardening_modulus{
    .key = "hardening_modulus",
    .unit = "Pa",
    .doc = "H, the slope over plastic strain; with saturation it may be left out (0).",
    .above_least = false,
    .continuation = Continuation::modulus};

struct NoHardening {
  static constexpr std::string_view name = "none", equation = "sigma_y = sigma_0";

  template <class T>
  static HardeningStress<T> stress(const FlowProperties<T>&, const T&) {
    return {T(0.0), T(0.0)};
  }
  template <class T>
  static T energy(const FlowProperties<T>&, const T&) {
    return T(0.0);
  }
};

struct LinearHardening {
  static constexpr std::string_view name = "linear", equation = "sigma_y = sigma_0 + H xi";
  enum : std::size_t { modulus };
  static constexpr LawParameter parameters[] = {k_hardening_modulus};

  template <class T>
  [[gnu::always_inline]] static HardeningStress<T> stress(const FlowProperties<T>& p, const T& xi) {
    return {p.hardening[modulus] * xi, p.hardening[modulus]};
  }
  template <class T>
  static T energy(const FlowProperties<T>& p, const T& xi) {
    return T(0.5) * p.hardening[modulus] * xi * xi;
  }
};

}  // namespace solidus::material
