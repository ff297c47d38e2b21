/// The function is evaluated at all points at once; a steady one only the first time.
#include "mechanics/loads/placed_force.hpp"

#include "numbers/index_casts.hpp"

namespace solidus::mechanics {

void PlacedForce::add(double time, std::span<double> force) const {
  if (at_points_.empty() || !value_.steady()) {
    at_points_.resize(points_.size());
    value_.values(points_, time, at_points_);
  }
  for (const Share& share : shares_) force[as_size(share.entry)] += share.weight * at_points_[share.point];
}

}  // namespace solidus::mechanics
