/// exp, log and pow of a vector register: no table, no call, and no branch but one for registers that hold a
/// special or extreme number.
///
/// The methods are classical. Arguments are reduced as by Cody and Waite (Software Manual for the Elementary
/// Functions, 1980); the polynomials are the Taylor series, long enough for their truncation to stay below
/// 2^-57 of the result; the logarithm is that of fdlibm (Sun Microsystems, e_log.c, 1993) through
/// s = f/(2 + f). pow needs ln x to more digits than a double holds, because an error of ln x reaches the
/// result multiplied by the exponent: it carries ln x as an unevaluated sum of two doubles. Products inside
/// it are exact, since their factors keep 26 leading bits each (Dekker, Numer. Math. 18, 1971); so they need
/// no fused multiply-add and do not mind one where the compiler contracts.
///
/// Largest errors over two million random arguments, in units in the last place, with and without fused
/// multiply-add: exp 1.02, log 0.83, pow 1.18 (tests/unit/numbers/lane_math_test.cpp).
#pragma once

#include <cstddef>
#include <limits>

#include "numbers/register.hpp"

namespace solidus::lane_math {

/// ln 2 as a sum; the high part has 32 bits, so that its product with an exponent of two is exact.
inline constexpr double k_ln2_high = 0x1.62e42feep-1, k_ln2_low = 0x1.a39ef35793c76p-33;
inline constexpr double k_infinity = std::numeric_limits<double>::infinity();
inline constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();

inline Register all_lanes(double a) {
  return Register{} + a;
}

/// c[0] + c[1] x + …, by Estrin's scheme: neighbours in pairs, then pairs of pairs, for a short chain.
template <std::size_t n>
inline Register polynomial(const double (&c)[n], Register x) {
  Register term[(n + 1) / 2];
  for (std::size_t i = 0; i < n / 2; ++i) term[i] = c[2 * i] + c[2 * i + 1] * x;
  if constexpr (n % 2 == 1) term[n / 2] = all_lanes(c[n - 1]);
  Register power = x;
  for (std::size_t left = (n + 1) / 2; left > 1; left = (left + 1) / 2) {
    power *= power;
    for (std::size_t i = 0; i < left / 2; ++i) term[i] = term[2 * i] + term[2 * i + 1] * power;
    if (left % 2 == 1) term[left / 2] = term[left - 1];
  }
  return term[0];
}

/// a + b for |a| >= |b| or a = 0, unevaluated; the sum of the parts is exact (Dekker's fast two-sum).
struct Sum {
  Register high, low;
};
inline Sum exact_sum(Register a, Register b) {
  const Register high = a + b;
  return {high, (a - high) + b};
}

inline Register magnitude(Register a) {
  return from_bits(bits(a) & 0x7fffffffffffffff);
}

/// The 26 leading bits of a: a product of two such numbers is exact.
inline Register head(Register a) {
  return from_bits(bits(a) & ~std::uint64_t{0x7ffffff});
}

/// x where |x| <= bound or x is NaN, else ±bound.
inline Register clamp(Register x, double bound) {
  x = x > bound ? all_lanes(bound) : x;
  return x < -bound ? all_lanes(-bound) : x;
}

/// e^(x.high + x.low), |x.low| small. Underflows gradually to 0 and overflows to infinity.
inline Register exp_of_sum(Sum x) {
  const bool far = any(~(magnitude(x.high) < 708.0));  // where 2^k below may be no normal number; or NaN
  if (far) {
    const Register high = clamp(x.high, 750.0);  // the result is 0 or infinite already there
    x = {high, high == x.high ? x.low : Register{}};
  }
  // x = k ln 2 + r, |r| <= ln(2)/2: adding 1.5·2^52 rounds to an integer and leaves it in the last bits.
  constexpr double k_to_integer = 0x1.8p52;
  const Register k_shifted = x.high * 0x1.71547652b82fep0 + k_to_integer;
  const Register k = k_shifted - k_to_integer;
  const Register r = (x.high - k * k_ln2_high) + (x.low - k * k_ln2_low);
  // 1/2!, …, 1/13!: the next term is below 2^-57.
  static constexpr double k_inverse_factorials[] = {
      1.0 / 2,     1.0 / 6,      1.0 / 24,      1.0 / 120,      1.0 / 720,       1.0 / 5040,
      1.0 / 40320, 1.0 / 362880, 1.0 / 3628800, 1.0 / 39916800, 1.0 / 479001600, 1.0 / 6227020800};
  const Register p = 1.0 + (r + r * r * polynomial(k_inverse_factorials, r));
  constexpr std::uint64_t k_bias = 1023;
  if (!far) return p * from_bits((bits(k_shifted) + k_bias) << 52);
  // 2^k in two factors
  const RegisterBits half = bits(0.5 * k + k_to_integer), rest = bits(k_shifted) - half;
  return (p * from_bits((half + k_bias) << 52)) * from_bits((rest + k_bias) << 52);
}

/// x = 2^exponent · mantissa with a mantissa in [sqrt(1/2), sqrt(2)); x positive, normal and finite.
struct ScaledMantissa {
  Register exponent, mantissa;
};
inline ScaledMantissa split(Register x) {
  constexpr std::uint64_t k_root_half = 0x3fe6a09e667f3bcd, k_one = 0x3ff0000000000000;
  const RegisterBits shifted = bits(x) + (k_one - k_root_half);
  // A small integer in the last bits of 2^52 is that integer plus 2^52.
  return {from_bits((shifted >> 52) | 0x4330000000000000) - (0x1p52 + 1023),
          from_bits((shifted & 0x000fffffffffffff) + k_root_half)};
}

/// 2/(2i + 3): the series of (2 atanh(s) - 2 s)/s^3 in powers of s², |s| <= 0.1716.
inline constexpr double k_atanh_series[] = {2.0 / 3,  2.0 / 5,  2.0 / 7,  2.0 / 9,  2.0 / 11,
                                            2.0 / 13, 2.0 / 15, 2.0 / 17, 2.0 / 19, 2.0 / 21};

inline Register log_of_parts(ScaledMantissa x) {
  const auto [k, m] = x;
  const Register f = m - 1.0, s = f / (2.0 + f), z = s * s;
  // ln m = 2 s + s R(z) = f - (f²/2 - s (f²/2 + R)): the large term f is exact.
  const Register half_square = 0.5 * f * f, series = z * polynomial(k_atanh_series, z);
  const Register low = half_square - (s * (half_square + series) + k * k_ln2_low);
  return k * k_ln2_high - (low - f);
}

/// ln x to about 68 bits.
inline Sum log_as_sum(ScaledMantissa x) {
  const auto [k, m] = x;
  // s = f/t = s_high + s_low, t = t_high + t_low
  const Register f = m - 1.0, t = m + 1.0, inverse = 1.0 / t, s = f * inverse;
  const Register s_high = head(s), t_high = head(t), t_low = m - (t_high - 1.0);
  const Register s_low = ((f - s_high * t_high) - s_high * t_low) * inverse;
  // ln m = 2 s + s q, q = 2/3 s² + 2/5 s⁴ + …; the first term of q needs more than a double.
  static constexpr double k_two_thirds_high = 0x1.555555p-1, k_two_thirds_low = 0x1.5555555555555p-27;
  static constexpr double k_later_terms[] = {2.0 / 5,  2.0 / 7,  2.0 / 9,  2.0 / 11, 2.0 / 13, 2.0 / 15,
                                             2.0 / 17, 2.0 / 19, 2.0 / 21, 2.0 / 23, 2.0 / 25};
  const Register z = s * s, z_high = head(z), z_low = (s_high * s_high - z_high) + s_low * (s_high + s);
  const Register q_main = k_two_thirds_high * z_high;
  const Register q_rest =
      k_two_thirds_low * z_high + (2.0 / 3) * z_low + z * z * polynomial(k_later_terms, z);
  const Register q_high = head(q_main + q_rest), q_low = (q_main - q_high) + q_rest;
  const Sum first = exact_sum(k * k_ln2_high, 2.0 * s_high);
  const Sum second = exact_sum(first.high, s_high * q_high);
  const Register low =
      (first.low + second.low) + (2.0 * s_low + (s_low * q_high + s * q_low) + k * k_ln2_low);
  return exact_sum(second.high, low);
}

inline RegisterMask special(Register x) {
  return ~((x >= 0x1p-1022) & (x < k_infinity));
}
/// As split, for positive numbers of which some may be less than normal.
inline ScaledMantissa split_scaled(Register x) {
  const RegisterMask subnormal = x < 0x1p-1022;
  const auto [exponent, mantissa] = split(subnormal ? x * 0x1p54 : x);
  return {subnormal ? exponent - 54.0 : exponent, mantissa};
}
/// `log` where x is positive and finite; ∓large at zero and infinity, NaN for the rest.
inline Register with_limits(Register log, Register x, double large) {
  const Register positive = x == k_infinity ? all_lanes(large) : log;
  const Register not_positive = x == 0.0 ? all_lanes(-large) : all_lanes(k_nan);
  return x > 0.0 ? positive : not_positive;
}

inline Register exp(Register x) {
  return exp_of_sum({x, Register{}});
}

inline Register log(Register x) {
  if (any(special(x))) return with_limits(log_of_parts(split_scaled(x)), x, k_infinity);
  return log_of_parts(split(x));
}

/// x^a for x >= 0: NaN below zero and for NaN, also where std::pow knows better (1^NaN, NaN^0, (-2)^2).
inline Register pow(Register x, Register a) {
  Sum log_x;
  if (any(special(x))) {
    log_x = log_as_sum(split_scaled(x));
    log_x.high =
        with_limits(log_x.high, x, 0x1p950);  // times any exponent finite, and a zero exponent gives 1
  } else {
    log_x = log_as_sum(split(x));
  }
  a = clamp(a, 0x1p64);  // which already gives 0 or infinity for every x but 1
  const Register a_high = head(a), a_low = a - a_high;
  const Register log_high = head(log_x.high), log_low = (log_x.high - log_high) + log_x.low;
  return exp_of_sum(exact_sum(a_high * log_high, a_high * log_low + a_low * log_x.high));
}

}  // namespace solidus::lane_math
