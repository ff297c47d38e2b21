/// Local coordinate systems in which decks give the places of nodes.
#pragma once

#include <array>
#include <optional>

#include "mesh/mesh.hpp"

namespace solidus::mesh {

/// What the three coordinates of a node are. Angles are in degrees.
enum class Coordinates {
  rectangular,  ///< x, y, z
  cylindrical,  ///< r, theta, z
  spherical     ///< r, theta from the third axis, phi around it from the first one
};

/// An origin and three axes, which are unit vectors.
struct LocalSystem {
  Point origin{};
  std::array<Point, 3> axes{Point{1, 0, 0}, Point{0, 1, 0}, Point{0, 0, 1}};
  Coordinates coordinates = Coordinates::rectangular;

  /// The global place of a point that is given in this system.
  Point global(const Point& local) const;
};

/// x, y, z of a point in the axes of its own system.
Point rectangular(const Point& local, Coordinates coordinates);

Point difference(const Point& a, const Point& b);
Point cross_product(const Point& a, const Point& b);
double dot_product(const Point& a, const Point& b);
double length_of(const Point& a);

/// The three axes of which the first points along `first` and the second lies in the plane of `first` and
/// `towards_second`; nothing where the two are parallel or one is zero.
std::optional<std::array<Point, 3>> axes_along(const Point& first, const Point& towards_second);

/// `x` turned by an angle around the line through `a` and `b`, by the rule of the right hand; nothing where
/// the two are one point.
/// @param degrees  the angle
std::optional<Point> turned(const Point& x, const Point& a, const Point& b, double degrees);

}  // namespace solidus::mesh
