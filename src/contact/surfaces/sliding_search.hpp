/// The closest face of a surface that moves: an R-tree of inflated boxes that serves until a node has moved
/// farther than the margin.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "contact/surfaces/search.hpp"

namespace solidus::contact {

class SlidingSearch {
 public:
  /// @param faces  at the start; SlidingSearch keeps no reference to them
  /// @param margin by which boxes are inflated [m]
  SlidingSearch(std::span<const Face> faces, double margin);
  ~SlidingSearch();

  /// The surface has moved to `faces`, which must live until the next move. Builds the tree again when a node
  /// is farther than the margin from where it was at the last build.
  void move(std::span<const Face> faces);
  /// The closest point of the surface within `max_distance` (3.4) on faces that look against the unit normal
  /// `facing`; of equally near faces the one with the lowest number. Depends on the faces alone, not on the
  /// tree nor the hint.
  /// @param hint a face that may be near, or −1
  SurfacePoint closest(const Point& p, double max_distance, const Point& facing, Index hint) const;
  /// Marks faces [face] for may_meet_watched(). @param faces  where they are now, as for move()
  void watch(std::vector<char> marked, std::span<const Face> faces);
  /// False only where closest() finds nothing or a face that is not marked: a point far from all of those
  /// costs a fraction of closest() then.
  bool may_meet_watched(const Point& p, double max_distance, const Point& facing, Index hint) const;
  int n_builds() const { return n_builds_; }

 private:
  void build();
  bool moved_beyond_margin() const;
  /// All faces within `radius` that may be the closest, in near_; `known` is projected already.
  void collect(const Point& p, double radius, const Point& facing, const SurfacePoint& known) const;

  std::span<const Face> faces_;
  double margin_, size_;
  int n_builds_ = 0;
  std::vector<Point> built_at_;  ///< nodes of every face at the last build
  struct Tree;
  std::unique_ptr<Tree> tree_, watched_;
  std::vector<char> marked_;
  mutable std::vector<SurfacePoint> near_;
};

}  // namespace solidus::contact
