/// The first triangle that a ray meets, among many.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "mesh/mesh.hpp"

namespace solidus::mesh {

using FlatTriangle = std::array<Point, 3>;

/// Triangles are halved again and again across the direction in which their middles reach farthest; each part
/// has its box, and a ray looks at the parts that it passes through, the nearer ones first.
class RaySearch {
 public:
  explicit RaySearch(std::vector<FlatTriangle> triangles);

  struct Hit {
    std::size_t triangle = k_none;
    double distance = std::numeric_limits<double>::infinity();  ///< in lengths of the direction
    explicit operator bool() const { return triangle != k_none; }
  };
  /// Where several triangles are as near, the one that is found first. Triangles have no thickness and no
  /// sides.
  /// @param least  nearer triangles do not count, as the one that the ray starts from [lengths of direction]
  Hit first(const Point& from, const Point& direction, double least) const;
  std::size_t bytes() const;

 private:
  static constexpr std::size_t k_none = std::numeric_limits<std::size_t>::max();
  /// A part: its box, and its halves or its triangles.
  struct Part {
    Point low{}, high{};
    std::uint32_t begin = 0, end = 0;  ///< in order_
    std::uint32_t second = 0;          ///< the second half; the first one follows; zero: it has triangles
  };
  void split(std::size_t part);
  void enclose(Part& part) const;

  std::vector<FlatTriangle> triangles_;
  std::vector<Point> middles_;
  std::vector<std::uint32_t> order_;  ///< of the triangles, part by part
  std::vector<Part> parts_;           ///< the first holds all
};

}  // namespace solidus::mesh
