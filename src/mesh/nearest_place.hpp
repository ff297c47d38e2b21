/// The place of an element that is nearest to a point. On one process.
#pragma once

#include <limits>
#include <vector>

#include "mesh/mesh.hpp"

namespace solidus::mesh {

struct NearestPlace {
  double distance = std::numeric_limits<double>::infinity();  ///< [m], zero inside
  Shape shape = Shape::point1;  ///< the element itself, or the face, edge or vertex that holds the place
  std::vector<int> local;       ///< its nodes among the element's
  Point xi{};                   ///< in `shape`
};

/// In the element's interior, or, where that has no stationary point of the distance, on one of its faces,
/// and so on down to the vertices.
NearestPlace nearest_place(const Mesh& mesh, Shape shape, const Index* nodes, const Point& point);

/// Holds an element: the box around its nodes, widened for curved edges.
struct Box {
  Point low{}, high{};
};
Box element_box(const Mesh& mesh, const ElementBlock& block, Index e);
/// A lower bound of the distance to the elements in the box.
double distance_to_box(const Box& box, const Point& p);

}  // namespace solidus::mesh
