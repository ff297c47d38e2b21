/// Requests to the allocator, which differ by its thresholds.
#include "system/free_memory.hpp"

#include <cstdlib>  // which says whether the C library is GNU's
#include <limits>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace solidus {

#ifdef __GLIBC__
namespace {
/// The end of the heap grows and shrinks by this much at once: every page that comes again has to be cleared
/// by the system, which was a quarter of the time of cases of some thousand nodes. What is not written takes
/// no memory.
constexpr int k_end_of_heap = 64 << 20;
constexpr int k_most_arrays = 65536;  ///< the C library's own limit
/// Set by give_large_arrays_back(): other programs that use the library have their own ways with memory.
bool gives_back = false;
}  // namespace
#endif

void return_free_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

void give_large_arrays_back() {
#ifdef __GLIBC__
  mallopt(M_MMAP_MAX, k_most_arrays);
  mallopt(M_MMAP_THRESHOLD, static_cast<int>(k_large_array));
  mallopt(M_TRIM_THRESHOLD, k_end_of_heap);
  mallopt(M_TOP_PAD, k_end_of_heap);
  gives_back = true;
#endif
}

FreedArraysStay::FreedArraysStay() {
#ifdef __GLIBC__
  if (!gives_back) return;
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
#endif
}

FreedArraysStay::~FreedArraysStay() {
#ifdef __GLIBC__
  if (gives_back) give_large_arrays_back();
#endif
}

}  // namespace solidus
