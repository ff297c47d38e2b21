/// 3 × 3 matrices of the contact geometry and the smallest rotation between two directions.
#pragma once

#include <array>

#include "contact/surfaces/vector.hpp"

namespace solidus::contact {

/// A 3 × 3 matrix, row-major.
using Tensor = std::array<std::array<double, 3>, 3>;

inline Tensor identity() {
  return {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
}
/// t += s a ⊗ b
inline void add_outer(Tensor& t, double s, const Point& a, const Point& b) {
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) t[i][j] += s * a[i] * b[j];
}
/// t += s a
inline void add_scaled(Tensor& t, double s, const Tensor& a) {
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) t[i][j] += s * a[i][j];
}
/// t += s I on the first `dimension` components
inline void add_identity(Tensor& t, double s, std::size_t dimension) {
  for (std::size_t i = 0; i < dimension; ++i) t[i][i] += s;
}
inline Point times(const Tensor& t, const Point& v) {
  return {dot(t[0], v), dot(t[1], v), dot(t[2], v)};
}
/// tᵀ v
inline Point transposed_times(const Tensor& t, const Point& v) {
  Point r{};
  for (std::size_t i = 0; i < 3; ++i) r = contact::add_scaled(r, v[i], t[i]);
  return r;
}
inline Tensor times(const Tensor& a, const Tensor& b) {
  Tensor r{};
  for (std::size_t i = 0; i < 3; ++i) r[i] = transposed_times(b, a[i]);
  return r;
}

/// R s, with R the rotation by the smallest angle that takes the unit vector a to the unit vector b,
///
///   R = I − (a + b) ⊗ (a + b)/(1 + a·b) + 2 b ⊗ a.
///
/// Opposite directions (a·b = −1) have no smallest rotation and are excluded.
inline Point rotate(const Point& a, const Point& b, const Point& s) {
  const Point sum = add(a, b);
  Point r = contact::add_scaled(s, -dot(sum, s) / (1 + dot(a, b)), sum);
  return contact::add_scaled(r, 2 * dot(a, s), b);
}

/// The derivatives of `rotate`, a and b taken as free vectors in the formula above.
struct RotationRates {
  Tensor by_from{};    ///< ∂(R s)/∂a
  Tensor by_to{};      ///< ∂(R s)/∂b
  Tensor by_vector{};  ///< R
};
RotationRates rotation_rates(const Point& a, const Point& b, const Point& s);

}  // namespace solidus::contact
