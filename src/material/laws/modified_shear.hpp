/// Elastic with the shear modulus f_S G(Θ_S), zero in the liquid (monograph 2.77, 2.78).
#pragma once

#include "material/laws/liquid_law.hpp"

namespace solidus::material {

struct ModifiedShear {
  static constexpr std::string_view name = "modified_shear";
  static constexpr std::string_view doc =
      "elastic with the shear modulus f_S G(T_S), zero in the liquid: what was deformed when liquid springs "
      "back when "
      "solid (2.77, 2.78)";
  static constexpr bool dashpot = false, holds_modulus = true;

  template <class T>
  static LiquidShares<T> shares(const LiquidNumbers&, const T& solid_fraction) {
    return {solid_fraction, T(0.0), T(1.0), T(1.0)};
  }
};

}  // namespace solidus::material
