/// A spring G/f_S in series with a dashpot η/(1 − f_S) (monograph 2.50, 2.104; errata).
#pragma once

#include "material/laws/liquid_law.hpp"

namespace solidus::material {

struct Maxwell {
  static constexpr std::string_view name = "maxwell";
  static constexpr std::string_view doc =
      "spring G/f_S in series with a dashpot eta/(1 - f_S), eta = twice_shear_viscosity (2.50, 2.104)";
  static constexpr bool dashpot = true;

  template <class T>
  static LiquidShares<T> shares(const LiquidNumbers&, const T& solid_fraction) {
    return {solid_fraction, T(T(1.0) - solid_fraction), solid_fraction, T(1.0)};
  }
};

}  // namespace solidus::material
