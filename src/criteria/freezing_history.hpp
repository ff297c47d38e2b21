/// What the criteria of freezing keep of a node.
#pragma once

#include <cstddef>

namespace solidus::criteria::freezing_history {

/// History of a node, stored consecutively in the column "history". Times [s] are k_never until the event has
/// occurred.
enum Slot : std::size_t {
  k_liquidus_at,
  k_evaluated_at,
  k_solidified_at,
  k_rate,       ///< of the node itself [K/s]
  k_gradient,   ///< [K/m]
  k_magnitude,  ///< mean of the magnitudes of the elements' gradients [K/m]
  k_mode,
  // When the solid fraction passed 0.4, 0.9 and 0.99 (criteria/hot_tearing.hpp).
  k_healed_at,
  k_vulnerable_at,
  k_safe_at,
  k_width,
  // Until T_e is reached, while the front passes: sums over time of gradient and magnitude behind it [K s/m],
  // and that time [s].
  k_sum_time = k_rate,
  k_sum_gradient = k_gradient,
  k_sum_magnitude = k_magnitude
};
inline constexpr double k_never = -1;

}  // namespace solidus::criteria::freezing_history
