/// Conversions between signed numbers (nodes, elements, counts, with -1 for "none") and the sizes of
/// containers.
#pragma once

#include <cassert>
#include <concepts>
#include <cstddef>
#include <utility>

#include "numbers/types.hpp"

namespace solidus {

/// The number `i`, not negative, as a position in a container or as its size. Builds with assertions (presets
/// debug and asan) stop at a negative one.
constexpr std::size_t as_size(std::integral auto i) noexcept {
  assert(std::cmp_greater_equal(i, 0));
  return static_cast<std::size_t>(i);
}

/// The size or number `n` as a local number, of which one process holds fewer than 2^31.
constexpr Index as_index(std::integral auto n) noexcept {
  assert(std::in_range<Index>(n));
  return static_cast<Index>(n);
}

}  // namespace solidus
