/// The parts are made by halving; a ray is tested against boxes by slabs and against triangles by Möller and
/// Trumbore (Journal of Graphics Tools 2, 1997).
#include "mesh/ray_search.hpp"

#include <algorithm>
#include <cmath>

namespace solidus::mesh {

namespace {

constexpr std::uint32_t k_leaf = 4;  ///< triangles of a part that is not halved

Point minus(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// The distance at which a ray meets a triangle; infinite where it does not.
double distance_to(const FlatTriangle& t, const Point& from, const Point& direction) {
  constexpr double k_none = std::numeric_limits<double>::infinity();
  // A hair wider than it is, so that no ray slips through between two triangles with a common edge.
  constexpr double k_edge = 1e-12;
  const Point a = minus(t[1], t[0]), b = minus(t[2], t[0]), p = cross(direction, b);
  const double determinant = dot(a, p);
  if (determinant == 0) return k_none;
  const Point s = minus(from, t[0]), q = cross(s, a);
  const double u = dot(s, p) / determinant, v = dot(direction, q) / determinant;
  if (u < -k_edge || v < -k_edge || u + v > 1 + k_edge) return k_none;
  return dot(b, q) / determinant;
}

/// The distance at which a ray enters a box; infinite where it passes by or meets something nearer before.
double entry(const Point& low, const Point& high, const Point& from, const Point& inverse, double farthest) {
  double enter = 0, leave = farthest;
  for (std::size_t i = 0; i < 3; ++i) {
    const double one = (low[i] - from[i]) * inverse[i], two = (high[i] - from[i]) * inverse[i];
    // A ray within the plane of a face gives no number there, which these comparisons leave out.
    enter = std::fmax(enter, std::fmin(one, two));
    leave = std::fmin(leave, std::fmax(one, two));
  }
  return enter <= leave * (1 + 1e-14) ? enter : std::numeric_limits<double>::infinity();
}

}  // namespace

RaySearch::RaySearch(std::vector<FlatTriangle> triangles) : triangles_(std::move(triangles)) {
  for (const FlatTriangle& t : triangles_) {
    Point middle{};
    for (const Point& corner : t)
      for (std::size_t i = 0; i < 3; ++i) middle[i] += corner[i] / 3;
    middles_.push_back(middle);
    order_.push_back(static_cast<std::uint32_t>(order_.size()));
  }
  if (triangles_.empty()) return;
  parts_.push_back({{}, {}, 0, static_cast<std::uint32_t>(order_.size()), 0});
  split(0);
  std::vector<Point>().swap(middles_);
}

void RaySearch::enclose(Part& part) const {
  constexpr double k_far = std::numeric_limits<double>::infinity();
  part.low = {k_far, k_far, k_far};
  part.high = {-k_far, -k_far, -k_far};
  for (std::uint32_t k = part.begin; k < part.end; ++k)
    for (const Point& corner : triangles_[order_[k]])
      for (std::size_t i = 0; i < 3; ++i) {
        part.low[i] = std::min(part.low[i], corner[i]);
        part.high[i] = std::max(part.high[i], corner[i]);
      }
}

void RaySearch::split(std::size_t number) {
  enclose(parts_[number]);
  const Part part = parts_[number];
  if (part.end - part.begin <= k_leaf) return;
  // The direction in which the middles reach farthest is halved at their median.
  Point low = middles_[order_[part.begin]], high = low;
  for (std::uint32_t k = part.begin; k < part.end; ++k)
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], middles_[order_[k]][i]);
      high[i] = std::max(high[i], middles_[order_[k]][i]);
    }
  std::size_t axis = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (high[i] - low[i] > high[axis] - low[axis]) axis = i;
  const std::uint32_t middle = part.begin + (part.end - part.begin) / 2;
  std::nth_element(order_.begin() + part.begin, order_.begin() + middle, order_.begin() + part.end,
                   [&](std::uint32_t a, std::uint32_t b) {
                     return middles_[a][axis] != middles_[b][axis] ? middles_[a][axis] < middles_[b][axis]
                                                                   : a < b;
                   });
  // The first half follows behind its part, the second one behind all parts of the first.
  parts_.push_back({{}, {}, part.begin, middle, 0});
  split(parts_.size() - 1);
  parts_[number].second = static_cast<std::uint32_t>(parts_.size());
  parts_.push_back({{}, {}, middle, part.end, 0});
  split(parts_.size() - 1);
}

RaySearch::Hit RaySearch::first(const Point& from, const Point& direction, double least) const {
  Hit best;
  if (parts_.empty()) return best;
  const Point inverse{1 / direction[0], 1 / direction[1], 1 / direction[2]};
  const auto enters = [&](std::size_t part) {
    return entry(parts_[part].low, parts_[part].high, from, inverse, best.distance);
  };
  // Parts that are still to be looked at, with the distance at which the ray enters them.
  struct Waiting {
    std::size_t part;
    double enter;
  };
  std::array<Waiting, 64> stack;
  std::size_t depth = 0;
  if (const double enter = enters(0); std::isfinite(enter)) stack[depth++] = {0, enter};
  while (depth > 0) {
    const Waiting now = stack[--depth];
    if (now.enter > best.distance) continue;
    const Part& part = parts_[now.part];
    if (part.second == 0) {
      for (std::uint32_t k = part.begin; k < part.end; ++k)
        if (const double d = distance_to(triangles_[order_[k]], from, direction);
            d > least && d < best.distance)
          best = {order_[k], d};
      continue;
    }
    // The nearer half is looked at first: it may spare the other one.
    Waiting a{now.part + 1, enters(now.part + 1)}, b{part.second, enters(part.second)};
    if (a.enter < b.enter) std::swap(a, b);
    for (const Waiting& half : {a, b})
      if (std::isfinite(half.enter)) stack[depth++] = half;
  }
  return best;
}

std::size_t RaySearch::bytes() const {
  return triangles_.capacity() * sizeof(FlatTriangle) + order_.capacity() * sizeof(std::uint32_t) +
         parts_.capacity() * sizeof(Part);
}

}  // namespace solidus::mesh
