/// A liquid without strength until its crystals touch, a model that the sources do not have: a yield radius
/// times a power of the solid fraction,
///
///   w = f_Sᵖ
///
/// and in the liquid the rate dependence of [plasticity] alone, as in the degenerated model
/// (monograph 2.79–2.83). Symbols: p a number, f_S the solid fraction. Validity: p >= 1.
#pragma once

#include "material/laws/liquid_law.hpp"

namespace solidus::test {

struct LateStrength {
  static constexpr std::string_view name = "late_strength",
                                    doc = "viscoplastic with the yield stress times f_S^p";
  static constexpr material::LawParameter parameters[] = {
      {.key = "strength_power", .unit = "1", .doc = "p.", .least = 1, .above_least = false}};
  static constexpr bool dashpot = false, needs_rate = true;

  template <class T>
  static material::LiquidShares<T> shares(const material::LiquidNumbers& numbers, const T& f) {
    const auto some = f > T(0.0);
    const T strength = power<T>(T(select(some, f, T(1.0))), T(numbers[0]));
    return {T(1.0), T(0.0), T(1.0), T(select(some, strength, T(0.0)))};
  }
};

inline const material::AddLiquid<LateStrength> k_late_strength;

}  // namespace solidus::test
