#include "system/blas_threads.hpp"

#include <dlfcn.h>

#include <cstdlib>

namespace solidus {

void use_one_thread_of_blas() {
  if (std::getenv("OPENBLAS_NUM_THREADS") != nullptr || std::getenv("OMP_NUM_THREADS") != nullptr) return;
  // BLAS is whichever library Debian's alternatives name; those without threads have no such function.
  using SetThreads = void (*)(int);
  const auto set = reinterpret_cast<SetThreads>(dlsym(RTLD_DEFAULT, "openblas_set_num_threads"));
  if (set != nullptr) set(1);
}

}  // namespace solidus
