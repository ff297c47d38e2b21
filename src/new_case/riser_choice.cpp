#include "new_case/riser_choice.hpp"

#include <algorithm>
#include <cmath>

#include "new_case/rounding.hpp"

namespace solidus::model {

namespace {

constexpr double k_nearly = 0.8;  ///< radius of a place that is nearly the thickest, of that of the thickest
constexpr double k_slender_riser = 1.5;  ///< height of a riser, of its diameter

/// Of the places that are nearly as thick as the thickest of all the one with the least metal above its
/// centre; null where none is.
const mesh::InscribedSphere* place_to_feed(const PartMeasures& part,
                                           const std::vector<mesh::InscribedSphere>& places) {
  const mesh::InscribedSphere* best = nullptr;
  double least = 1e300;
  for (const mesh::InscribedSphere& s : places) {
    const double above = mesh::top_above(part.mesh, part.metal, s.centre) - s.centre[2];
    if (s.radius >= k_nearly * part.spheres.front().radius && above < least) least = above, best = &s;
  }
  return best;
}

/// Diameter of a cylinder [m].
/// @param radius  of the sphere at the place that it feeds [m]
/// @param metal   volume that it feeds [m³]
double diameter_for(const PartMeasures& part, double radius, double metal, double shrinkage) {
  constexpr double k_safety = 1.2;
  // Of an upright cylinder that is 1.5 diameters high, cooled at side and top: V/A = 0.214 D.
  constexpr double k_modulus = 0.375 / 1.75;
  const double by_modulus = k_safety * std::max(part.volume / part.area, radius / 3) / k_modulus;
  // It may give 14 % of its volume (Wlodawer's figure for open cylinders), and feeds itself as well.
  constexpr double k_yield = 0.14;
  const double needed = shrinkage * metal / std::max(k_yield - shrinkage, 0.02);
  const double by_metal = std::cbrt(needed / (0.25 * 3.14159265358979 * k_slender_riser));
  return rounded_up(std::max(by_modulus, by_metal), 1e-3);
}

DraftRiser cylinder_on(const PartMeasures& part, const mesh::Point& place, double diameter) {
  DraftRiser riser;
  riser.diameter = diameter;
  const double top = mesh::top_above(part.mesh, part.metal, place);
  riser.foot = {place[0], place[1], top - 0.05 * diameter};
  riser.height = rounded_up(k_slender_riser * diameter, 1e-3) + 0.05 * diameter;
  return riser;
}

}  // namespace

DraftRiser choose_riser(const PartMeasures& part, double shrinkage,
                        const std::optional<DraftSymmetry>& symmetry) {
  const auto standing_on = [&](const mesh::InscribedSphere& place, double share) {
    return cylinder_on(part, place.centre, diameter_for(part, place.radius, share * part.volume, shrinkage));
  };
  const mesh::InscribedSphere* thickest = place_to_feed(part, part.spheres);
  if (!symmetry) return standing_on(*thickest, 1);
  constexpr std::size_t k_most = 8;
  const std::vector<mesh::InscribedSphere> there =
      mesh::inscribed_spheres(part.mesh, part.metal, k_most, mesh::HalfSpace{symmetry->axis, symmetry->at});
  if (const mesh::InscribedSphere* on_plane = place_to_feed(part, there)) return standing_on(*on_plane, 1);
  const DraftRiser beside = standing_on(*thickest, 0.5);
  const double distance = std::abs(beside.foot[static_cast<std::size_t>(symmetry->axis)] - symmetry->at);
  if (there.empty() || distance > 0.5 * beside.diameter) return beside;
  return standing_on(there.front(), 1);
}

}  // namespace solidus::model
