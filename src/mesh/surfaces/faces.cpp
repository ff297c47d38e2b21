/// Faces of the boundary are found among the faces of elements by their vertices.
#include "mesh/surfaces/faces.hpp"

#include "numbers/index_casts.hpp"

namespace solidus::mesh {

void find_face_owners(const RawMesh& mesh, const std::vector<std::string>& bodies, FaceOwners& wanted) {
  // Most faces of a large mesh lie inside and have a vertex that no wanted face has: no key is looked up.
  std::vector<char> marked(mesh.x.size(), 0);
  for (const auto& [key, owner] : wanted)
    for (const Index vertex : key.vertices)
      if (vertex >= 0) marked[as_size(vertex)] = 1;
  const auto is_marked = [&](Index vertex) { return marked[as_size(vertex)] != 0; };
  std::vector<Index> nodes;
  for (int b = 0; b < static_cast<int>(bodies.size()); ++b) {
    const RawGroup& group = mesh.groups.at(bodies[as_size(b)]);
    for (int k = 0; k < static_cast<int>(group.blocks.size()); ++k) {
      const RawBlock& block = group.blocks[as_size(k)];
      const int nn = node_count(block.shape), n_vertices = vertex_count(face_shape(block.shape));
      const Index n_elements = as_index(block.nodes.size()) / nn;
      for (Index e = 0; e < n_elements; ++e) {
        const Index* element = block.nodes.data() + static_cast<std::ptrdiff_t>(e) * nn;
        for (int f = 0; f < face_count(block.shape); ++f) {
          nodes.clear();
          for (const int a : face_nodes(block.shape, f)) nodes.push_back(element[a]);
          if (!std::all_of(nodes.begin(), nodes.begin() + n_vertices, is_marked)) continue;
          const auto found = wanted.find(face_key(nodes.data(), n_vertices));
          if (found != wanted.end() && found->second.body < 0) found->second = {b, k, f, e};
        }
      }
    }
  }
}

}  // namespace solidus::mesh
