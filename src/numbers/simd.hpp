/// The lane type: eight doubles that kernels and constitutive laws process together, one element per lane.
///
/// It is one AVX-512 register, two of AVX2 or four of SSE2 (register.hpp), so one source serves GCC and clang
/// and every `-march` (docs/decisions/0001-lane-type.md).
#pragma once

#include <cmath>
#include <cstdint>
#include <new>
#include <vector>

#include "numbers/lane_math.hpp"

namespace solidus {

inline constexpr int k_lanes = 8;
inline constexpr int k_registers = k_lanes / k_register_width;  ///< of a lane

struct LaneMask {
  RegisterMask v[k_registers];  ///< -1 where true, 0 where false
  [[gnu::always_inline]] friend LaneMask operator&(LaneMask a, const LaneMask& b) {
    for (int r = 0; r < k_registers; ++r) a.v[r] &= b.v[r];
    return a;
  }
  [[gnu::always_inline]] friend LaneMask operator|(LaneMask a, const LaneMask& b) {
    for (int r = 0; r < k_registers; ++r) a.v[r] |= b.v[r];
    return a;
  }
  [[gnu::always_inline]] friend LaneMask operator!(LaneMask a) {
    for (RegisterMask& r : a.v) r = ~r;
    return a;
  }
  bool operator[](int i) const { return v[i / k_register_width][i % k_register_width] != 0; }
};

// Always inlined: in a function that has grown large a compiler otherwise calls even these, and a call makes
// the caller keep every register in memory.
struct Lane {
  Register v[k_registers]{};

  Lane() = default;
  [[gnu::always_inline]] Lane(double s) {  // NOLINT: a number is a pack of equal numbers
    for (Register& r : v) r = Register{} + s;
  }

  static Lane load(const double* p) {
    Lane a;
    __builtin_memcpy(&a.v, p, sizeof a.v);
    return a;
  }
  void store(double* p) const { __builtin_memcpy(p, &v, sizeof v); }
  double operator[](int i) const { return v[i / k_register_width][i % k_register_width]; }
  void set(int i, double s) { v[i / k_register_width][i % k_register_width] = s; }

  [[gnu::always_inline]] Lane& operator+=(const Lane& b) {
    for (int r = 0; r < k_registers; ++r) v[r] += b.v[r];
    return *this;
  }
  [[gnu::always_inline]] Lane& operator-=(const Lane& b) {
    for (int r = 0; r < k_registers; ++r) v[r] -= b.v[r];
    return *this;
  }
  [[gnu::always_inline]] Lane& operator*=(const Lane& b) {
    for (int r = 0; r < k_registers; ++r) v[r] *= b.v[r];
    return *this;
  }
  [[gnu::always_inline]] Lane& operator/=(const Lane& b) {
    for (int r = 0; r < k_registers; ++r) v[r] /= b.v[r];
    return *this;
  }
  [[gnu::always_inline]] friend Lane operator+(Lane a, const Lane& b) { return a += b; }
  [[gnu::always_inline]] friend Lane operator-(Lane a, const Lane& b) { return a -= b; }
  [[gnu::always_inline]] friend Lane operator*(Lane a, const Lane& b) { return a *= b; }
  [[gnu::always_inline]] friend Lane operator/(Lane a, const Lane& b) { return a /= b; }
  [[gnu::always_inline]] friend Lane operator-(Lane a) {
    for (Register& r : a.v) r = -r;
    return a;
  }
  [[gnu::always_inline]] friend LaneMask operator<(const Lane& a, const Lane& b) {
    LaneMask m;
    for (int r = 0; r < k_registers; ++r) m.v[r] = a.v[r] < b.v[r];
    return m;
  }
  [[gnu::always_inline]] friend LaneMask operator<=(const Lane& a, const Lane& b) {
    LaneMask m;
    for (int r = 0; r < k_registers; ++r) m.v[r] = a.v[r] <= b.v[r];
    return m;
  }
  [[gnu::always_inline]] friend LaneMask operator==(const Lane& a, const Lane& b) {
    LaneMask m;
    for (int r = 0; r < k_registers; ++r) m.v[r] = a.v[r] == b.v[r];
    return m;
  }
  [[gnu::always_inline]] friend LaneMask operator>(const Lane& a, const Lane& b) { return b < a; }
  [[gnu::always_inline]] friend LaneMask operator>=(const Lane& a, const Lane& b) { return b <= a; }
};

/// `mask ? a : b`, lane by lane; for plain numbers the ternary operator. Laws use it instead of a branch.
[[gnu::always_inline]] inline Lane select(const LaneMask& mask, Lane a, const Lane& b) {
  for (int r = 0; r < k_registers; ++r) a.v[r] = mask.v[r] ? a.v[r] : b.v[r];
  return a;
}
[[gnu::always_inline]] inline double select(bool mask, double a, double b) {
  return mask ? a : b;
}

/// Logical "and" and "or" of two masks, for templates on the number type, whose masks may be plain truth
/// values.
inline LaneMask both(LaneMask a, LaneMask b) {
  return a & b;
}
inline bool both(bool a, bool b) {
  return a && b;
}
inline LaneMask either(LaneMask a, LaneMask b) {
  return a | b;
}
inline bool either(bool a, bool b) {
  return a || b;
}

inline bool any(LaneMask m) {
  for (int r = 1; r < k_registers; ++r) m.v[0] |= m.v[r];
  return any(m.v[0]);
}
inline bool any(bool m) {
  return m;
}
inline bool all(const LaneMask& m) {
  return !any(!m);
}
inline bool all(bool m) {
  return m;
}

/// Applies a scalar function to every lane (look-ups).
template <class Function>
Lane for_each_lane(const Lane& a, Function f) {
  Lane result;
  for (int i = 0; i < k_lanes; ++i) result.set(i, f(a[i]));
  return result;
}

/// Errors and special values of these four: lane_math.hpp.
inline Lane sqrt(Lane a) {
  for (Register& r : a.v) r = square_root(r);
  return a;
}
inline Lane exp(Lane a) {
  for (Register& r : a.v) r = lane_math::exp(r);
  return a;
}
inline Lane log(Lane a) {
  for (Register& r : a.v) r = lane_math::log(r);
  return a;
}
/// a >= 0; NaN below zero.
inline Lane pow(Lane a, const Lane& n) {
  for (int r = 0; r < k_registers; ++r) a.v[r] = lane_math::pow(a.v[r], n.v[r]);
  return a;
}
inline Lane pow(const Lane& a, double n) {
  return pow(a, Lane(n));
}
inline Lane abs(const Lane& a) {
  return select(a < Lane(0.0), -a, a);
}
inline Lane min(const Lane& a, const Lane& b) {
  return select(a < b, a, b);
}
inline Lane max(const Lane& a, const Lane& b) {
  return select(a > b, a, b);
}

/// The sum over the lanes.
inline double sum(const Lane& a) {
  double s = 0;
  for (int i = 0; i < k_lanes; ++i) s += a[i];
  return s;
}
inline double sum(double a) {
  return a;
}

/// Storage of lane packs; C++17's aligned new keeps each pack on its boundary.
template <class T>
using PackVector = std::vector<T>;

}  // namespace solidus
