/// Conversions between signed numbers (nodes, elements, counts, with -1 for "none") and the sizes of
/// containers.
#pragma once

#include <concepts>
#include <cstddef>

#include "numbers/types.hpp"

namespace solidus {

/// The number `i` as a position in a container or as its size. A negative one becomes larger than every size,
/// and adding it to a size subtracts, as with the cast that this is.
constexpr std::size_t as_size(std::integral auto i) noexcept {
  return static_cast<std::size_t>(i);
}

/// The size or number `n` as a local number, of which one process holds fewer than 2^31.
constexpr Index as_index(std::integral auto n) noexcept {
  return static_cast<Index>(n);
}

}  // namespace solidus
