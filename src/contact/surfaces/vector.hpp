/// Three-component vectors of the contact geometry: mesh::Point with the few operations it needs here.
#pragma once

#include <cmath>

#include "mesh/shape.hpp"

namespace solidus::contact {

using mesh::Point;

inline Point add(const Point& a, const Point& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Point subtract(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Point scale(double s, const Point& a) {
  return {s * a[0], s * a[1], s * a[2]};
}
/// a + s b
inline Point add_scaled(const Point& a, double s, const Point& b) {
  return {a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]};
}
inline double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double norm(const Point& a) {
  return std::sqrt(dot(a, a));
}
inline double distance(const Point& a, const Point& b) {
  return norm(subtract(a, b));
}

/// Two unit vectors that form a right-handed basis with the unit vector n.
inline void tangent_basis(const Point& n, Point& e1, Point& e2) {
  // The axis least aligned with n, so that the cross product is well away from zero.
  const double x = std::abs(n[0]), y = std::abs(n[1]), z = std::abs(n[2]);
  const Point axis = x <= y && x <= z ? Point{1, 0, 0} : (y <= z ? Point{0, 1, 0} : Point{0, 0, 1});
  e1 = cross(n, axis);
  e1 = scale(1 / norm(e1), e1);
  e2 = cross(n, e1);
}

}  // namespace solidus::contact
