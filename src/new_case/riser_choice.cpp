#include "new_case/riser_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesh/making/metal_grid.hpp"
#include "new_case/riser_standing.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::new_case {

namespace {

using mesh::InscribedSphere;

constexpr double k_nearly = 0.8;  ///< radius of a place that is nearly the thickest, of that of the thickest
constexpr double k_open = 0.8;    ///< least depth of a way that feeds a place, of the depth of that place
constexpr std::size_t k_cubes = 60000, k_most_risers = 12;

/// Thick places that metal nearly as thick as they are connects.
struct Group {
  std::vector<InscribedSphere> places;  ///< the thickest first
  std::vector<double> widest;           ///< [cube] from the first of them
};

class Choice {
 public:
  Choice(const PartMeasures& part, double shrinkage, const std::optional<FeedingDistance>& distance,
         const std::optional<DraftSymmetry>& symmetry)
      : part_(part),
        shrinkage_(shrinkage),
        distance_(distance),
        symmetry_(symmetry),
        view_(part.mesh, part.metal),
        grid_(part.mesh, part.metal, k_cubes) {}

  RiserChoice choose() {
    for (const Group& group : groups()) put_on(group);
    if (distance_) put_where_too_far();
    give_metal();
    if (choice_.risers.size() > 1)
      for (std::size_t i = 0; i < choice_.risers.size(); ++i)
        choice_.risers[i].name = fmt::format("riser_{}", i + 1);
    return std::move(choice_);
  }

 private:
  double modulus_of(const InscribedSphere& place) const;
  std::vector<Group> groups() const;
  const InscribedSphere* place_to_feed(const std::vector<InscribedSphere>& places, double thickest) const;
  void put_on(const Group& group);
  void put_where_too_far();
  void give_metal();
  /// Puts a riser on a place where it is clear of the others; else notes the place.
  void put(const InscribedSphere& place, double modulus, int fixed);
  DraftRiser riser_on(const InscribedSphere& place, double diameter, int fixed) const;
  /// Places from which the risers feed, with the mirror images of those next to the plane behind them.
  std::vector<mesh::WayStart> feet() const;

  const PartMeasures& part_;
  double shrinkage_;
  const std::optional<FeedingDistance>& distance_;
  const std::optional<DraftSymmetry>& symmetry_;
  mesh::ViewFromAbove view_;
  mesh::MetalGrid grid_;
  RiserChoice choice_;
  std::vector<std::pair<InscribedSphere, int>> stands_on_;  ///< [riser] the place, the fixed coordinate
};

/// Area of triangles within a ball, by points spread over each [m²].
double area_in(const std::vector<std::array<mesh::Point, 3>>& triangles, const mesh::Point& centre,
               double radius) {
  const auto distance = [](const mesh::Point& a, const mesh::Point& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
  };
  double sum = 0;
  for (const auto& t : triangles) {
    const mesh::Point middle = {(t[0][0] + t[1][0] + t[2][0]) / 3, (t[0][1] + t[1][1] + t[2][1]) / 3,
                                (t[0][2] + t[1][2] + t[2][2]) / 3};
    double far = 0;
    for (const mesh::Point& corner : t) far = std::max(far, distance(corner, middle));
    // Triangles that are out of reach altogether are passed over, which are most of them.
    if (distance(middle, centre) > radius + far) continue;
    mesh::Point u{}, v{};
    for (std::size_t i = 0; i < 3; ++i) u[i] = t[1][i] - t[0][i], v[i] = t[2][i] - t[0][i];
    const double area =
        0.5 * std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]);
    // The triangle is divided into n² of its shape, each of which counts by its middle.
    const int n = std::clamp(static_cast<int>(std::ceil(5 * far / radius)), 1, 40);
    int inside = 0;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < 2 * (n - i) - 1; ++j) {
        const double down = j % 2 == 0 ? 1.0 / 3 : 2.0 / 3;
        const double a = (i + down) / n, b = (j / 2 + down) / n;
        inside += distance({t[0][0] + a * u[0] + b * v[0], t[0][1] + a * u[1] + b * v[1],
                            t[0][2] + a * u[2] + b * v[2]},
                           centre) < radius
                      ? 1
                      : 0;
      }
    sum += area * inside / (n * n);
  }
  return sum;
}

