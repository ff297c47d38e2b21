/// A number with its derivatives with respect to a few variables, in extended precision: where automatic
/// differentiation in double precision would lose the digits that a test asks for.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace solidus::material::test {

template <std::size_t n>
class LongDual {
 public:
  using Derivatives = std::array<long double, n>;

  LongDual() = default;
  LongDual(double value) : v_(value) {}  // NOLINT: a constant
  /// The variable of that index.
  LongDual(double value, int /*number_of_variables*/, int index) : v_(value) {
    d_[static_cast<std::size_t>(index)] = 1;
  }

  /// Rounded: where a table is looked up.
  double value() const { return static_cast<double>(v_); }
  const Derivatives& derivatives() const { return d_; }
  /// The same value, its derivatives times a number.
  LongDual with_slopes_times(long double factor) const { return chain(v_, factor); }

  LongDual& operator+=(const LongDual& b) { return *this = *this + b; }
  LongDual& operator-=(const LongDual& b) { return *this = *this - b; }
  LongDual& operator*=(const LongDual& b) { return *this = *this * b; }
  friend LongDual operator+(const LongDual& a, const LongDual& b) { return join(a.v_ + b.v_, a, 1, b, 1); }
  friend LongDual operator-(const LongDual& a, const LongDual& b) { return join(a.v_ - b.v_, a, 1, b, -1); }
  friend LongDual operator-(const LongDual& a) { return a.chain(-a.v_, -1); }
  friend LongDual operator*(const LongDual& a, const LongDual& b) {
    return join(a.v_ * b.v_, a, b.v_, b, a.v_);
  }
  friend LongDual operator/(const LongDual& a, const LongDual& b) {
    return join(a.v_ / b.v_, a, 1 / b.v_, b, -a.v_ / (b.v_ * b.v_));
  }
  friend bool operator<(const LongDual& a, const LongDual& b) { return a.v_ < b.v_; }
  friend bool operator>(const LongDual& a, const LongDual& b) { return a.v_ > b.v_; }
  friend bool operator<=(const LongDual& a, const LongDual& b) { return a.v_ <= b.v_; }
  friend bool operator>=(const LongDual& a, const LongDual& b) { return a.v_ >= b.v_; }
  friend LongDual sqrt(const LongDual& a) {
    const long double root = std::sqrt(a.v_);
    return a.chain(root, 1 / (2 * root));
  }
  friend LongDual exp(const LongDual& a) { return a.chain(std::exp(a.v_), std::exp(a.v_)); }
  friend LongDual log(const LongDual& a) { return a.chain(std::log(a.v_), 1 / a.v_); }

 private:
  LongDual chain(long double value, long double slope) const { return join(value, *this, slope, *this, 0); }
  static LongDual join(long double value, const LongDual& a, long double by_a, const LongDual& b,
                       long double by_b) {
    LongDual r;
    r.v_ = value;
    for (std::size_t i = 0; i < n; ++i) r.d_[i] = by_a * a.d_[i] + (by_b == 0 ? 0 : by_b * b.d_[i]);
    return r;
  }

  long double v_ = 0;
  Derivatives d_{};
};

}  // namespace solidus::material::test
