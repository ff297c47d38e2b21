/// Elements ask a table for the node at each place of their lattices.
#include "mesh/refinement/level.hpp"

#include <algorithm>

#include "numbers/index_casts.hpp"
#include "system/processes.hpp"

namespace solidus::mesh {

namespace {

/// @param node_of  node at a key
template <class NodeOf>
Cut cut(const ElementBlock& block, const InputNumbers& global, NodeOf&& node_of) {
  const Lattice& lattice = lattice_of(block.shape);
  Cut made{&block, {}};
  made.nodes.reserve(as_size(block.size()) * lattice.points.size());
  for (Index e = 0; e < block.size(); ++e) {
    const Index* nodes = block.element(e);
    for (const LatticePoint& point : lattice.points) {
      if (point.old >= 0) {
        made.nodes.push_back(nodes[point.old]);
        continue;
      }
      const NodeKey key = key_of(point, nodes, global);
      made.nodes.push_back(key.vertex[0] < 0 ? -1 : node_of(key));
    }
  }
  return made;
}

}  // namespace

Level::Level(const Part& of) : part(of), table(of.mesh.n_nodes()), rank_(processes::rank()) {
  const Mesh& mesh = part.mesh;
  for (const std::int64_t number : processes::gather(std::int64_t{mesh.first_owned})) first.push_back(number);
  first.push_back(mesh.n_global_nodes);
  cut_all();
  find_sources();
  // Owners of old nodes stay; a new one goes to the owner of one of its vertices.
  owner.reserve(as_size(n_nodes()));
  for (Index i = 0; i < n_old(); ++i) owner.push_back(owner_of(mesh.global_node[as_size(i)]));
  for (Index i = n_old(); i < n_nodes(); ++i) owner.push_back(owner_of(table.key(i)));
  // New nodes lie where the element's own functions say: for straight edges in their middles.
  x = mesh.x;
  x.resize(as_size(n_nodes()), Point{});
  for (Index i = n_old(); i < n_nodes(); ++i) {
    const Source& s = source[as_size(i - n_old())];
    if (s.block < 0) continue;  // its owner tells
    const ElementBlock& block = mesh.blocks[as_size(s.block)];
    const std::vector<double>& basis = lattice_of(block.shape).basis[as_size(s.point)];
    const Index* nodes = block.element(s.element);
    for (std::size_t a = 0; a < basis.size(); ++a)
      for (std::size_t k = 0; k < 3; ++k) x[as_size(i)][k] += basis[a] * mesh.x[as_size(nodes[a])][k];
  }
}

int Level::owner_of(GlobalIndex number) const {
  return static_cast<int>(std::upper_bound(first.begin(), first.end() - 1, number) - first.begin()) - 1;
}

int Level::owner_of(const NodeKey& key) const {
  // The owner of a vertex holds all elements around it, and so all around the new node. Which vertex it is
  // changes from node to node, so that the seam between two processes is shared evenly.
  std::size_t n = 0;
  std::uint64_t sum = 0;
  for (const Index v : key.vertex)
    if (v >= 0) {
      ++n;
      sum += static_cast<std::uint64_t>(part.mesh.global_node[as_size(v)]);
    }
  return owner_of(part.mesh.global_node[as_size(key.vertex[(sum ^ sum >> 3) % n])]);
}

void Level::cut_all() {
  const Mesh& mesh = part.mesh;
  // Volumes and faces make nodes; what goes along finds those that are there.
  const auto make = [&](const NodeKey& key) { return table.at(key); };
  const auto find = [&](const NodeKey& key) { return table.find(key); };
  for (const ElementBlock& block : mesh.blocks) volumes.push_back(cut(block, mesh.global_node, make));
  for (const auto& [name, surface] : mesh.surfaces)
    for (const ElementBlock& block : surface.faces) faces[name].push_back(cut(block, mesh.global_node, make));
  for (const ElementBlock& block : part.skin) skin.push_back(cut(block, mesh.global_node, make));
  for (const auto& [name, blocks] : part.others)
    for (const ElementBlock& block : blocks) others[name].push_back(cut(block, mesh.global_node, find));
}

void Level::find_sources() {
  source.assign(as_size(table.size()), {});
  const auto number = [&](const Source& s) {
    return part.mesh.blocks[as_size(s.block)].input_element[as_size(s.element)];
  };
  for (std::size_t b = 0; b < volumes.size(); ++b) {
    const Cut& c = volumes[b];
    const auto n_points = static_cast<std::int32_t>(lattice_of(c.block->shape).points.size());
    for (Index e = 0; e < c.block->size(); ++e)
      for (std::int32_t p = 0; p < n_points; ++p) {
        const Index node = c.element(e)[p];
        if (node < n_old()) continue;
        Source& best = source[as_size(node - n_old())];
        const Source here{static_cast<std::int32_t>(b), e, p};
        if (best.block < 0 || number(here) < number(best)) best = here;
      }
  }
}

}  // namespace solidus::mesh
