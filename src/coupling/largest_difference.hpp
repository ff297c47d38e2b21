/// Largest difference between two iterates.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "parallel/parallel.hpp"

namespace solidus::coupling {

/// max |a_i − b_i| over all processes, in the units of the values; infinite where a difference is not a
/// number, so that no iteration ends there. `a` and `b` are of one size. Collective.
inline double largest_difference(std::span<const double> a, std::span<const double> b) {
  double size = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double difference = std::abs(a[i] - b[i]);
    size = std::isnan(difference) ? std::numeric_limits<double>::infinity() : std::max(size, difference);
  }
  return parallel::global_max(size);
}

}  // namespace solidus::coupling
