#include "system/large_pages.hpp"

#include <cstdint>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace solidus {

void ask_for_large_pages([[maybe_unused]] const void* first, [[maybe_unused]] std::size_t bytes) {
#ifdef MADV_HUGEPAGE
  constexpr std::uintptr_t k_page = std::uintptr_t{1} << 21;
  const auto begin = reinterpret_cast<std::uintptr_t>(first), end = begin + bytes;
  const std::uintptr_t inner = (begin + k_page - 1) / k_page * k_page, last = end / k_page * k_page;
  if (inner >= last) return;
  // The advice may be refused, which changes nothing but the speed.
  (void)madvise(reinterpret_cast<void*>(inner), last - inner, MADV_HUGEPAGE);
#endif
}

}  // namespace solidus
