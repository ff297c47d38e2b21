/// The place on the face is found back from the values of its shape functions, and the piecewise-linear
/// functions are evaluated there with their slopes.
#include "contact/points/positive_shares.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace solidus::contact {

namespace {

/// A value that is a function of n: L, or a reference coordinate.
struct ShareValue {
  double v = 0;
  std::array<double, 8> slope{};  ///< ∂/∂n_b
};

ShareValue operator*(double c, const ShareValue& a) {
  ShareValue r{c * a.v, {}};
  for (std::size_t b = 0; b < r.slope.size(); ++b) r.slope[b] = c * a.slope[b];
  return r;
}

ShareValue operator+(const ShareValue& a, const ShareValue& b) {
  ShareValue r{a.v + b.v, {}};
  for (std::size_t k = 0; k < r.slope.size(); ++k) r.slope[k] = a.slope[k] + b.slope[k];
  return r;
}

ShareValue operator+(double c, const ShareValue& a) {
  ShareValue r = a;
  r.v += c;
  return r;
}

ShareValue operator*(const ShareValue& a, const ShareValue& b) {
  ShareValue r{a.v * b.v, {}};
  for (std::size_t k = 0; k < r.slope.size(); ++k) r.slope[k] = a.v * b.slope[k] + b.v * a.slope[k];
  return r;
}

/// Held between two bounds, where it does not change.
ShareValue clamped(const ShareValue& a, double low, double high) {
  if (a.v < low) return {low, {}};
  if (a.v > high) return {high, {}};
  return a;
}

ShareValue magnitude(const ShareValue& a) {
  return a.v < 0 ? -1.0 * a : a;
}

/// Σ weight_b n_b.
ShareValue weighted_sum(std::span<const double> n, std::span<const double> weight) {
  ShareValue r;
  for (std::size_t b = 0; b < n.size(); ++b) {
    r.v += weight[b] * n[b];
    r.slope[b] = weight[b];
  }
  return r;
}

using FaceShares = std::array<ShareValue, 8>;

FaceShares shares_of_line(std::span<const double> n) {
  constexpr std::array<double, 3> at{-1, 1, 0};
  const ShareValue xi = clamped(weighted_sum(n, at), -1, 1);
  FaceShares l;
  l[xi.v < 0 ? 0 : 1] = magnitude(xi);
  l[2] = 1.0 + -1.0 * magnitude(xi);
  return l;
}

// Node 3 lies between the corners 0 and 1, 4 between 1 and 2, 5 between 2 and 0.
FaceShares shares_of_triangle(std::span<const double> n) {
  constexpr std::array<std::array<double, 6>, 3> at{
      {{1, 0, 0, 0.5, 0, 0.5}, {0, 1, 0, 0.5, 0.5, 0}, {0, 0, 1, 0, 0.5, 0.5}}};
  std::array<ShareValue, 3> lambda;
  double total = 0;
  // Barycentric coordinates of the place, from the values of the shape functions; beyond the face
  // they are clamped and made to sum to one.
  for (std::size_t i = 0; i < 3; ++i) {
    lambda[i] = clamped(weighted_sum(n, at[i]), 0, 1);
    total += lambda[i].v;
  }
  for (ShareValue& value : lambda) value = (1 / total) * value;
  FaceShares l;
  // Each of the four parts of the triangle (three at the corners, one in the middle) has the linear
  // functions of its own three nodes.
  for (std::size_t i = 0; i < 3; ++i) {
    if (lambda[i].v <= 0.5) continue;
    const std::size_t next = (i + 1) % 3, last = (i + 2) % 3;
    l[i] = -1.0 + 2.0 * lambda[i];
    l[3 + i] = 2.0 * lambda[next];
    l[3 + last] = 2.0 * lambda[last];
    return l;
  }
  for (std::size_t i = 0; i < 3; ++i) l[3 + i] = 1.0 + -2.0 * lambda[(i + 2) % 3];
  return l;
}

// Node 4 lies between the corners 0 and 1, at η = −1, then on round the face.
FaceShares shares_of_quadrangle(std::span<const double> n) {
  constexpr std::array<double, 8> at_xi{-1, 1, 1, -1, 0, 1, 0, -1}, at_eta{-1, -1, 1, 1, -1, 0, 1, 0};
  // The place (ξ, η) from the values of the shape functions, clamped to the face.
  const ShareValue xi = clamped(weighted_sum(n, at_xi), -1, 1), eta = clamped(weighted_sum(n, at_eta), -1, 1);
  const ShareValue across = magnitude(xi), along = magnitude(eta);
  FaceShares l;
  // Near a corner, beyond the square of the middle nodes, the corner and its two middle nodes share
  // linearly.
  if (across.v + along.v >= 1) {
    const bool right = xi.v >= 0, up = eta.v >= 0;
    l[up ? (right ? 2 : 3) : (right ? 1 : 0)] = -1.0 + (across + along);
    l[up ? 6 : 4] = 1.0 + -1.0 * across;
    l[right ? 5 : 7] = 1.0 + -1.0 * along;
    return l;
  }
  // Within that square, which stands on its corner, the four middle nodes share bilinearly.
  const ShareValue p = xi + eta, q = xi + -1.0 * eta;
  l[4] = 0.25 * ((1.0 + -1.0 * p) * (1.0 + q));
  l[5] = 0.25 * ((1.0 + p) * (1.0 + q));
  l[6] = 0.25 * ((1.0 + p) * (1.0 + -1.0 * q));
  l[7] = 0.25 * ((1.0 + -1.0 * p) * (1.0 + -1.0 * q));
  return l;
}

}  // namespace

void positive_shares(int dimension, std::span<const double> n, std::span<double> l, std::span<double> slope) {
  const std::size_t size = n.size();
  // Only quadratic faces have shape functions that become negative.
  if (size != 8 && size != 6 && !(size == 3 && dimension == 2)) {
    std::copy(n.begin(), n.end(), l.begin());
    if (!slope.empty())
      for (std::size_t a = 0; a < size; ++a) slope[a * size + a] += 1;
    return;
  }
  const FaceShares found = size == 8   ? shares_of_quadrangle(n)
                           : size == 6 ? shares_of_triangle(n)
                                       : shares_of_line(n);
  // Values below zero are rounding; the slope is kept, so that the derivative does not jump there.
  for (std::size_t a = 0; a < size; ++a) {
    l[a] = std::max(found[a].v, 0.0);
    if (slope.empty()) continue;
    for (std::size_t b = 0; b < size; ++b) slope[a * size + b] += found[a].slope[b];
  }
}

}  // namespace solidus::contact
