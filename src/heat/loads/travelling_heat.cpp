/// The distribution is evaluated in a frame that moves with the source.
#include "heat/loads/travelling_heat.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace solidus::heat {

namespace {

/// Beyond so many radii nothing is delivered: exp(−3 · 9) is 2e-12 of the peak.
constexpr double k_reach = 3;

double dot(const Position& a, const Position& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Position cross(const Position& a, const Position& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// The part of a direction across d, of length one; none where there is none.
std::optional<Position> part_across(const Position& of, const Position& d) {
  constexpr double k_least = 1e-6;
  Position part = of;
  const double along = dot(of, d);
  for (std::size_t k = 0; k < 3; ++k) part[k] -= along * d[k];
  const double length = std::sqrt(dot(part, part));
  if (length < k_least) return {};
  for (double& p : part) p /= length;
  return part;
}

}  // namespace

TravellingHeat::TravellingHeat(std::shared_ptr<const TravelPath> path, const TravellingShape& shape,
                               Table efficiency, double step_share)
    : path_(std::move(path)), shape_(shape), efficiency_(std::move(efficiency)), step_share_(step_share) {
  // Beyond the reach nothing is evaluated; a beam on a surface has no end along its axis.
  const double flat = shape.kind == TravellingShape::Kind::double_ellipsoid
                          ? std::max({shape.width, shape.front, shape.rear, shape.depth})
                          : shape.radius;
  reach_ = std::hypot(k_reach * flat, shape.depth);
  if (shape.kind == TravellingShape::Kind::gaussian) reach_ = HUGE_VAL;  // along its axis
}

/// The moving frame: where the source is, the direction of travel across its axis, and the one across both.
TravellingHeat::Frame TravellingHeat::frame(double time) const {
  Frame f;
  f.centre = path_->at(time);
  // A source that stands, or moves along its own axis, has no heading across it: any one will do.
  std::optional<Position> along = part_across(path_->heading(time), shape_.direction);
  for (std::size_t k = 0; !along; ++k) {
    Position axis{};
    axis[k] = 1;
    along = part_across(axis, shape_.direction);
  }
  f.along = *along;
  f.across = cross(shape_.direction, f.along);
  return f;
}

/// The distributions of docs/theory/growth.md for a power of one, at distances along travel, across it and
/// along the axis.
double TravellingHeat::density(double xi, double eta, double zeta) const {
  using Kind = TravellingShape::Kind;
  constexpr double k_pi = std::numbers::pi;
  const double r2 = shape_.radius * shape_.radius, d2 = xi * xi + eta * eta;
  switch (shape_.kind) {
    case Kind::double_ellipsoid: {
      const double c = xi >= 0 ? shape_.front : shape_.rear,
                   f = 2 * (xi >= 0 ? shape_.front_share : 1 - shape_.front_share);
      const double a = shape_.width, b = shape_.depth;
      const double exponent = 3 * (xi * xi / (c * c) + eta * eta / (a * a) + zeta * zeta / (b * b));
      if (exponent > 3 * k_reach * k_reach) return 0;
      return 6 * std::numbers::sqrt3 * f / (a * b * c * k_pi * std::sqrt(k_pi)) * std::exp(-exponent);
    }
    case Kind::gaussian:
      return d2 < k_reach * k_reach * r2 ? 3 / (k_pi * r2) * std::exp(-3 * d2 / r2) : 0;
    case Kind::cylinder:
      return d2 <= r2 && zeta >= 0 && zeta <= shape_.depth ? 1 / (k_pi * r2 * shape_.depth) : 0;
    case Kind::line:
      return d2 < k_reach * k_reach * r2 && zeta >= 0 && zeta <= shape_.depth
                 ? 3 / (k_pi * r2 * shape_.depth) * std::exp(-3 * d2 / r2)
                 : 0;
  }
  return 0;
}

void TravellingHeat::values(std::span<const Position> x, double time, std::span<double> values) const {
  std::fill(values.begin(), values.end(), 0.0);
  const double strength = path_->on(time) * efficiency_.value(time);
  if (strength == 0) return;
  // Places out of reach are left out before their distances are computed.
  const Frame f = frame(time);
  for (std::size_t i = 0; i < x.size(); ++i) {
    Position r{};
    bool far = false;
    for (std::size_t k = 0; k < 3; ++k) {
      r[k] = x[i][k] - f.centre[k];
      far = far || std::abs(r[k]) > reach_;
    }
    if (!far) values[i] = strength * density(dot(r, f.along), dot(r, f.across), dot(r, shape_.direction));
  }
}

void TravellingHeat::add_spots(double time, std::vector<PlaceSpot>& spots) const {
  using Kind = TravellingShape::Kind;
  if (path_->on(time) == 0) return;
  const Frame f = frame(time);
  const auto add = [&](const Position& direction, double distance, double radius) {
    PlaceSpot spot{f.centre, radius};
    for (std::size_t k = 0; k < 3; ++k) spot.centre[k] += distance * direction[k];
    spots.push_back(spot);
  };
  // The smallest radius finds the peak. What is longer than wide gets spots along its length.
  if (shape_.kind == Kind::double_ellipsoid) {
    const double radius = std::min({shape_.width, shape_.depth, shape_.front, shape_.rear});
    for (const double distance : {-0.5 * shape_.rear, 0.0, 0.5 * shape_.front})
      add(f.along, distance, radius);
    return;
  }
  constexpr int k_most = 32;
  // A deep source gets a spot for about every two radii of depth, so that each part of it is integrated.
  const double depth = shape_.kind == Kind::gaussian ? 0 : shape_.depth;
  const int n = std::clamp(static_cast<int>(std::ceil(0.5 * depth / shape_.radius)), 1, k_most);
  for (int i = 0; i < n; ++i) add(shape_.direction, depth * (i + 0.5) / n, shape_.radius);
}

void TravellingHeat::add_bends(double from, double to, std::vector<double>& times) const {
  path_->add_bends(from, to, times);
  for (const double time : efficiency_.x())
    if (time > from && time < to) times.push_back(time);
}

double TravellingHeat::length() const {
  return shape_.kind == TravellingShape::Kind::double_ellipsoid ? shape_.front + shape_.rear
                                                                : 2 * shape_.radius;
}

std::optional<Crossing> TravellingHeat::crossing(double from, double to) const {
  const double speed = path_->fastest(from, to);
  return Crossing{speed > 0 ? length() / speed : HUGE_VAL, step_share_};
}

}  // namespace solidus::heat
