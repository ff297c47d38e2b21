/// A yield radius times f_S: the liquid is purely viscoplastic (monograph 2.79–2.83).
#pragma once

#include "material/laws/liquid_law.hpp"

namespace solidus::material {

struct Degenerated {
  static constexpr std::string_view name = "degenerated";
  static constexpr std::string_view doc =
      "viscoplastic with the yield stress times f_S; in the liquid the stress deviator is s = eta "
      "d(eps_vp)/dt with eta = "
      "plasticity.viscosity (2.79 - 2.83)";
  static constexpr bool dashpot = false, needs_rate = true;

  template <class T>
  static LiquidShares<T> shares(const LiquidNumbers&, const T& solid_fraction) {
    return {T(1.0), T(0.0), T(1.0), solid_fraction};
  }
};

}  // namespace solidus::material
