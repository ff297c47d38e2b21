/// The node or element with a value is described by its body, place and surroundings.
#include "results/fields/spots.hpp"

#include <algorithm>

#include "numbers/index_casts.hpp"

namespace solidus::results {

namespace {

std::span<const Index> nodes_of_element(const mesh::ElementBlock& block, Index element) {
  return {block.element(element), as_size(mesh::node_count(block.shape))};
}

}  // namespace

mesh::Point centre(const mesh::Mesh& mesh, const mesh::ElementBlock& block, Index element) {
  mesh::Point sum{};
  const int n = mesh::node_count(block.shape);
  for (int a = 0; a < n; ++a)
    for (std::size_t k = 0; k < 3; ++k) sum[k] += mesh.x[as_size(block.element(element)[a])][k] / n;
  return sum;
}

std::vector<char> nodes_of(const mesh::Mesh& mesh, const std::vector<char>& bodies) {
  std::vector<char> chosen(mesh.x.size(), 0);
  for (const mesh::ElementBlock& block : mesh.blocks)
    if (bodies[as_size(block.body)] != 0)
      for (const Index node : block.nodes) chosen[as_size(node)] = 1;
  return chosen;
}

std::optional<Spot> node_spot(const mesh::Mesh& mesh, const mesh::Point& where,
                              const std::vector<char>& counts) {
  std::size_t own = 0;
  const auto n_owned = as_size(mesh.n_owned_nodes);
  // The own node at that place, and its neighbours over elements.
  while (own < n_owned && (counts[own] == 0 || mesh.x[own] != where)) ++own;
  if (own == n_owned) return {};
  Spot spot{own, {}};
  // All that share an element with the node are its neighbours, each once.
  for (const mesh::ElementBlock& block : mesh.blocks)
    for (Index e = 0; e < block.size(); ++e) {
      const std::span<const Index> nodes = nodes_of_element(block, e);
      if (std::find(nodes.begin(), nodes.end(), as_index(own)) == nodes.end()) continue;
      for (const Index node : nodes)
        if (const auto i = as_size(node); i != own && counts[i] != 0) spot.around.push_back(i);
    }
  std::sort(spot.around.begin(), spot.around.end());
  spot.around.erase(std::unique(spot.around.begin(), spot.around.end()), spot.around.end());
  return spot;
}

std::optional<Spot> element_spot(const mesh::Mesh& mesh, const mesh::Point& where) {
  std::optional<Spot> spot;
  std::span<const Index> own;
  int body = -1;
  // A visit of all elements with their number in the fields.
  const auto visit = [&](const auto& look) {
    std::size_t first = 0;
    for (const mesh::ElementBlock& block : mesh.blocks) {
      for (Index e = 0; e < block.size(); ++e) look(block, e, first + as_size(e));
      first += as_size(block.size());
    }
  };
  // The element whose centre is there, then all of its body that share a node with it.
  visit([&](const mesh::ElementBlock& block, Index e, std::size_t at) {
    if (spot || e >= block.n_counted || centre(mesh, block, e) != where) return;
    spot = Spot{at, {}};
    own = nodes_of_element(block, e);
    body = block.body;
  });
  if (!spot) return {};
  visit([&](const mesh::ElementBlock& block, Index e, std::size_t at) {
    if (block.body != body || at == spot->at) return;
    const std::span<const Index> nodes = nodes_of_element(block, e);
    if (std::find_first_of(nodes.begin(), nodes.end(), own.begin(), own.end()) != nodes.end())
      spot->around.push_back(at);
  });
  return spot;
}

}  // namespace solidus::results
