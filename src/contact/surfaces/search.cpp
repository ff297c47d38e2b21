/// Boxes of faces in an R-tree (Boost.Geometry) come in order of their distance, so that the search ends as
/// soon as no box can hold anything nearer.
#include "contact/surfaces/search.hpp"

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <utility>

#include "numbers/index_casts.hpp"

namespace solidus::contact {

namespace {

namespace bg = boost::geometry;
namespace bgi = boost::geometry::index;
using TreePoint = bg::model::point<double, 3, bg::cs::cartesian>;
using Box = bg::model::box<TreePoint>;
using Entry = std::pair<Box, Index>;

TreePoint tree_point(const Point& p) {
  return {p[0], p[1], p[2]};
}

// Distances that differ by less than this part of the larger one are equal: the lower face number wins.
constexpr double k_same = 1e-9;

bool faces_against(const Face& face, const Point& xi, const Point& n) {
  return dot(face.normal(xi), n) < k_facing_cosine;
}

}  // namespace

struct FaceSearch::Tree {
  bgi::rtree<Entry, bgi::rstar<16>> boxes;
};

FaceSearch::FaceSearch(std::vector<Face> faces) : faces_(std::move(faces)) {
  std::vector<Entry> entries;
  entries.reserve(faces_.size());
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const auto [low, high] = faces_[f].box();
    entries.emplace_back(Box(tree_point(low), tree_point(high)), as_index(f));
  }
  tree_ = std::make_unique<Tree>(Tree{decltype(Tree::boxes)(entries)});
}

FaceSearch::~FaceSearch() = default;

std::vector<Index> FaceSearch::candidates(const Point& low, const Point& high) const {
  std::vector<Index> found;
  const Box box(tree_point(low), tree_point(high));
  for (auto it = tree_->boxes.qbegin(bgi::intersects(box)); it != tree_->boxes.qend(); ++it)
    found.push_back(it->second);
  std::sort(found.begin(), found.end());
  return found;
}

SurfacePoint FaceSearch::closest(const Point& p, double max_distance, const Point* facing) const {
  SurfacePoint best;
  const auto n = static_cast<unsigned>(faces_.size());
  const TreePoint query = tree_point(p);
  // Boxes come in the order of their distance, which bounds that of their face from below.
  for (auto it = tree_->boxes.qbegin(bgi::nearest(query, n)); it != tree_->boxes.qend(); ++it) {
    const double bound = bg::distance(query, it->first);
    // Once the next box is farther than the best face, all others are farther too.
    if (bound > max_distance || (best.face >= 0 && bound > best.projection.distance * (1 + k_same))) break;
    const Face& candidate = face(it->second);
    const Projection projection = closest_point(candidate, p);
    // The exact distance decides; a face that looks the same way as the slave is the back of a thin
    // wall.
    if (projection.distance > max_distance) continue;
    if (facing && !faces_against(candidate, projection.xi, *facing)) continue;
    // Two faces that meet at an edge are equally near but for rounding: the lower number wins, so
    // that the choice is the same on all processes.
    const double margin = k_same * std::max(projection.distance, 1e-3 * candidate.size());
    const bool nearer = best.face < 0 || projection.distance < best.projection.distance - margin;
    const bool equal = best.face >= 0 && !nearer && projection.distance <= best.projection.distance + margin;
    if (nearer || (equal && it->second < best.face)) best = {it->second, projection};
  }
  return best;
}

SurfacePoint FaceSearch::along(const Point& p, const Point& n, double max_distance, double tolerance) const {
  Point low, high;
  for (std::size_t i = 0; i < 3; ++i) {
    const double reach = std::abs(n[i]) * max_distance + 1e-6 * max_distance;
    low[i] = p[i] - reach;
    high[i] = p[i] + reach;
  }
  return along(p, n, max_distance, tolerance, candidates(low, high));
}

SurfacePoint FaceSearch::along(const Point& p, const Point& n, double max_distance, double tolerance,
                               const std::vector<Index>& among) const {
  SurfacePoint best;
  // The nearest face that looks against the normal; of faces as near within rounding the first.
  for (Index f : among) {
    const Face& candidate = face(f);
    const Projection projection = project_along(candidate, p, n, tolerance);
    if (!projection.found || std::abs(projection.distance) > max_distance) continue;
    if (!faces_against(candidate, projection.xi, n)) continue;
    const double margin = k_same * candidate.size();
    if (best.face < 0 || std::abs(projection.distance) < std::abs(best.projection.distance) - margin)
      best = {f, projection};
  }
  return best;
}

std::vector<Face> reference_faces(const ContactSurface& surface) {
  std::vector<Face> faces;
  faces.reserve(as_size(surface.n_faces()));
  for (Index f = 0; f < surface.n_faces(); ++f) faces.push_back(surface.reference_face(f));
  return faces;
}

}  // namespace solidus::contact
