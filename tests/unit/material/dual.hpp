/// A number with its derivatives with respect to a few variables: automatic differentiation that compiles
/// fast, since no operator is inlined.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace solidus::material::test {

/// @param Real  double; long double where a test asks for more digits than differentiation leaves of a double
template <class Real, std::size_t n>
class Dual {
 public:
  using Derivatives = std::array<Real, n>;

  Dual() = default;
  Dual(double value) : v_(value) {}  // NOLINT: a constant
  /// The variable of that index.
  Dual(double value, int /*number_of_variables*/, int index) : v_(value) {
    d_[static_cast<std::size_t>(index)] = 1;
  }

  /// Rounded: where a table is looked up.
  double value() const { return static_cast<double>(v_); }
  const Derivatives& derivatives() const { return d_; }
  /// The same value, its derivatives times a number.
  Dual with_slopes_times(Real factor) const { return chain(v_, factor); }

  Dual& operator+=(const Dual& b) { return *this = *this + b; }
  Dual& operator-=(const Dual& b) { return *this = *this - b; }
  Dual& operator*=(const Dual& b) { return *this = *this * b; }
  friend Dual operator+(const Dual& a, const Dual& b) { return join(a.v_ + b.v_, a, 1, b, 1); }
  friend Dual operator-(const Dual& a, const Dual& b) { return join(a.v_ - b.v_, a, 1, b, -1); }
  friend Dual operator-(const Dual& a) { return a.chain(-a.v_, -1); }
  friend Dual operator*(const Dual& a, const Dual& b) { return join(a.v_ * b.v_, a, b.v_, b, a.v_); }
  friend Dual operator/(const Dual& a, const Dual& b) {
    return join(a.v_ / b.v_, a, 1 / b.v_, b, -a.v_ / (b.v_ * b.v_));
  }
  friend bool operator<(const Dual& a, const Dual& b) { return a.v_ < b.v_; }
  friend bool operator>(const Dual& a, const Dual& b) { return a.v_ > b.v_; }
  friend bool operator<=(const Dual& a, const Dual& b) { return a.v_ <= b.v_; }
  friend bool operator>=(const Dual& a, const Dual& b) { return a.v_ >= b.v_; }
  friend Dual sqrt(const Dual& a) {
    const Real root = std::sqrt(a.v_);
    return a.chain(root, 1 / (2 * root));
  }
  friend Dual exp(const Dual& a) { return a.chain(std::exp(a.v_), std::exp(a.v_)); }
  friend Dual log(const Dual& a) { return a.chain(std::log(a.v_), 1 / a.v_); }

 private:
  Dual chain(Real value, Real slope) const { return join(value, *this, slope, *this, 0); }
  [[gnu::noinline]] static Dual join(Real value, const Dual& a, Real by_a, const Dual& b, Real by_b) {
    Dual r;
    r.v_ = value;
    for (std::size_t i = 0; i < n; ++i) r.d_[i] = by_a * a.d_[i] + (by_b == 0 ? 0 : by_b * b.d_[i]);
    return r;
  }

  Real v_ = 0;
  Derivatives d_{};
};

template <std::size_t n>
using LongDual = Dual<long double, n>;

}  // namespace solidus::material::test
