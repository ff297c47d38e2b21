/// Symmetric second-order tensors and their fourth-order tangents, on any number type (double, Lane,
/// automatic differentiation).
///
/// Components are ordered xx, yy, zz, xy, yz, xz and are tensor components (a shear strain is half the
/// engineering one). In plane strain x, y are in the plane; in axisymmetry x = r, y = z (axial), z = the hoop
/// direction.
#pragma once

#include <array>
#include <cmath>

#include "numbers/index_casts.hpp"

namespace solidus {

// Always inlined, and written as one initialisation: in a long constitutive update compilers otherwise call
// them, clear the result first and copy it, which costs more than the arithmetic.
template <class T>
struct Sym {
  std::array<T, 6> c{};

  T& operator[](int i) { return c[as_size(i)]; }
  const T& operator[](int i) const { return c[as_size(i)]; }

  static Sym identity() {
    Sym r;
    r[0] = r[1] = r[2] = T(1.0);
    return r;
  }
  Sym& operator+=(const Sym& b) {
    for (int i = 0; i < 6; ++i) (*this)[i] += b[i];
    return *this;
  }
  Sym& operator-=(const Sym& b) {
    for (int i = 0; i < 6; ++i) (*this)[i] -= b[i];
    return *this;
  }
  Sym& operator*=(const T& s) {
    for (int i = 0; i < 6; ++i) (*this)[i] *= s;
    return *this;
  }
  [[gnu::always_inline]] friend Sym operator+(const Sym& a, const Sym& b) {
    return {{a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3], a[4] + b[4], a[5] + b[5]}};
  }
  [[gnu::always_inline]] friend Sym operator-(const Sym& a, const Sym& b) {
    return {{a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3], a[4] - b[4], a[5] - b[5]}};
  }
  [[gnu::always_inline]] friend Sym operator*(const Sym& a, const T& s) {
    return {{a[0] * s, a[1] * s, a[2] * s, a[3] * s, a[4] * s, a[5] * s}};
  }
  [[gnu::always_inline]] friend Sym operator*(const T& s, const Sym& a) { return a * s; }
};

template <class T>
[[gnu::always_inline]] inline T trace(const Sym<T>& a) {
  return a[0] + a[1] + a[2];
}

/// The deviator a − tr(a)/3 1.
template <class T>
[[gnu::always_inline]] inline Sym<T> dev(const Sym<T>& a) {
  const T mean = trace(a) * T(1.0 / 3.0);
  return {{a[0] - mean, a[1] - mean, a[2] - mean, a[3], a[4], a[5]}};
}

/// The double contraction a : b.
template <class T>
[[gnu::always_inline]] inline T dot(const Sym<T>& a, const Sym<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + T(2.0) * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
}

template <class T>
T norm(const Sym<T>& a) {
  using std::sqrt;
  return sqrt(dot(a, a));
}

/// The von Mises stress sqrt(3/2 s : s).
template <class T>
T von_mises(const Sym<T>& stress) {
  using std::sqrt;
  const Sym<T> s = dev(stress);
  return sqrt(T(1.5) * dot(s, s));
}

/// A tangent ∂σ/∂ε as a 6×6 matrix acting on engineering strains: δσ_a = Σ_b c[a][b] δγ_b, where
/// γ = (ε_xx, ε_yy, ε_zz, 2ε_xy, 2ε_yz, 2ε_xz).
template <class T>
struct Sym4 {
  std::array<std::array<T, 6>, 6> c{};
  std::array<T, 6>& operator[](int i) { return c[as_size(i)]; }
  const std::array<T, 6>& operator[](int i) const { return c[as_size(i)]; }

  /// κ 1⊗1 + 2μ (I − 1/3 1⊗1).
  static Sym4 isotropic(const T& bulk, const T& twice_shear) {
    Sym4 r;
    const T lambda = bulk - twice_shear * T(1.0 / 3.0);
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) r.c[i][j] = lambda;
      r.c[i][i] += twice_shear;
      r.c[i + 3][i + 3] = twice_shear * T(0.5);
    }
    return r;
  }
};

}  // namespace solidus