double Choice::modulus_of(const InscribedSphere& place) const {
  // The modulus of a place is the volume of metal over its cooled skin, both within a ball of twice the
  // radius of the place. A sphere has a third of its radius, and a plate all of half its thickness, between
  // which it must lie.
  const double radius = 2 * place.radius, area = area_in(view_.faces(), place.centre, radius);
  if (!(area > 0)) return place.radius;
  return std::clamp(grid_.volume_in(place.centre, radius) / area, place.radius / 3, place.radius);
}

std::vector<Group> Choice::groups() const {
  std::vector<Group> groups;
  for (InscribedSphere place : part_.spheres) {
    // Of a half, what lies beyond the plane is the image of what lies before it.
    if (symmetry_) {
      double& x = place.centre[as_size(symmetry_->axis)];
      x = std::min(x, 2 * symmetry_->at - x);
    }
    // A place joins the group from whose thickest place a way leads that is nearly as wide as itself; without
    // one it begins a group of its own, and gets a riser.
    const std::size_t cube = grid_.cube_at(place.centre);
    const auto open = [&](const Group& group) { return group.widest[cube] >= k_open * grid_.depth(cube); };
    if (const auto found = std::ranges::find_if(groups, open); found != groups.end())
      found->places.push_back(place);
    else
      groups.push_back({{place}, grid_.widest_ways(cube)});
  }
  return groups;
}

/// Chooses, of the places that are nearly as thick as the thickest of all, the one with the least metal above
/// its centre, and one with a hollow above it only where there is no other; null where there is none.
const InscribedSphere* Choice::place_to_feed(const std::vector<InscribedSphere>& places,
                                             double thickest) const {
  const InscribedSphere* best = nullptr;
  std::pair<bool, double> least{true, 1e300};
  for (const InscribedSphere& s : places) {
    if (s.radius < k_nearly * thickest) continue;
    const std::pair<bool, double> above{hollow_above(view_, s).has_value(),
                                        view_.top(s.centre) - s.centre[2]};
    if (above < least) least = above, best = &s;
  }
  return best;
}

DraftRiser Choice::riser_on(const InscribedSphere& place, double diameter, int fixed) const {
  DraftRiser riser = cylinder_on(view_, place.centre, diameter, fixed);
  riser.hollow = hollow_above(view_, place);
  riser.hot_spot = place.centre;
  return riser;
}

void Choice::put(const InscribedSphere& place, double modulus, int fixed) {
  constexpr double k_clear = 0.55;  // of the sum of the diameters
  // The diameter follows from the modulus alone here; the metal that the riser has to feed is known when all
  // risers stand.
  DraftRiser riser = riser_on(place, riser_diameter(modulus, 0, shrinkage_), fixed);
  riser.modulus = modulus;
  // Two that would touch or overlap are one lump of metal: the second is left out and told to the user.
  for (const DraftRiser& other : choice_.risers)
    if (std::hypot(riser.foot[0] - other.foot[0], riser.foot[1] - other.foot[1]) <
        k_clear * (riser.diameter + other.diameter)) {
      choice_.notes.push_back(fmt::format(
          "the thick place at ({:.4g}, {:.4g}, {:.4g}) mm is cut off from the others and would have its "
          "riser "
          "where one is already: see whether that feeds it, else a chill or a riser at its side will",
          1e3 * place.centre[0], 1e3 * place.centre[1], 1e3 * place.centre[2]));
      return;
    }
  choice_.risers.push_back(riser);
  stands_on_.emplace_back(place, fixed);
}

void Choice::put_on(const Group& group) {
  if (choice_.risers.size() == k_most_risers) return;
  double modulus = 0;
  for (const InscribedSphere& place : group.places) modulus = std::max(modulus, modulus_of(place));
  const double thickest = group.places.front().radius;
  const InscribedSphere& there = *place_to_feed(group.places, thickest);
  if (!symmetry_) return put(there, modulus, -1);
  // With a plane of symmetry a riser stands on the plane where a place of the group there is nearly as thick,
  // or where it would touch its image next to the plane.
  constexpr std::size_t k_most = 8;
  const auto axis = as_size(symmetry_->axis);
  std::vector<InscribedSphere> on_plane = mesh::inscribed_spheres(
      part_.mesh, part_.metal, k_most, mesh::HalfSpace{symmetry_->axis, symmetry_->at});
  std::erase_if(on_plane, [&](const InscribedSphere& s) {
    const std::size_t cube = grid_.cube_at(s.centre);
    return group.widest[cube] < k_open * grid_.depth(cube);
  });
  if (const InscribedSphere* place = place_to_feed(on_plane, thickest))
    return put(*place, modulus, symmetry_->axis);
  const DraftRiser beside = riser_on(there, riser_diameter(modulus, 0, shrinkage_), symmetry_->axis);
  if (on_plane.empty() || symmetry_->at - beside.foot[axis] > 0.5 * beside.diameter)
    return put(there, modulus, symmetry_->axis);
  put(on_plane.front(), modulus, symmetry_->axis);
}

