/// Which way melt goes by itself: down, or away from the axis about which it turns.
///
/// Levels of a melt at rest are planes normal to gravity, and cylinders about the axis where it turns so fast
/// that its weight does not matter.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "mesh/mesh.hpp"

namespace solidus::criteria {

struct AxisOfTurning {
  std::array<double, 3> axis{0, 0, 1};  ///< of length one
  std::array<double, 3> point{};        ///< [m]
};

struct Upward {
  std::array<double, 3> up{0, 1, 0};     ///< of length one; against gravity
  std::optional<AxisOfTurning> turning;  ///< absent: gravity acts

  /// The way from the axis to a place [m].
  mesh::Point radius(const mesh::Point& x) const {
    mesh::Point r{};
    double along = 0;
    for (std::size_t i = 0; i < 3; ++i) along += (x[i] - turning->point[i]) * turning->axis[i];
    for (std::size_t i = 0; i < 3; ++i) r[i] = x[i] - turning->point[i] - along * turning->axis[i];
    return r;
  }
  /// Height of a place, or the distance from the axis with its sign changed [m].
  double height(const mesh::Point& x) const {
    if (!turning) return x[0] * up[0] + x[1] * up[1] + x[2] * up[2];
    const mesh::Point r = radius(x);
    return -std::hypot(r[0], r[1], r[2]);
  }
  /// The direction in which the height grows, of length one; on the axis zero.
  std::array<double, 3> direction(const mesh::Point& x) const {
    if (!turning) return up;
    const mesh::Point r = radius(x);
    const double length = std::hypot(r[0], r[1], r[2]);
    std::array<double, 3> inward{};
    for (std::size_t i = 0; i < 3 && length > 0; ++i) inward[i] = -r[i] / length;
    return inward;
  }
};

}  // namespace solidus::criteria
