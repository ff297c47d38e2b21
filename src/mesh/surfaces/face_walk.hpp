/// Walks over the elements of groups and over the faces of the elements of bodies.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "mesh/raw_mesh.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mesh {

inline const Point& point_of(const RawMesh& mesh, Index node) {
  return mesh.x[as_size(node)];
}

/// The mean of the points of some nodes [m].
inline Point middle_of(const RawMesh& mesh, std::span<const Index> nodes) {
  Point c{};
  for (const Index node : nodes)
    for (std::size_t i = 0; i < 3; ++i) c[i] += point_of(mesh, node)[i] / static_cast<double>(nodes.size());
  return c;
}

/// Calls f(nodes, vertices) for all elements of a group.
template <class Function>
void for_each_element(const RawGroup& group, Function f) {
  for (const RawBlock& block : group.blocks) {
    const auto n = as_size(node_count(block.shape)), n_vertices = as_size(vertex_count(block.shape));
    for (std::size_t first = 0; first + n <= block.nodes.size(); first += n) {
      const std::span<const Index> nodes = std::span(block.nodes).subspan(first, n);
      f(nodes, nodes.first(n_vertices));
    }
  }
}

/// A face of an element: the element's nodes and which of them are the face's. Valid as long as the mesh.
struct Face {
  Shape shape = Shape::point1;
  Shape element_shape = Shape::point1;
  std::span<const Index> element;
  std::span<const int> places;

  std::vector<Index> nodes() const {  ///< of the face
    std::vector<Index> result;
    for (const int a : places) result.push_back(element[as_size(a)]);
    return result;
  }
};

/// Calls f(vertices, face) for all faces of the elements of a body, one element after the other.
template <class Function>
void for_each_face(const RawMesh& mesh, const std::string& body, Function f) {
  std::array<Index, 4> vertices{};
  for (const RawBlock& block : mesh.groups.at(body).blocks) {
    const auto n = as_size(node_count(block.shape));
    const Shape shape = face_shape(block.shape);
    const auto n_vertices = as_size(vertex_count(shape));
    std::vector<std::span<const int>> places;
    for (int k = 0; k < face_count(block.shape); ++k) places.push_back(face_nodes(block.shape, k));
    for (std::size_t first = 0; first + n <= block.nodes.size(); first += n) {
      const std::span<const Index> element = std::span(block.nodes).subspan(first, n);
      for (const std::span<const int> face : places) {
        for (std::size_t a = 0; a < n_vertices; ++a) vertices[a] = element[as_size(face[a])];
        f(std::span<const Index>(vertices.data(), n_vertices), Face{shape, block.shape, element, face});
      }
    }
  }
}

}  // namespace solidus::mesh
