/// Faces of the skin whose nodes are all in a set make its surface.
#include "setup/node_set_surfaces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>
#include <vector>

#include "mesh/surfaces/faces.hpp"
#include "numbers/index_casts.hpp"
#include "setup/mesh_soundness.hpp"
#include "system/log.hpp"

namespace solidus::setup {

namespace {

/// The face of an element, as its own nodes outward.
struct SkinFace {
  mesh::Shape shape = mesh::Shape::point1;
  std::vector<Index> nodes;
  GlobalIndex element = 0;
  int n_elements = 0;  ///< that have it
};

/// The faces of one element of the bodies alone whose vertices are all marked.
std::vector<SkinFace> marked_skin(const cases::CaseSpec& spec, const mesh::RawMesh& mesh,
                                  const std::vector<char>& marked) {
  // Each face by its sorted vertices, with how many elements have it.
  std::unordered_map<mesh::FaceKey, SkinFace, mesh::FaceKeyHash> faces;
  std::vector<Index> nodes;
  for (const cases::BodySpec& body : spec.bodies)
    for (const mesh::RawBlock& block : mesh.groups.at(body.mesh_group()).blocks) {
      const auto n = as_size(node_count(block.shape));
      const mesh::Shape shape = mesh::face_shape(block.shape);
      const int vertices = vertex_count(shape);
      for (std::size_t e = 0; e * n < block.nodes.size(); ++e)
        for (int f = 0; f < face_count(block.shape); ++f) {
          nodes.clear();
          for (const int a : face_nodes(block.shape, f)) nodes.push_back(block.nodes[e * n + as_size(a)]);
          // All vertices of the face must be marked; nodes on edges need not.
          if (!std::all_of(nodes.begin(), nodes.begin() + vertices,
                           [&](Index i) { return marked[as_size(i)] != 0; }))
            continue;
          SkinFace& face = faces[mesh::face_key(nodes.data(), vertices)];
          if (face.n_elements++ == 0)
            face = {shape, nodes, block.input_element.empty() ? 0 : block.input_element[e], 1};
        }
    }
  // Faces of two elements lie inside.
  std::vector<SkinFace> skin;
  for (auto& [key, face] : faces)
    if (face.n_elements == 1) skin.push_back(std::move(face));
  std::ranges::sort(skin, {}, &SkinFace::nodes);
  return skin;
}

}  // namespace

void make_surfaces_of_node_sets(const cases::CaseSpec& spec, mesh::RawMesh& mesh) {
  // Some programs write surfaces as sets of nodes. Where a section needs faces, those of the skin whose nodes
  // are all in the set make the surface.
  for (const auto& [name, where] : wanted_surfaces(spec)) {
    const auto group = mesh.groups.find(name);
    if (group == mesh.groups.end() || group->second.dimension != 0) continue;
    std::vector<char> marked(mesh.x.size(), 0);
    std::size_t n_nodes = 0;
    for (const mesh::RawBlock& block : group->second.blocks)
      for (const Index i : block.nodes) n_nodes += std::exchange(marked[as_size(i)], 1) == 0;
    mesh::RawGroup surface{mesh.dimension - 1, {}};
    for (const SkinFace& face : marked_skin(spec, mesh, marked)) {
      auto block = std::ranges::find(surface.blocks, face.shape, &mesh::RawBlock::shape);
      if (block == surface.blocks.end())
        block = surface.blocks.insert(block, mesh::RawBlock{face.shape, {}, {}});
      block->nodes.insert(block->nodes.end(), face.nodes.begin(), face.nodes.end());
      block->input_element.push_back(face.element);
      // Nodes that became part of a face are marked, so that others can be told.
      for (const Index i : face.nodes) marked[as_size(i)] = 2;
    }
    std::size_t n_faces = 0;
    for (const mesh::RawBlock& block : surface.blocks) n_faces += block.input_element.size();
    // A set without any whole face cannot be a surface.
    if (n_faces == 0)
      throw InputError(
          where,
          fmt::format("the group '{}' is a set of {} nodes, and no face on the skin of the bodies has "
                      "all of its corners in it",
                      name, n_nodes),
          "a surface, or a set that holds the corners of whole faces");
    logging::info("the set of {} nodes '{}' serves as the surface of the {} faces between them", n_nodes,
                  name, n_faces);
    if (const auto alone = std::ranges::count(marked, char{1}); alone > 0)
      logging::warn("{} of the {} nodes of '{}' lie on no such face", alone, n_nodes, name);
    group->second = std::move(surface);
  }
}

}  // namespace solidus::setup
