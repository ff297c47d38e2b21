#include "new_case/feeding_distance.hpp"

#include <algorithm>
#include <cmath>

namespace solidus::new_case {

double FeedingDistance::along(double thickness, bool plate, bool to_an_end) const {
  constexpr double k_inch = 0.0254, k_plate = 4.5, k_bar = 6, k_between = 2;
  const double of_bar = k_bar * std::sqrt(thickness / k_inch) * k_inch;
  if (!to_an_end) return plate ? k_between * thickness : std::min(k_between * thickness, of_bar);
  return plate ? k_plate * thickness : of_bar;
}

std::optional<FeedingDistance> feeding_distance(const material::Material& alloy) {
  // Steels are known by their liquidus, between those of cast irons and of pure iron, and by what they have
  // no graphite.
  constexpr double k_least = 1600, k_most = 1812, k_heaviest = 8300, k_lightest = 6500;  // [K], [kg/m³]
  if (alloy.solidification() == nullptr || alloy.graphite) return {};
  const double liquidus = alloy.solidification()->fraction.liquidus();
  const bool steel =
      liquidus > k_least && liquidus < k_most && alloy.density > k_lightest && alloy.density < k_heaviest;
  return steel ? std::optional(FeedingDistance()) : std::nullopt;
}

}  // namespace solidus::new_case
