#include "criteria/die_nodes.hpp"

#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"

namespace solidus::criteria {

std::vector<int> die_nodes(const mesh::Mesh& mesh, const std::vector<char>& followed) {
  // Owners hold all elements of a node, so that ghosts get theirs from them.
  std::vector<double> owner(mesh.x.size(), -1.0);
  for (const mesh::ElementBlock& block : mesh.blocks) {
    if (followed[as_size(block.body)] == 0) continue;
    for (const Index node : block.nodes) {
      double& of_node = owner[as_size(node)];
      if (of_node < 0 || block.body < of_node) of_node = block.body;
    }
  }
  parallel::GhostExchange ghosts(mesh);
  ghosts.update(owner, 1);
  return {owner.begin(), owner.end()};
}

}  // namespace solidus::criteria
