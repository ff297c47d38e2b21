#include "mesh/partition.hpp"

#include <metis.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace solidus::mesh {

NodeNeighbours neighbours(Index n_nodes, const std::vector<const RawBlock*>& blocks) {
  // Elements of each node first, then the union of their nodes.
  const auto n = static_cast<std::size_t>(n_nodes);
  std::vector<Index> start(n + 1, 0);
  for (const RawBlock* b : blocks)
    for (const Index i : b->nodes) ++start[static_cast<std::size_t>(i) + 1];
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<std::pair<const Index*, int>> elements(static_cast<std::size_t>(start.back()));
  std::vector<Index> fill(start.begin(), start.end() - 1);
  for (const RawBlock* b : blocks) {
    const int nn = node_count(b->shape);
    for (std::size_t e = 0; e < b->nodes.size(); e += static_cast<std::size_t>(nn))
      for (int a = 0; a < nn; ++a) {
        const Index node = b->nodes[e + static_cast<std::size_t>(a)];
        elements[static_cast<std::size_t>(fill[static_cast<std::size_t>(node)]++)] = {b->nodes.data() + e,
                                                                                      nn};
      }
  }
  NodeNeighbours graph;
  graph.start.assign(n + 1, 0);
  std::vector<Index> row;
  for (std::size_t i = 0; i < n; ++i) {
    row.clear();
    for (Index k = start[i]; k < start[i + 1]; ++k) {
      const auto [nodes, nn] = elements[static_cast<std::size_t>(k)];
      row.insert(row.end(), nodes, nodes + nn);
    }
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
    std::erase(row, static_cast<Index>(i));
    graph.node.insert(graph.node.end(), row.begin(), row.end());
    graph.start[i + 1] = static_cast<Index>(graph.node.size());
  }
  return graph;
}

std::vector<int> assign_owners(const NodeNeighbours& graph, int n_processes) {
  const std::size_t n = graph.start.size() - 1;
  std::vector<int> owner(n, 0);
  if (n_processes == 1) return owner;
  if (n < static_cast<std::size_t>(n_processes))
    throw std::invalid_argument("the mesh has fewer nodes than there are processes");
  std::vector<idx_t> start(graph.start.begin(), graph.start.end()),
      node(graph.node.begin(), graph.node.end()), part(n);
  idx_t vertices = static_cast<idx_t>(n), constraints = 1, parts = n_processes, cut = 0;
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;  // the same parts in every run
  const int status = METIS_PartGraphKway(&vertices, &constraints, start.data(), node.data(), nullptr, nullptr,
                                         nullptr, &parts, nullptr, nullptr, options, &cut, part.data());
  if (status != METIS_OK) throw std::runtime_error("METIS could not partition the mesh");
  std::copy(part.begin(), part.end(), owner.begin());
  // METIS may leave a part of a tiny mesh empty; every process must own a node.
  for (int p = 0; p < n_processes; ++p)
    if (std::find(owner.begin(), owner.end(), p) == owner.end())
      for (std::size_t i = 0; i < n; ++i)
        if (std::count(owner.begin(), owner.end(), owner[i]) > 1) {
          owner[i] = p;
          break;
        }
  return owner;
}

std::vector<GlobalIndex> number_nodes(const NodeNeighbours& graph, const std::vector<int>& owner,
                                      int n_processes) {
  const std::size_t n = owner.size();
  const auto degree = [&graph](Index i) {
    return graph.start[static_cast<std::size_t>(i) + 1] - graph.start[static_cast<std::size_t>(i)];
  };
  std::vector<std::vector<Index>> owned(static_cast<std::size_t>(n_processes));
  for (std::size_t i = 0; i < n; ++i)
    owned[static_cast<std::size_t>(owner[i])].push_back(static_cast<Index>(i));

  std::vector<GlobalIndex> number(n, -1);
  std::vector<char> seen(n, 0);
  GlobalIndex next = 0;
  for (auto& nodes : owned) {
    std::stable_sort(nodes.begin(), nodes.end(), [&](Index a, Index b) { return degree(a) < degree(b); });
    std::vector<Index> order, row;
    order.reserve(nodes.size());
    for (const Index seed : nodes) {  // one round for each connected piece, from a node of low degree
      if (seen[static_cast<std::size_t>(seed)]) continue;
      seen[static_cast<std::size_t>(seed)] = 1;
      std::size_t head = order.size();
      order.push_back(seed);
      for (; head < order.size(); ++head) {
        const auto i = static_cast<std::size_t>(order[head]);
        row.clear();
        for (Index k = graph.start[i]; k < graph.start[i + 1]; ++k) {
          const Index j = graph.node[static_cast<std::size_t>(k)];
          const auto jj = static_cast<std::size_t>(j);
          if (seen[jj] || owner[jj] != owner[i]) continue;
          seen[jj] = 1;
          row.push_back(j);
        }
        std::sort(row.begin(), row.end(), [&](Index a, Index b) { return degree(a) < degree(b); });
        order.insert(order.end(), row.begin(), row.end());
      }
    }
    for (auto i = order.rbegin(); i != order.rend(); ++i) number[static_cast<std::size_t>(*i)] = next++;
  }
  return number;
}

}  // namespace solidus::mesh
