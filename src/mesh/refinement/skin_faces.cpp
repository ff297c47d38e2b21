/// Faces that two elements of a body share cancel each other.
#include "mesh/refinement/skin_faces.hpp"

#include <algorithm>
#include <array>

#include "mesh/surfaces/faces.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mesh {

namespace {

constexpr int k_most_faces = 6;  // of an element

struct Found {
  Index block = 0, element = 0;
  int face = 0;
  bool inside = false;  ///< two elements of one body have it
};

}  // namespace

std::vector<ElementBlock> skin_faces(const Mesh& mesh) {
  std::unordered_map<FaceKey, Found, FaceKeyHash> found;
  std::array<Index, 8> face{};
  // All elements around an owned node are here, so that a face at such a node is judged rightly.
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const ElementBlock& block = mesh.blocks[b];
    const int n_vertices = vertex_count(face_shape(block.shape));
    for (Index e = 0; e < block.size(); ++e)
      for (int f = 0; f < face_count(block.shape); ++f) {
        const auto places = face_nodes(block.shape, f);
        bool mine = false;
        for (int k = 0; k < n_vertices; ++k) {
          face[as_size(k)] = block.element(e)[places[as_size(k)]];
          mine = mine || face[as_size(k)] < mesh.n_owned_nodes;
        }
        if (!mine) continue;
        const auto [place, is_new] =
            found.emplace(face_key(face.data(), n_vertices), Found{as_index(b), e, f, false});
        if (is_new) continue;
        // Of two bodies the first one keeps the face.
        Found& before = place->second;
        const int other = mesh.blocks[as_size(before.block)].body;
        if (other == block.body)
          before.inside = true;
        else if (block.body < other)
          before = {as_index(b), e, f, false};
      }
  }
  // Faces of one shape go into one block, with numbers that follow from those of their elements.
  std::vector<ElementBlock> blocks;
  for (const auto& [key, at_face] : found) {
    if (at_face.inside) continue;
    const ElementBlock& parent = mesh.blocks[as_size(at_face.block)];
    const Shape shape = face_shape(parent.shape);
    auto block = std::find_if(blocks.begin(), blocks.end(),
                              [&](const ElementBlock& made) { return made.shape == shape; });
    if (block == blocks.end()) {
      blocks.push_back({shape, -1, {}, {}, 0});
      block = blocks.end() - 1;
    }
    for (const int a : face_nodes(parent.shape, at_face.face))
      block->nodes.push_back(parent.element(at_face.element)[a]);
    block->input_element.push_back(parent.input_element[as_size(at_face.element)] * k_most_faces +
                                   at_face.face);
    ++block->n_counted;
  }
  return blocks;
}

}  // namespace solidus::mesh
