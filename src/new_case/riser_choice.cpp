#include "new_case/riser_choice.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "new_case/rounding.hpp"

namespace solidus::new_case {

namespace {

constexpr double k_nearly = 0.8;  ///< radius of a place that is nearly the thickest, of that of the thickest
constexpr double k_slender_riser = 1.5;  ///< height of a riser, of its diameter

/// Thickness of what is no metal above a place, up to the first metal above that, as sand under a handle
/// [m]; none where it is thinner than a tenth of the place.
std::optional<double> hollow_above(const mesh::ViewFromAbove& view, const mesh::InscribedSphere& place) {
  constexpr double k_thin = 0.1;  // of the diameter of the place
  const double exit = view.first_exit(place.centre);
  const double entry = view.first_exit({place.centre[0], place.centre[1], exit + 1e-6 * place.radius});
  if (!(entry - exit > k_thin * 2 * place.radius)) return {};
  return entry - exit;
}

/// Chooses, of the places that are nearly as thick as the thickest of all, the one with the least metal above
/// its centre, and one with a hollow above it only where there is no other; null where there is none.
const mesh::InscribedSphere* place_to_feed(const PartMeasures& part, const mesh::ViewFromAbove& view,
                                           const std::vector<mesh::InscribedSphere>& places) {
  const mesh::InscribedSphere* best = nullptr;
  std::pair<bool, double> least{true, 1e300};
  for (const mesh::InscribedSphere& s : places) {
    if (s.radius < k_nearly * part.spheres.front().radius) continue;
    const std::pair<bool, double> above{hollow_above(view, s).has_value(), view.top(s.centre) - s.centre[2]};
    if (above < least) least = above, best = &s;
  }
  return best;
}

/// Diameter of a cylinder [m].
/// @param radius  of the sphere at the place that it feeds [m]
/// @param metal   volume that it feeds [m³]
double diameter_for(const PartMeasures& part, double radius, double metal, double shrinkage) {
  constexpr double k_safety = 1.2;
  // An upright cylinder that is 1.5 diameters high and cooled at side and top has V/A = 0.214 D.
  constexpr double k_modulus = 0.375 / 1.75;
  const double by_modulus = k_safety * std::max(part.volume / part.area, radius / 3) / k_modulus;
  // It may give 14 % of its volume (Wlodawer's figure for open cylinders), and feeds itself as well.
  constexpr double k_yield = 0.14;
  const double needed = shrinkage * metal / std::max(k_yield - shrinkage, 0.02);
  const double by_metal = std::cbrt(needed / (0.25 * std::numbers::pi * k_slender_riser));
  return rounded_up(std::max(by_modulus, by_metal), 1e-3);
}

/// How badly a cylinder stands, zero where all of its foot stands on a plane and no metal rises beside it.
/// @param centre  of the foot
double misfit(const mesh::ViewFromAbove& view, const mesh::Point& centre, double diameter) {
  constexpr double k_level = 0.05;     // of the diameter: heights that do not count
  constexpr double k_distance = 1.15;  // of the radius, within which metal that rises is in the way
  constexpr double k_raised = 10;      // metal in the way is so much worse than a foot that hangs over
  constexpr int k_directions = 24;
  double hanging = 0, raised = 0;
  for (const double share : {0.4, 0.8, k_distance})
    for (int i = 0; i < k_directions; ++i) {
      const double angle = 2 * std::numbers::pi * i / k_directions, r = 0.5 * diameter * share;
      const mesh::Point below = {centre[0] + r * std::cos(angle), centre[1] + r * std::sin(angle), -1e3};
      const double step = (view.top(below) - centre[2]) / diameter;
      if (step > k_level) ++raised;
      if (share < 1 && step < -k_level) ++hanging;
    }
  return (k_raised * raised + hanging) / k_directions;
}

/// Where it stands best so near the place that it covers it: metal beside it, a wall or a boss, would become
/// one with it. It may hang over an edge for that.
/// @param fixed  coordinate that has to stay as it is; none: -1
mesh::Point standing_place(const mesh::ViewFromAbove& view, const mesh::Point& place, double diameter,
                           int fixed) {
  constexpr double k_shift = 0.05;  // of the diameter: steps in which it is moved
  constexpr int k_shifts = 8, k_directions = 16;
  constexpr double k_near = 0.5;  // a foot that is moved by its diameter is worth a misfit of so much
  mesh::Point best = place;
  double least = misfit(view, place, diameter);
  for (int k = 1; k <= k_shifts && least > 0; ++k)
    for (int i = 0; i < k_directions; ++i) {
      const double angle = 2 * std::numbers::pi * i / k_directions;
      mesh::Point moved = place;
      if (fixed != 0) moved[0] += k * k_shift * diameter * std::cos(angle);
      if (fixed != 1) moved[1] += k * k_shift * diameter * std::sin(angle);
      const double all = misfit(view, moved, diameter) + k_near * k * k_shift;
      if (all < least) least = all, best = moved;
    }
  return best;
}

/// The lowest metal under a foot that is no deeper below its centre than a quarter of its diameter: a foot
/// that stood above a recess would leave a sheet of sand in it that no pattern has.
double lowest_under(const mesh::ViewFromAbove& view, const mesh::Point& centre, double diameter) {
  constexpr double k_deepest = 0.25;  // of the diameter: what lies deeper is beside the place
  constexpr int k_directions = 24;
  double lowest = centre[2];
  for (const double share : {0.25, 0.5, 0.75, 1.0})
    for (int i = 0; i < k_directions; ++i) {
      const double angle = 2 * std::numbers::pi * i / k_directions, r = 0.5 * diameter * share;
      const double top = view.top({centre[0] + r * std::cos(angle), centre[1] + r * std::sin(angle), -1e3});
      if (top > centre[2] - k_deepest * diameter) lowest = std::min(lowest, top);
    }
  return lowest;
}

/// @param fixed  see standing_place()
DraftRiser cylinder_on(const mesh::ViewFromAbove& view, const mesh::Point& place, double diameter,
                       int fixed) {
  DraftRiser riser;
  riser.diameter = diameter;
  const mesh::Point centre = standing_place(view, {place[0], place[1], view.top(place)}, diameter, fixed);
  const double sunk = centre[2] - lowest_under(view, centre, diameter) + 0.05 * diameter;
  riser.foot = {centre[0], centre[1], centre[2] - sunk};
  riser.height = rounded_up(k_slender_riser * diameter, 1e-3) + sunk;
  return riser;
}

}  // namespace

DraftRiser choose_riser(const PartMeasures& part, double shrinkage,
                        const std::optional<DraftSymmetry>& symmetry) {
  const mesh::ViewFromAbove view(part.mesh, part.metal);
  const int fixed = symmetry ? symmetry->axis : -1;
  const auto standing_on = [&](const mesh::InscribedSphere& place, double share) {
    DraftRiser riser = cylinder_on(view, place.centre,
                                   diameter_for(part, place.radius, share * part.volume, shrinkage), fixed);
    riser.hollow = hollow_above(view, place);
    return riser;
  };
  // On the thickest place that can be fed from above. With a plane of symmetry a riser stands on the plane or
  // takes half of the volume at its own side.
  const mesh::InscribedSphere* thickest = place_to_feed(part, view, part.spheres);
  if (!symmetry) return standing_on(*thickest, 1);
  constexpr std::size_t k_most = 8;
  const std::vector<mesh::InscribedSphere> there =
      mesh::inscribed_spheres(part.mesh, part.metal, k_most, mesh::HalfSpace{symmetry->axis, symmetry->at});
  if (const mesh::InscribedSphere* on_plane = place_to_feed(part, view, there))
    return standing_on(*on_plane, 1);
  const DraftRiser beside = standing_on(*thickest, 0.5);
  const double distance = std::abs(beside.foot[static_cast<std::size_t>(symmetry->axis)] - symmetry->at);
  if (there.empty() || distance > 0.5 * beside.diameter) return beside;
  return standing_on(there.front(), 1);
}

}  // namespace solidus::new_case
