/// A function of time from its Laplace transform: the Fourier series of the Bromwich integral over a vertical
/// line, its sum extrapolated by a continued fraction with a remainder (F. R. de Hoog, J. H. Knight,
/// A. N. Stokes, SIAM J. Sci. Stat. Comput. 3 (1982) 357–366).
///
/// Right for functions that are smooth in t > 0. A jump at t = d inside must be taken out first: what has the
/// factor e^{−sd} is inverted without it at t − d.
#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <numbers>

namespace solidus::analytic {

/// @param transform F(s) of a complex number, called on a vertical line right of all singularities
/// @param rightmost real part of the rightmost singularity of F [1/time]
/// @param time      positive
/// @return f(time) to about 1e-9 of its size; zero for F = 0
template <class Transform>
double inverse_laplace(const Transform& transform, double rightmost, double time) {
  using Complex = std::complex<double>;
  constexpr int m = 20, n = 2 * m;         // n + 1 terms of the series
  constexpr double discretisation = 1e-9;  // error of the series by aliasing
  const double period = 2 * time, line = rightmost - std::log(discretisation) / (2 * period);

  std::array<Complex, n + 1> a;
  for (int k = 0; k <= n; ++k)
    a[static_cast<std::size_t>(k)] = transform(Complex(line, k * std::numbers::pi / period));
  if (a[0] == 0.0) return 0;  // no fraction to expand
  a[0] *= 0.5;

  // The coefficients d of the continued fraction by the quotient-difference scheme, one column after another.
  std::array<Complex, n + 1> q{}, e{}, d{};
  d[0] = a[0];
  for (std::size_t k = 0; k < n; ++k) q[k] = a[k + 1] / a[k];
  d[1] = -q[0];
  for (std::size_t column = 1; column <= m; ++column) {
    const std::size_t length = n - 2 * column;
    for (std::size_t k = 0; k <= length; ++k) e[k] = q[k + 1] - q[k] + (column > 1 ? e[k + 1] : Complex(0));
    d[2 * column] = -e[0];
    if (column == m) break;
    for (std::size_t k = 0; k < length; ++k) q[k] = q[k + 1] * e[k + 1] / e[k];
    d[2 * column + 1] = -q[0];
  }

  // Its value at z, with the estimate of the remainder in the place of the last coefficient.
  const Complex z = std::polar(1.0, std::numbers::pi * time / period);
  Complex a0 = 0, a1 = d[0], b0 = 1, b1 = 1;
  for (std::size_t k = 1; k < n; ++k) {
    const Complex a2 = a1 + d[k] * z * a0, b2 = b1 + d[k] * z * b0;
    a0 = a1, a1 = a2, b0 = b1, b1 = b2;
  }
  const Complex half = 0.5 * (1.0 + (d[n - 1] - d[n]) * z);
  const Complex remainder = -half * (1.0 - std::sqrt(1.0 + d[n] * z / (half * half)));
  const Complex value = (a1 + remainder * a0) / (b1 + remainder * b0);
  return std::exp(line * time) / period * value.real();
}

}  // namespace solidus::analytic
