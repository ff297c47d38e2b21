#include "system/free_memory.hpp"

#include <cstdlib>  // which says whether the C library is GNU's

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace solidus {

#ifdef __GLIBC__
namespace {
/// Smaller arrays come and go too often to be asked of the system every time.
constexpr int k_large = 4 << 20;
constexpr int k_kept_at_the_end = 32 << 20;
constexpr int k_most_arrays = 65536;  ///< the C library's own limit
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
  mallopt(M_MMAP_THRESHOLD, k_large);
  mallopt(M_TRIM_THRESHOLD, k_kept_at_the_end);
#endif
}

}  // namespace solidus
