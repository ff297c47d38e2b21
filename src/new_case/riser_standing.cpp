#include "new_case/riser_standing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "new_case/rounding.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::new_case {

namespace {

constexpr double k_slender_riser = 1.5;  ///< height of a riser, of its diameter

/// The middle of the level ground around a place, as far as a cylinder may be moved: of a boss its axis, also
/// where it has a bore there. Nothing where the ground goes on beyond what is looked at, as that of a plate.
std::optional<mesh::Point> middle_of_ground(const mesh::ViewFromAbove& view, const mesh::Point& place,
                                            double diameter) {
  constexpr double k_level = 0.05, k_reach = 1.2;  // of the diameter
  constexpr int k_half = 12;                       // cells on either side
  constexpr int k_wide = 2 * k_half + 1;
  const double step = k_reach * diameter / k_half;
  const auto at = [&](int cell) {
    return mesh::Point{place[0] + (cell / k_wide - k_half) * step, place[1] + (cell % k_wide - k_half) * step,
                       -1e3};
  };
  // From the place over neighbouring cells of the same height.
  std::vector<int> ground = {k_half * k_wide + k_half};
  std::vector<char> seen(as_size(k_wide) * k_wide, 0);
  seen[as_size(ground.front())] = 1;
  double x = 0, y = 0;
  bool ends = true;
  for (std::size_t n = 0; n < ground.size(); ++n) {
    const int cell = ground[n], i = cell / k_wide, j = cell % k_wide;
    x += at(cell)[0], y += at(cell)[1];
    for (const auto& [di, dj] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
      const int ni = i + di, nj = j + dj;
      if (ni < 0 || nj < 0 || ni >= k_wide || nj >= k_wide) {
        ends = false;
        continue;
      }
      const int next = ni * k_wide + nj;
      if (seen[as_size(next)] != 0) continue;
      seen[as_size(next)] = 1;
      if (std::abs(view.top(at(next)) - place[2]) < k_level * diameter) ground.push_back(next);
    }
  }
  if (!ends) return {};
  const auto number = static_cast<double>(ground.size());
  return mesh::Point{x / number, y / number, place[2]};
}

/// How badly a cylinder stands, zero where all of its foot stands on a plane and no metal rises next to it.
/// @param centre  of the foot
double misfit(const mesh::ViewFromAbove& view, const mesh::Point& centre, double diameter) {
  constexpr double k_level = 0.05;     // of the diameter: heights that do not count
  constexpr double k_distance = 1.15;  // of the radius, within which metal that rises is in the way
  constexpr double k_raised = 10;      // metal in the way is so much worse than a foot that hangs over
  constexpr int k_directions = 24;
  double hanging = 0, raised = 0;
  for (const double share : {0.4, 0.8, k_distance})
    for (int i = 0; i < k_directions; ++i) {
      // Three rings of points tell the ground within the foot, near its edge and just next to it.
      const double angle = 2 * std::numbers::pi * i / k_directions, r = 0.5 * diameter * share;
      const mesh::Point below = {centre[0] + r * std::cos(angle), centre[1] + r * std::sin(angle), -1e3};
      const double step = (view.top(below) - centre[2]) / diameter;
      if (step > k_level) ++raised;
      // Next to the foot a step down does no harm.
      if (share < 1 && step < -k_level) ++hanging;
    }
  return (k_raised * raised + hanging) / k_directions;
}

/// Where it stands best so near the place that it covers it: metal next to it, a wall or a boss, would become
/// one with it. It may hang over an edge for that.
/// @param fixed  coordinate that has to stay as it is; none: -1
mesh::Point standing_place(const mesh::ViewFromAbove& view, const mesh::Point& place, double diameter,
                           int fixed) {
  constexpr double k_shift = 0.05;  // of the diameter: steps in which it is moved
  constexpr int k_shifts = 8, k_directions = 16;
  constexpr double k_near = 0.5;  // a foot that is moved by its diameter is worth a misfit of so much
  mesh::Point best = place;
  // The way to the place counts as well, so that a riser goes aside only for a better stand.
  double least = misfit(view, place, diameter);
  // The middle of a boss is better than any other place that is no worse to stand on.
  if (const std::optional<mesh::Point> middle = middle_of_ground(view, place, diameter);
      middle && fixed < 0) {
    constexpr double k_covers = 0.45;  // of the diameter: it is still over the place
    const bool covers = std::hypot((*middle)[0] - place[0], (*middle)[1] - place[1]) < k_covers * diameter;
    if (covers && misfit(view, *middle, diameter) <= least + k_near * k_shift) return *middle;
  }
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
  constexpr double k_deepest = 0.25;  // of the diameter: what lies deeper is next to the place
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

}  // namespace

std::optional<double> hollow_above(const mesh::ViewFromAbove& view, const mesh::InscribedSphere& place) {
  constexpr double k_thin = 0.1;  // of the diameter of the place
  // From the centre of the place upwards: where metal ends for the first time, and where it begins again.
  const double exit = view.first_exit(place.centre);
  const double entry = view.first_exit({place.centre[0], place.centre[1], exit + 1e-6 * place.radius});
  if (!(entry - exit > k_thin * 2 * place.radius)) return {};
  return entry - exit;
}

double riser_diameter(double modulus, double metal, double shrinkage) {
  constexpr double k_safety = 1.2;
  // An upright cylinder that is 1.5 diameters high and cooled at side and top has V/A = 0.214 D.
  constexpr double k_modulus = 0.375 / 1.75;
  const double by_modulus = k_safety * modulus / k_modulus;
  // It may give 14 % of its volume (Wlodawer's figure for open cylinders), and feeds itself as well.
  constexpr double k_yield = 0.14;
  const double needed = shrinkage * metal / std::max(k_yield - shrinkage, 0.02);
  const double by_metal = std::cbrt(needed / (0.25 * std::numbers::pi * k_slender_riser));
  // The larger of the two diameters satisfies both conditions, and whole millimetres are what patterns have.
  return rounded_up(std::max(by_modulus, by_metal), 1e-3);
}

DraftRiser cylinder_on(const mesh::ViewFromAbove& view, const mesh::Point& place, double diameter,
                       int fixed) {
  DraftRiser riser;
  riser.diameter = diameter;
  const mesh::Point centre = standing_place(view, {place[0], place[1], view.top(place)}, diameter, fixed);
  // In micrometres, as the text of the case has it: tops that differ by less would make slivers.
  const double sunk = to_micrometre(centre[2] - lowest_under(view, centre, diameter) + 0.05 * diameter);
  riser.foot = {to_micrometre(centre[0]), to_micrometre(centre[1]), to_micrometre(centre[2] - sunk)};
  riser.height = rounded_up(k_slender_riser * diameter, 1e-3) + sunk;
  riser.neck_height = sunk;  // a sleeve would begin at the skin of the part
  return riser;
}

}  // namespace solidus::new_case
