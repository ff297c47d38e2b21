/// Number types besides double and Lane: the rules by which a template works with all of them, and a jet, a
/// number that carries its first two derivatives with respect to one variable.
#pragma once

#include <cmath>
#include <type_traits>

#include "numbers/simd.hpp"

namespace solidus {

/// f, f' and f'' with respect to one variable (temperature), on T = double, Lane or a type of automatic
/// differentiation. A law written on a number type gives its exact temperature derivatives this way.
template <class T>
struct Jet {
  T v{}, d{}, dd{};

  Jet() = default;
  Jet(const T& value) : v(value), d(T(0.0)), dd(T(0.0)) {}  // NOLINT: a constant
  template <class Number,
            class = std::enable_if_t<std::is_arithmetic_v<Number> && !std::is_same_v<T, Number>>>
  Jet(Number value) : Jet(T(static_cast<double>(value))) {}  // NOLINT: a constant
  Jet(const T& value, const T& first, const T& second) : v(value), d(first), dd(second) {}
  /// The variable itself.
  static Jet variable(const T& x) { return {x, T(1.0), T(0.0)}; }

  Jet& operator+=(const Jet& b) { return *this = *this + b; }
  Jet& operator-=(const Jet& b) { return *this = *this - b; }
  Jet& operator*=(const Jet& b) { return *this = *this * b; }
  friend Jet operator+(const Jet& a, const Jet& b) { return {a.v + b.v, a.d + b.d, a.dd + b.dd}; }
  friend Jet operator-(const Jet& a, const Jet& b) { return {a.v - b.v, a.d - b.d, a.dd - b.dd}; }
  friend Jet operator-(const Jet& a) { return {-a.v, -a.d, -a.dd}; }
  friend Jet operator*(const Jet& a, const Jet& b) {
    return {a.v * b.v, a.d * b.v + a.v * b.d, a.dd * b.v + T(2.0) * a.d * b.d + a.v * b.dd};
  }
  friend Jet operator/(const Jet& a, const Jet& b) { return a * chain(b, inverse(b.v)); }
  friend auto operator<(const Jet& a, const Jet& b) { return a.v < b.v; }
  friend auto operator>(const Jet& a, const Jet& b) { return a.v > b.v; }
  friend auto operator<=(const Jet& a, const Jet& b) { return a.v <= b.v; }
  friend auto operator>=(const Jet& a, const Jet& b) { return a.v >= b.v; }

  /// f(a) from f, f', f'' at a.v.
  static Jet chain(const Jet& a, const Jet& f) { return {f.v, f.d * a.d, f.dd * a.d * a.d + f.d * a.dd}; }

 private:
  static Jet inverse(const T& x) {
    const T i = T(1.0) / x;
    return {i, -i * i, T(2.0) * i * i * i};
  }
};

template <class T>
Jet<T> exp(const Jet<T>& a) {
  using std::exp;
  const T e = exp(a.v);
  return Jet<T>::chain(a, {e, e, e});
}
template <class T>
Jet<T> log(const Jet<T>& a) {
  using std::log;
  const T i = T(1.0) / a.v;
  return Jet<T>::chain(a, {log(a.v), i, -i * i});
}
/// `mask ? a : b` for numbers that are not packed.
template <class T>
T select(bool mask, const T& a, const T& b) {
  return mask ? a : b;
}
inline Jet<Lane> select(LaneMask mask, const Jet<Lane>& a, const Jet<Lane>& b) {
  return {select(mask, a.v, b.v), select(mask, a.d, b.d), select(mask, a.dd, b.dd)};
}

namespace detail {
template <class T>
struct IsJet : std::false_type {};
template <class T>
struct IsJet<Jet<T>> : std::true_type {};
}  // namespace detail

/// The double or Lane inside a number: its value without derivatives.
template <class T>
auto core(const T& x) {
  if constexpr (std::is_same_v<T, double> || std::is_same_v<T, Lane>)
    return x;
  else if constexpr (detail::IsJet<T>::value)
    return core(x.v);
  else
    return core(x.value());  // automatic differentiation
}

/// x^n for x > 0, also where the exponent carries derivatives.
template <class T>
T power(const T& x, const T& n) {
  if constexpr (std::is_same_v<T, double> || std::is_same_v<T, Lane>) {
    using std::pow;
    return pow(x, n);
  } else if constexpr (detail::IsJet<T>::value) {
    const auto value = power(x.v, n.v);  // exp(n ln x) would lose digits
    return T::chain(n * log(x), {value, value, value});
  } else {
    using std::exp, std::log;
    return exp(T(n * T(log(x))));
  }
}

}  // namespace solidus
