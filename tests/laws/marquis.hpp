/// Kinematic hardening whose recall fades in as the metal hardens, a law that the sources do not have (D.
/// Marquis 1979):
///
///   r = r_inf [1 + (a − 1) exp(−ω ξ)]
///
/// Symbols: ξ equivalent plastic strain; r_inf, a, ω numbers, of which ω is one for all. Validity: ξ >= 0.
#pragma once

#include "material/laws/kinematic_law.hpp"

namespace solidus::test {

struct Marquis {
  static constexpr std::string_view name = "marquis",
                                    equation =
                                        "dq = 2/3 K d(eps_vp) - r(xi) q d(xi), r falling to marquis_recall";
  enum : std::size_t { recall_at_end, first_share };
  static constexpr double k_rate = 40;
  static constexpr material::LawParameter parameters[] = {
      {"marquis_recall", "1", "r_inf, of metal that has hardened."},
      {.key = "marquis_share", .unit = "1", .doc = "a, r at first in parts of r_inf.", .above_least = false}};

  template <class T>
  static material::Recall<T> recall(const material::FlowProperties<T>& p, const T& xi) {
    using std::exp;
    const T extra = p.recall[recall_at_end] * (p.recall[first_share] - T(1.0)) * T(exp(T(T(-k_rate) * xi)));
    return {p.recall[recall_at_end] + extra, T(T(-k_rate) * extra)};
  }
};

inline const material::AddKinematic<Marquis> k_marquis;

}  // namespace solidus::test
