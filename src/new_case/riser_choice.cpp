#include "new_case/riser_choice.hpp"

#include <algorithm>
#include <cmath>

#include "new_case/rounding.hpp"

namespace solidus::model {

namespace {

/// Of the thick places that are nearly the thickest the one with the least metal above its centre.
const mesh::InscribedSphere& place_to_feed(const PartMeasures& part) {
  constexpr double k_nearly = 0.8;
  const mesh::InscribedSphere* best = &part.spheres.front();
  double least = 1e300;
  for (const mesh::InscribedSphere& s : part.spheres) {
    const double above = mesh::top_above(part.mesh, part.metal, s.centre) - s.centre[2];
    if (s.radius >= k_nearly * part.spheres.front().radius && above < least) least = above, best = &s;
  }
  return *best;
}

}  // namespace

DraftRiser choose_riser(const PartMeasures& part, double shrinkage) {
  const mesh::InscribedSphere& hot = place_to_feed(part);
  constexpr double k_safety = 1.2, k_slender = 1.5;
  // Of an upright cylinder that is 1.5 diameters high, cooled at side and top: V/A = 0.214 D.
  constexpr double k_modulus = 0.375 / 1.75;
  double diameter = k_safety * std::max(part.volume / part.area, hot.radius / 3) / k_modulus;
  // It may give 14 % of its volume (Wlodawer's figure for open cylinders), and feeds itself as well.
  constexpr double k_yield = 0.14;
  const double needed = shrinkage * part.volume / std::max(k_yield - shrinkage, 0.02);
  diameter = std::max(diameter, std::cbrt(needed / (0.25 * 3.14159265358979 * k_slender)));
  DraftRiser riser;
  riser.diameter = rounded_up(diameter, 1e-3);
  riser.height = rounded_up(k_slender * riser.diameter, 1e-3);
  const double top = mesh::top_above(part.mesh, part.metal, hot.centre);
  riser.foot = {hot.centre[0], hot.centre[1], top - 0.05 * riser.diameter};
  riser.height += 0.05 * riser.diameter;
  return riser;
}

}  // namespace solidus::model