std::vector<mesh::WayStart> Choice::feet() const {
  std::vector<mesh::WayStart> starts;
  // Ways begin under the foot, within half of the diameter and a quarter of it in depth.
  for (const DraftRiser& r : choice_.risers) starts.push_back({r.foot, 0.5 * r.diameter, 0.25 * r.diameter});
  if (!symmetry_) return starts;
  for (const DraftRiser& r : choice_.risers) {
    mesh::WayStart image{r.foot, 0.5 * r.diameter, 0.25 * r.diameter};
    double& x = image.centre[as_size(symmetry_->axis)];
    x = 2 * symmetry_->at - x;
    starts.push_back(image);
  }
  return starts;
}

void Choice::put_where_too_far() {
  // Each pass serves the place that is furthest beyond its feeding distance, by a riser as far from it as
  // feeds it and as near to the others as that allows.
  while (choice_.risers.size() < k_most_risers) {
    const mesh::WaysInMetal ways = grid_.shortest_ways(feet());
    std::size_t worst = 0;
    double most = 0, limit = 0;
    for (std::size_t c = 0; c < grid_.size(); ++c) {
      const double depth = grid_.depth(c);
      // What is much thinner than the thick places is solid before it asks for metal from far away.
      if (ways.from[c] < 0 || depth < 0.5 * part_.spheres.front().radius || !grid_.on_ridge(c)) continue;
      // No rule allows less than twice the thickness, so nearer places need no look.
      if (ways.length[c] - 4 * depth < most) continue;
      const double modulus = modulus_of({grid_.centre(c), depth});
      const double feeds =
          distance_->along(2 * depth, modulus > 0.75 * depth, !grid_.between_places(c, ways));
      if (ways.length[c] - feeds > most) most = ways.length[c] - feeds, worst = c, limit = feeds;
    }
    if (!(most > grid_.edge())) return;
    const mesh::WaysInMetal back = grid_.shortest_ways({{grid_.centre(worst), 0, 0}});
    std::size_t best = worst;
    for (std::size_t c = 0; c < grid_.size(); ++c)
      if (back.from[c] >= 0 && back.length[c] < limit && grid_.depth(c) > 0.8 * grid_.depth(worst) &&
          grid_.on_ridge(c) && ways.length[c] < ways.length[best])
        best = c;
    const std::size_t before = choice_.risers.size();
    const InscribedSphere place{grid_.centre(best), grid_.depth(best)};
    put(place, modulus_of(place), symmetry_ ? symmetry_->axis : -1);
    // A riser that found no room would be tried again for ever.
    if (choice_.risers.size() == before) return;
  }
}

void Choice::give_metal() {
  // Metal belongs to the riser from which the way to it is the shortest; of one on the plane of symmetry also
  // what its image, which is itself, feeds.
  const std::size_t n = choice_.risers.size();
  const mesh::WaysInMetal ways = grid_.shortest_ways(feet());
  std::vector<double> metal(n, 0);
  std::size_t counted = 0;
  for (std::size_t c = 0; c < grid_.size(); ++c) {
    if (ways.from[c] < 0) continue;
    ++counted;
    const auto from = as_size(ways.from[c]);
    if (from < n) ++metal[from];
  }
  for (std::size_t i = 0; i < n; ++i) {
    DraftRiser& riser = choice_.risers[i];
    // The start of a riser on the plane is found before its image, and has both halves.
    const double share = counted > 0 ? metal[i] / static_cast<double>(counted) : 1.0 / static_cast<double>(n);
    const double diameter = riser_diameter(riser.modulus, share * part_.volume, shrinkage_);
    // A riser only grows by the metal that it feeds, for its modulus asks for its diameter in any case.
    if (diameter <= riser.diameter) continue;
    const DraftRiser wider = riser_on(stands_on_[i].first, diameter, stands_on_[i].second);
    const double modulus = riser.modulus;
    riser = wider;
    riser.modulus = modulus;
  }
}

}  // namespace

RiserChoice choose_risers(const PartMeasures& part, double shrinkage,
                          const std::optional<FeedingDistance>& distance,
                          const std::optional<DraftSymmetry>& symmetry) {
  return Choice(part, shrinkage, distance, symmetry).choose();
}

}  // namespace solidus::new_case
