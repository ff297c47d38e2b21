// Compiled as everything else: a constant, no code, which would use those instructions already.
#include "app/instructions.hpp"

namespace solidus::app {

constexpr Instructions built_for() {
  // One bit for each set of instructions that the compiler was allowed to use, in the order in which
  // instructions.cpp asks the processor for them.
  Instructions set = 0;
#ifdef __SSE4_2__
  set |= 1U << 0U;
#endif
#ifdef __POPCNT__
  set |= 1U << 1U;
#endif
#ifdef __AVX__
  set |= 1U << 2U;
#endif
#ifdef __AVX2__
  set |= 1U << 3U;
#endif
#ifdef __FMA__
  set |= 1U << 4U;
#endif
#ifdef __BMI__
  set |= 1U << 5U;
#endif
#ifdef __BMI2__
  set |= 1U << 6U;
#endif
#ifdef __AVX512F__
  set |= 1U << 7U;
#endif
#ifdef __AVX512CD__
  set |= 1U << 8U;
#endif
#ifdef __AVX512BW__
  set |= 1U << 9U;
#endif
#ifdef __AVX512DQ__
  set |= 1U << 10U;
#endif
#ifdef __AVX512VL__
  set |= 1U << 11U;
#endif
#ifdef __AVX512VBMI__
  set |= 1U << 12U;
#endif
#ifdef __AVX512VNNI__
  set |= 1U << 13U;
#endif
  return set;
}

constinit const Instructions k_built_for = built_for();

}  // namespace solidus::app
