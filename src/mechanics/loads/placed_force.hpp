/// Nodal forces of a load that varies from place to place: its values at Gauss points of faces or elements,
/// each with the nodes that it loads.
///
///   f_a = Σ_q w_q N_a(ξ_q) d_q v(x_q, t)      d: −n of a pressure, a direction of the coordinates else
///
/// The rule is exact for the shape functions times a linear v on straight faces and elements; what changes
/// faster than an element is as wrong as the rule is.
#pragma once

#include <span>
#include <vector>

#include "numbers/place_function.hpp"
#include "numbers/types.hpp"

namespace solidus::mechanics {

class PlacedForce {
 public:
  explicit PlacedForce(PlaceFunction value) : value_(std::move(value)) {}

  /// Adds a point at which the value is taken; returns its number.
  std::size_t add_point(const Position& x) {
    points_.push_back(x);
    return points_.size() - 1;
  }
  /// @param entry   degree of freedom of an owned node
  /// @param weight  force per unit of the value at the point [m²], [m³]
  void add_share(Index entry, std::size_t point, double weight) { shares_.push_back({entry, point, weight}); }
  /// force += the load at a time, [owned node][component] [N]. Throws InputError as the function does. Not
  /// collective.
  void add(double time, std::span<double> force) const;

 private:
  struct Share {
    Index entry;
    std::size_t point;
    double weight;
  };
  PlaceFunction value_;
  std::vector<Position> points_;
  std::vector<Share> shares_;
  mutable std::vector<double> at_points_;  ///< of the last time; of a steady function of all times
};

}  // namespace solidus::mechanics
