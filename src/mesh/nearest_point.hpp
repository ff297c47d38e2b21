/// Which of many points is the nearest one to a place.
#pragma once

#include <cstddef>
#include <vector>

#include "mesh/mesh.hpp"

namespace solidus::mesh {

/// Points are halved again and again across the direction in which they reach farthest, as in a k-d tree
/// (Bentley, Communications of the ACM 18, 1975); each part has its box, so that a place far from all points
/// looks at few of them.
class NearestPoint {
 public:
  explicit NearestPoint(const std::vector<Point>& points);

  /// The number of the nearest point, the least one where several are as near. There has to be a point.
  /// @param guess  a point that is near, where one is known: the search ends sooner
  std::size_t find(const Point& at, std::size_t guess = 0) const;

 private:
  struct Entry {
    Point x{};
    std::size_t number = 0;
  };
  /// The points from begin to end.
  struct Part {
    Point low{}, high{};
    std::size_t begin = 0, end = 0;
    std::size_t first = 0, second = 0;  ///< halves; 0: none
  };
  struct Best {
    double squared_distance;
    std::size_t number;
  };
  std::size_t split(std::size_t begin, std::size_t end);
  void search(const Part& part, const Point& at, Best& best) const;

  std::vector<Point> points_;
  std::vector<Entry> entries_;  ///< in the order of the parts
  std::vector<Part> parts_;     ///< the first holds all points
};

}  // namespace solidus::mesh
