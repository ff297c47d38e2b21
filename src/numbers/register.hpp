/// One vector register of the target, as GCC's and clang's vector extension sees it.
///
/// A lane (simd.hpp) is a few of these. Vectors wider than a register would be allowed, but g++ 12 lowers
/// their comparisons and selections element by element.
#pragma once

#include <bit>
#include <cstdint>

#if defined(__AVX512F__) && defined(__AVX512DQ__)
#define SOLIDUS_REGISTER_BYTES 64
#elif defined(__AVX2__)
#define SOLIDUS_REGISTER_BYTES 32
#else
#define SOLIDUS_REGISTER_BYTES 16
#endif
#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace solidus {

inline constexpr int k_register_bytes = SOLIDUS_REGISTER_BYTES;

using Register = double __attribute__((vector_size(k_register_bytes)));
using RegisterMask = std::int64_t __attribute__((vector_size(k_register_bytes)));  ///< -1 true, 0 false
using RegisterBits = std::uint64_t __attribute__((vector_size(k_register_bytes)));

inline constexpr int k_register_width = k_register_bytes / 8;

inline RegisterBits bits(Register a) {
  return std::bit_cast<RegisterBits>(a);
}
inline Register from_bits(RegisterBits a) {
  return std::bit_cast<Register>(a);
}

/// Correctly rounded; NaN below zero. The compilers turn the loop into one instruction (without errno, as the
/// build asks), except g++ 12 at 32 bytes, which halves the register.
inline Register square_root(Register a) {
#if SOLIDUS_REGISTER_BYTES == 32
  return _mm256_sqrt_pd(a);
#else
  Register root{};
  for (int i = 0; i < k_register_width; ++i) root[i] = __builtin_sqrt(a[i]);
  return root;
#endif
}

/// The compilers do not find the one instruction for this.
inline bool any(RegisterMask m) {
#if SOLIDUS_REGISTER_BYTES == 64
  return _mm512_movepi64_mask(_mm512_castpd_si512(std::bit_cast<Register>(m))) != 0;
#elif SOLIDUS_REGISTER_BYTES == 32
  return _mm256_movemask_pd(std::bit_cast<Register>(m)) != 0;
#elif defined(__SSE2__)
  return _mm_movemask_pd(std::bit_cast<Register>(m)) != 0;
#else
  std::int64_t any_element = 0;
  for (int i = 0; i < k_register_width; ++i) any_element |= m[i];
  return any_element != 0;
#endif
}

}  // namespace solidus
