/// A k-d tree: points are split at the middle along the longest side, and branches farther than the best
/// point are left out.
#include "mesh/nearest_point.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace solidus::mesh {

namespace {

/// So few points are looked at one by one.
constexpr std::size_t k_points_of_leaf = 8;

double squared_distance(const Point& a, const Point& b) {
  const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  return x * x + y * y + z * z;
}

/// From a place to a box; zero inside of it.
double squared_distance(const Point& at, const Point& low, const Point& high) {
  double sum = 0;
  for (std::size_t d = 0; d < 3; ++d) {
    const double beyond = std::max({low[d] - at[d], 0.0, at[d] - high[d]});
    sum += beyond * beyond;
  }
  return sum;
}

}  // namespace

NearestPoint::NearestPoint(const std::vector<Point>& points) : points_(points) {
  entries_.reserve(points.size());
  for (const Point& x : points) entries_.push_back({x, entries_.size()});
  if (!entries_.empty()) split(0, entries_.size());
}

/// Makes the part of some points and its halves.
/// @return its number
std::size_t NearestPoint::split(std::size_t begin, std::size_t end) {
  // The box of the part, by which a search leaves it out.
  Part part{entries_[begin].x, entries_[begin].x, begin, end};
  for (std::size_t i = begin; i < end; ++i)
    for (std::size_t d = 0; d < 3; ++d) {
      part.low[d] = std::min(part.low[d], entries_[i].x[d]);
      part.high[d] = std::max(part.high[d], entries_[i].x[d]);
    }
  const std::size_t number = parts_.size();
  parts_.push_back(part);
  if (end - begin <= k_points_of_leaf) return number;
  // The median across the longest side halves the points.
  std::size_t across = 0;
  for (std::size_t d = 1; d < 3; ++d)
    if (part.high[d] - part.low[d] > part.high[across] - part.low[across]) across = d;
  const std::size_t middle = begin + (end - begin) / 2;
  const auto at = [&](std::size_t i) { return entries_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end),
                   [&](const Entry& a, const Entry& b) { return a.x[across] < b.x[across]; });
  const std::size_t first = split(begin, middle), second = split(middle, end);
  parts_[number].first = first;
  parts_[number].second = second;
  return number;
}

void NearestPoint::search(const Part& part, const Point& at, Best& best) const {
  if (part.second == 0) {
    for (std::size_t i = part.begin; i < part.end; ++i) {
      const Entry& entry = entries_[i];
      const double squared = squared_distance(entry.x, at);
      if (squared < best.squared_distance || (squared == best.squared_distance && entry.number < best.number))
        best = {squared, entry.number};
    }
    return;
  }
  // First the half that may hold the nearer point. Rounding of distances to boxes rises with them as that of
  // distances to points does, so that what is as near is not missed.
  const Part *one = &parts_[part.first], *other = &parts_[part.second];
  double to_one = squared_distance(at, one->low, one->high);
  double to_other = squared_distance(at, other->low, other->high);
  if (to_other < to_one) std::swap(one, other), std::swap(to_one, to_other);
  if (to_one <= best.squared_distance) search(*one, at, best);
  if (to_other <= best.squared_distance) search(*other, at, best);
}

std::size_t NearestPoint::find(const Point& at, std::size_t guess) const {
  assert(guess < points_.size());
  Best best{squared_distance(points_[guess], at), guess};
  search(parts_.front(), at, best);
  return best.number;
}

}  // namespace solidus::mesh
