#include "mesh/making/unused_parts.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "mesh/surfaces/faces.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mesh {

namespace {

/// Calls f(group, block, first node, number of nodes) for all elements of a mesh.
template <class Function>
void for_all_elements(RawMesh& mesh, Function f) {
  for (auto& [name, group] : mesh.groups)
    for (RawBlock& block : group.blocks) {
      const auto n = as_size(node_count(block.shape));
      for (std::size_t e = 0; e < block.nodes.size(); e += n) f(group, block, block.nodes.data() + e, n);
    }
}

/// Keeps of surfaces the faces that a body has, of lines and points what lies on nodes of bodies.
void leave_out_lower_elements(RawMesh& mesh, const std::vector<char>& used) {
  std::vector<std::string> bodies;
  for (const auto& [name, group] : mesh.groups)
    if (group.dimension == mesh.dimension) bodies.push_back(name);
  FaceOwners owners;
  // The faces that are asked for go in first, so that only their owners are looked for and not those of all
  // faces.
  for_all_elements(mesh, [&](const RawGroup& group, const RawBlock& block, const Index* nodes, std::size_t) {
    if (group.dimension == mesh.dimension - 1)
      owners.emplace(face_key(nodes, vertex_count(block.shape)), FaceOwner{});
  });
  find_face_owners(mesh, bodies, owners);
  for (auto& [name, group] : mesh.groups) {
    if (group.dimension == mesh.dimension) continue;
    for (RawBlock& block : group.blocks) {
      const auto n = as_size(node_count(block.shape));
      // Elements that stay keep their order and their numbers from the file.
      RawBlock kept{block.shape, {}, {}};
      for (std::size_t e = 0; e < block.nodes.size(); e += n) {
        const Index* nodes = block.nodes.data() + e;
        // A face needs a body that has it as a face: its nodes alone may all be used while the body next to
        // it is gone.
        const bool stays =
            group.dimension == mesh.dimension - 1
                ? owners.at(face_key(nodes, vertex_count(block.shape))).body >= 0
                : std::all_of(nodes, nodes + n, [&](Index node) { return used[as_size(node)] != 0; });
        if (!stays) continue;
        kept.nodes.insert(kept.nodes.end(), nodes, nodes + n);
        if (!block.input_element.empty()) kept.input_element.push_back(block.input_element[e / n]);
      }
      block = std::move(kept);
    }
  }
}

/// Nodes that are used move up in their order, and everything that names them follows.
void leave_out_nodes(RawMesh& mesh, const std::vector<char>& used) {
  std::vector<Index> renumbered(mesh.x.size(), -1);
  std::size_t n = 0;
  // New numbers are never larger than old ones, so that the nodes move within their own array.
  for (std::size_t i = 0; i < mesh.x.size(); ++i) {
    if (used[i] == 0) continue;
    renumbered[i] = as_index(n);
    mesh.x[n] = mesh.x[i];
    mesh.input_node[n++] = mesh.input_node[i];
  }
  mesh.x.resize(n);
  mesh.input_node.resize(n);
  for (auto& [name, group] : mesh.groups)
    for (RawBlock& block : group.blocks)
      for (Index& node : block.nodes) node = renumbered[as_size(node)];
  // A facet of a drawn face goes as soon as one of its nodes does; −1 stands where a facet has fewer corners.
  for (DrawnFace& face : mesh.drawn_faces) {
    std::erase_if(face.facets, [&](const std::array<Index, 4>& facet) {
      return std::ranges::any_of(facet, [&](Index v) { return v >= 0 && renumbered[as_size(v)] < 0; });
    });
    for (std::array<Index, 4>& facet : face.facets)
      for (Index& v : facet) v = v < 0 ? v : renumbered[as_size(v)];
  }
}

}  // namespace

void leave_out_unused(RawMesh& mesh) {
  // Nodes of bodies alone count as used: a surface whose body is gone must not keep its nodes alive.
  std::vector<char> used(mesh.x.size(), 0);
  for_all_elements(mesh, [&](const RawGroup& group, const RawBlock&, const Index* nodes, std::size_t n) {
    for (std::size_t a = 0; group.dimension == mesh.dimension && a < n; ++a) used[as_size(nodes[a])] = 1;
  });
  leave_out_lower_elements(mesh, used);
  leave_out_nodes(mesh, used);
}

void leave_out(RawMesh& mesh, const std::string& body) {
  mesh.groups.erase(body);
  leave_out_unused(mesh);
}

}  // namespace solidus::mesh
