/// Conversions between signed numbers (nodes, elements, counts, with -1 for "none") and the sizes of
/// containers.
#pragma once

#include <cassert>
#include <concepts>
#include <cstddef>
#include <limits>
#include <utility>

#include "numbers/types.hpp"

namespace solidus {

/// The number `i` as a position in a container or as its size. A negative number is a mistake of the caller,
/// which builds with assertions report.
constexpr std::size_t as_size(std::integral auto i) noexcept {
  assert(std::in_range<std::size_t>(i));
  return static_cast<std::size_t>(i);
}

/// The size or number `n` as a local number. One process holds fewer than 2^31 nodes, elements and faces,
/// which builds with assertions check.
constexpr Index as_index(std::integral auto n) noexcept {
  assert(std::in_range<Index>(n));
  return static_cast<Index>(n);
}

}  // namespace solidus
