/// Boxes are inflated by a margin when the tree is built; the tree is built again once a node has moved
/// farther than that. The answer depends on the faces alone.
#include "contact/surfaces/sliding_search.hpp"

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/iterator/function_output_iterator.hpp>
#include <utility>

#include "numbers/index_casts.hpp"

namespace solidus::contact {

namespace {

namespace bg = boost::geometry;
namespace bgi = boost::geometry::index;
using TreePoint = bg::model::point<double, 3, bg::cs::cartesian>;
using Box = bg::model::box<TreePoint>;
using Entry = std::pair<Box, Index>;

// Distances that differ by less than this part of themselves, or of a thousandth of a face, are equal.
constexpr double k_same = 1e-9;

Box box_around(const Point& low, const Point& high, double margin) {
  return {TreePoint(low[0] - margin, low[1] - margin, low[2] - margin),
          TreePoint(high[0] + margin, high[1] + margin, high[2] + margin)};
}

double distance_to_box(const Point& p, const std::array<Point, 2>& box) {
  Point d{};
  for (std::size_t i = 0; i < 3; ++i) d[i] = std::max({0.0, box[0][i] - p[i], p[i] - box[1][i]});
  return norm(d);
}

}  // namespace

struct SlidingSearch::Tree {
  bgi::rtree<Entry, bgi::rstar<16>> boxes;
};

SlidingSearch::SlidingSearch(std::span<const Face> faces, double margin) : faces_(faces), margin_(margin) {
  double sum = 0;
  for (const Face& f : faces) {
    const auto [low, high] = f.box();
    sum += distance(low, high);
  }
  size_ = sum / static_cast<double>(faces.size());
  near_.reserve(64);
  build();
  faces_ = {};
}

SlidingSearch::~SlidingSearch() = default;

void SlidingSearch::build() {
  std::vector<Entry> entries, watched;
  entries.reserve(faces_.size());
  built_at_.clear();
  // Boxes are wider than faces by a margin, so that the tree serves until a node has moved by that.
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    // A process also keeps a smaller tree of the faces that may concern it.
    const auto [low, high] = faces_[f].box();
    entries.emplace_back(box_around(low, high, margin_), as_index(f));
    if (!marked_.empty() && marked_[f] != 0) watched.push_back(entries.back());
    for (std::size_t a = 0; a < as_size(faces_[f].n_nodes); ++a) built_at_.push_back(faces_[f].x[a]);
  }
  tree_ = std::make_unique<Tree>(Tree{decltype(Tree::boxes)(entries)});
  watched_ = std::make_unique<Tree>(Tree{decltype(Tree::boxes)(watched)});
  ++n_builds_;
}

bool SlidingSearch::moved_beyond_margin() const {
  std::size_t i = 0;
  for (const Face& f : faces_)
    for (std::size_t a = 0; a < as_size(f.n_nodes); ++a, ++i)
      for (std::size_t k = 0; k < 3; ++k)
        if (!(std::abs(f.x[a][k] - built_at_[i][k]) <= margin_)) return true;
  return false;
}

void SlidingSearch::move(std::span<const Face> faces) {
  faces_ = faces;
  if (moved_beyond_margin()) build();
}

void SlidingSearch::collect(const Point& p, double radius, const Point& facing,
                            const SurfacePoint& known) const {
  near_.clear();
  double best = radius;
  // Faces as near as the nearest one within rounding, on the side that they face; the box of a face is asked
  // first.
  const auto consider = [&](const Entry& entry) {
    const Face& face = faces_[as_size(entry.second)];
    const double slack = k_same * (best + 1e-3 * size_);
    if (distance_to_box(p, face.box()) > best + slack) return;
    const Projection projection = entry.second == known.face ? known.projection : closest_point(face, p);
    if (projection.distance > best + slack) return;
    if (dot(face.normal(projection.xi), facing) >= k_facing_cosine) return;
    best = std::min(best, projection.distance);
    near_.push_back({entry.second, projection});
  };
  tree_->boxes.query(bgi::intersects(box_around(p, p, radius * (1 + k_same))),
                     boost::make_function_output_iterator(consider));
}

void SlidingSearch::watch(std::vector<char> marked, std::span<const Face> faces) {
  marked_ = std::move(marked);
  faces_ = faces;
  build();
}

bool SlidingSearch::may_meet_watched(const Point& p, double max_distance, const Point& facing,
                                     Index hint) const {
  double radius = max_distance;
  if (hint >= 0) {
    // The face that was met last bounds the distance of the closest one, where it still looks this way.
    const Face& face = faces_[as_size(hint)];
    const Projection there = closest_point(face, p);
    if (dot(face.normal(there.xi), facing) < k_facing_cosine) radius = std::min(radius, there.distance);
  }
  const double slack = 4 * k_same * (radius + 1e-3 * size_);
  const auto near = watched_->boxes.qbegin(bgi::intersects(box_around(p, p, radius + slack)));
  return near != watched_->boxes.qend();
}

SurfacePoint SlidingSearch::closest(const Point& p, double max_distance, const Point& facing,
                                    Index hint) const {
  double radius = 0.5 * size_;
  SurfacePoint known{.face = hint, .projection = {}};
  if (hint >= 0) {
    // No face is needed that is farther than the one that was met last.
    known.projection = closest_point(faces_[as_size(hint)], p);
    radius = known.projection.distance * (1 + 4 * k_same) + 4e-3 * k_same * size_;
  }
  // The radius grows by factors of four until a face is found whose distance lies within it: then
  // no face outside can be nearer.
  for (;; radius *= 4) {
    const bool last = radius >= max_distance;
    collect(p, last ? max_distance : radius, facing, known);
    if (near_.empty()) {
      if (last) return {};
      continue;
    }
    // The smallest distance, and of all faces that have it within rounding the lowest number.
    double best = max_distance;
    for (const SurfacePoint& s : near_) best = std::min(best, s.projection.distance);
    const double same = best + k_same * (best + 1e-3 * size_);
    if (!last && same > radius * (1 + k_same)) continue;
    const SurfacePoint* chosen = nullptr;
    for (const SurfacePoint& s : near_)
      if (s.projection.distance <= same && (!chosen || s.face < chosen->face)) chosen = &s;
    return *chosen;
  }
}

}  // namespace solidus::contact
