#include "base/free_memory.hpp"

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace solidus {

void return_free_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

}  // namespace solidus
