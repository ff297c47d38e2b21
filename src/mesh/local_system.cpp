/// Rectangular, cylindrical and spherical coordinates to global ones; sines of right angles are exact.
#include "mesh/local_system.hpp"

#include <cmath>
#include <numbers>

namespace solidus::mesh {

namespace {

constexpr double k_degree = std::numbers::pi / 180;

// Sine and cosine of multiples of 90 degrees are exact, so that corners of sectors lie on the axes.
double sine(double degrees) {
  const double quarters = std::remainder(degrees, 360.0) / 90;
  if (quarters == std::round(quarters)) {
    const int quarter = (static_cast<int>(quarters) + 4) % 4;
    return quarter == 1 ? 1 : quarter == 3 ? -1 : 0;
  }
  return std::sin(degrees * k_degree);
}
double cosine(double degrees) {
  return sine(degrees + 90);
}

Point sum(const Point& origin, double a, const Point& x, double b, const Point& y, double c, const Point& z) {
  Point result = origin;
  for (std::size_t i = 0; i < 3; ++i) result[i] += a * x[i] + b * y[i] + c * z[i];
  return result;
}

Point scaled(const Point& a, double factor) {
  return {a[0] * factor, a[1] * factor, a[2] * factor};
}

}  // namespace

Point difference(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Point cross_product(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double dot_product(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

double length_of(const Point& a) {
  return std::hypot(a[0], a[1], a[2]);
}

Point rectangular(const Point& local, Coordinates coordinates) {
  switch (coordinates) {
    case Coordinates::cylindrical:
      return {local[0] * cosine(local[1]), local[0] * sine(local[1]), local[2]};
    case Coordinates::spherical: {
      const double from_axis = local[0] * sine(local[1]);
      return {from_axis * cosine(local[2]), from_axis * sine(local[2]), local[0] * cosine(local[1])};
    }
    case Coordinates::rectangular:
      break;
  }
  return local;
}

Point LocalSystem::global(const Point& local) const {
  const Point x = rectangular(local, coordinates);
  return sum(origin, x[0], axes[0], x[1], axes[1], x[2], axes[2]);
}

std::optional<std::array<Point, 3>> axes_along(const Point& first, const Point& towards_second) {
  const Point third = cross_product(first, towards_second);
  constexpr double k_parallel = 1e-10;
  if (!(length_of(third) > k_parallel * length_of(first) * length_of(towards_second))) return std::nullopt;
  const Point x = scaled(first, 1 / length_of(first)), z = scaled(third, 1 / length_of(third));
  return std::array{x, cross_product(z, x), z};
}

std::optional<Point> turned(const Point& x, const Point& a, const Point& b, double degrees) {
  const double length = length_of(difference(b, a));
  if (!(length > 0)) return std::nullopt;
  const Point axis = scaled(difference(b, a), 1 / length), from_a = difference(x, a);
  const double along = dot_product(axis, from_a), c = cosine(degrees), s = sine(degrees);
  return sum(a, c, from_a, s, cross_product(axis, from_a), (1 - c) * along, axis);
}

}  // namespace solidus::mesh
