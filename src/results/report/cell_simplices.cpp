/// Cuts cells and faces into tetrahedra and triangles.
#include <algorithm>

#include "numbers/index_casts.hpp"
#include "results/report/body_mesh.hpp"

namespace solidus::results {

using mesh::Shape;

std::vector<std::array<int, 3>> face_triangles(Shape face) {
  switch (face) {
    case Shape::tri3:
      return {{0, 1, 2}};
    case Shape::tri6:
      return {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}};
    case Shape::quad4:
      return {{0, 1, 2}, {0, 2, 3}};
    case Shape::quad8:
      return {{0, 4, 7}, {4, 1, 5}, {5, 2, 6}, {6, 3, 7}, {4, 5, 7}, {5, 6, 7}};
    default:
      return {};
  }
}

std::vector<std::vector<int>> simplices(Shape shape) {
  std::vector<std::vector<int>> out;
  switch (shape) {
    case Shape::tri3:
    case Shape::tri6:
    case Shape::quad4:
    case Shape::quad8:
      for (const auto& t : face_triangles(shape)) out.push_back({t[0], t[1], t[2]});
      return out;
    case Shape::tet4:
      return {{0, 1, 2, 3}};
    case Shape::tet10:
      // Mid nodes lie on the edges (0,1), (1,2), (2,0), (3,0), (3,2), (3,1): four tetrahedra at the corners,
      // four around the diagonal (4,8) of the octahedron between them.
      return {{0, 4, 6, 7}, {4, 1, 5, 9}, {6, 5, 2, 8}, {7, 9, 8, 3},
              {4, 8, 5, 6}, {4, 8, 6, 7}, {4, 8, 7, 9}, {4, 8, 9, 5}};
    case Shape::hex8:
    case Shape::hex20:
      // From corner 0 to the triangles of the faces that do not have it.
      for (int f = 0; f < mesh::face_count(shape); ++f) {
        const std::span<const int> nodes = mesh::face_nodes(shape, f);
        if (std::find(nodes.begin(), nodes.end(), 0) != nodes.end()) continue;
        for (const auto& t : face_triangles(mesh::face_shape(shape))) {
          std::vector<int>& simplex = out.emplace_back(std::vector<int>{0});
          for (const int corner : t) simplex.push_back(nodes[as_size(corner)]);
        }
      }
      return out;
    default:
      return out;
  }
}

}  // namespace solidus::results
