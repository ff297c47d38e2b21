/// A gap that conducts less and less, towards what is left far away, a law that the sources do not have:
///
///   h = h_∞ + (h_o − h_∞) exp(−g/g_0)
///
/// Symbols: g gap, g_0 [m], h_∞ [W/(m² K)], h_o that of contact without pressure. Validity: g >= 0.
#pragma once

#include "contact/laws/gap_law.hpp"

namespace solidus::test {

struct FallingGap {
  static constexpr std::string_view name = "falling", doc = "far + (contact - far) exp(-gap / depth)";
  double far = 0, depth = 0, start = 0;

  static void keys(Section<FallingGap>& s) {
    s.quantity("far_conductance", &FallingGap::far, "W/m2/K").at_least(0).doc("h_inf.");
    s.quantity("gap_depth", &FallingGap::depth, "m").positive().doc("g_0, where 63 % of the fall is done.");
  }
  template <class T>
  T conductance(const T& gap) const {
    using std::exp;
    return T(far) + T(start - far) * T(exp(T(gap * T(-1 / depth))));
  }
  std::optional<Objection> begin(const contact::ContactSide& side) {
    if (!side.conductance) return Objection{"a falling gap begins at the conductance of contact", "one"};
    start = *side.conductance;
    return std::nullopt;
  }
};

inline const contact::AddGapLaw<FallingGap> k_falling_gap;

}  // namespace solidus::test
