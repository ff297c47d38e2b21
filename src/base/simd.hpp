/// The lane type: eight doubles that kernels and constitutive laws process together, one element per lane.
///
/// GCC's and clang's vector extension lowers to whatever the target offers (one AVX-512 register, two AVX2,
/// four SSE2), so one source serves both compilers and every `-march` (docs/decisions/0001-lane-type.md).
#pragma once

#include <cmath>
#include <cstdint>
#include <new>
#include <vector>

namespace solidus {

inline constexpr int k_lanes = 8;

struct LaneMask {
  using Storage = std::int64_t __attribute__((vector_size(8 * k_lanes)));
  Storage v;  ///< -1 where true, 0 where false
  friend LaneMask operator&(LaneMask a, LaneMask b) { return {a.v & b.v}; }
  friend LaneMask operator|(LaneMask a, LaneMask b) { return {a.v | b.v}; }
  friend LaneMask operator!(LaneMask a) { return {~a.v}; }
  bool operator[](int i) const { return v[i] != 0; }
};

struct Lane {
  using Storage = double __attribute__((vector_size(8 * k_lanes)));
  Storage v{};

  Lane() = default;
  Lane(double s) : v(Storage{} + s) {}  // NOLINT: a number is a pack of equal numbers
  explicit Lane(Storage s) : v(s) {}

  static Lane load(const double* p) {
    Lane r;
    __builtin_memcpy(&r.v, p, sizeof r.v);
    return r;
  }
  void store(double* p) const { __builtin_memcpy(p, &v, sizeof v); }
  double operator[](int i) const { return v[i]; }
  void set(int i, double s) { v[i] = s; }

  Lane& operator+=(Lane b) {
    v += b.v;
    return *this;
  }
  Lane& operator-=(Lane b) {
    v -= b.v;
    return *this;
  }
  Lane& operator*=(Lane b) {
    v *= b.v;
    return *this;
  }
  Lane& operator/=(Lane b) {
    v /= b.v;
    return *this;
  }
  friend Lane operator+(Lane a, Lane b) { return Lane(a.v + b.v); }
  friend Lane operator-(Lane a, Lane b) { return Lane(a.v - b.v); }
  friend Lane operator*(Lane a, Lane b) { return Lane(a.v * b.v); }
  friend Lane operator/(Lane a, Lane b) { return Lane(a.v / b.v); }
  friend Lane operator-(Lane a) { return Lane(-a.v); }
  friend LaneMask operator<(Lane a, Lane b) { return {a.v < b.v}; }
  friend LaneMask operator<=(Lane a, Lane b) { return {a.v <= b.v}; }
  friend LaneMask operator>(Lane a, Lane b) { return {a.v > b.v}; }
  friend LaneMask operator>=(Lane a, Lane b) { return {a.v >= b.v}; }
  friend LaneMask operator==(Lane a, Lane b) { return {a.v == b.v}; }
};

/// `mask ? a : b`, lane by lane; for other numbers the ternary operator. Laws use it instead of a branch.
inline Lane select(LaneMask mask, Lane a, Lane b) {
  return Lane(mask.v ? a.v : b.v);
}
template <class T>
T select(bool mask, const T& a, const T& b) {
  return mask ? a : b;
}

inline bool any(LaneMask m) {
  for (int i = 0; i < k_lanes; ++i)
    if (m[i]) return true;
  return false;
}
inline bool any(bool m) {
  return m;
}
inline bool all(LaneMask m) {
  return !any(!m);
}
inline bool all(bool m) {
  return m;
}

/// Applies a scalar function to every lane (look-ups, transcendental functions).
template <class Function>
Lane for_each_lane(Lane a, Function f) {
  Lane r;
  for (int i = 0; i < k_lanes; ++i) r.v[i] = f(a.v[i]);
  return r;
}
inline Lane sqrt(Lane a) {
  return for_each_lane(a, [](double x) { return std::sqrt(x); });
}
inline Lane exp(Lane a) {
  return for_each_lane(a, [](double x) { return std::exp(x); });
}
inline Lane log(Lane a) {
  return for_each_lane(a, [](double x) { return std::log(x); });
}
inline Lane pow(Lane a, double n) {
  return for_each_lane(a, [n](double x) { return std::pow(x, n); });
}
inline Lane abs(Lane a) {
  return select(a < Lane(0.0), -a, a);
}
inline Lane min(Lane a, Lane b) {
  return select(a < b, a, b);
}
inline Lane max(Lane a, Lane b) {
  return select(a > b, a, b);
}

/// The sum over the lanes.
inline double sum(Lane a) {
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
