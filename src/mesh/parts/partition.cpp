/// A graph of nodes with their work goes to METIS; owners then give the order of nodes, process by process.
#include "mesh/parts/partition.hpp"

#include <metis.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <numeric>
#include <stdexcept>
#include <string>

#include "mesh/quadrature.hpp"
#include "numbers/index_casts.hpp"
#include "system/errors.hpp"

namespace solidus::mesh {

namespace {

// Elements around every node. A tetrahedral mesh has 23 of these numbers a node: four bytes each, with one
// count over all blocks.
class ElementsOfNodes {
 public:
  ElementsOfNodes(Index n_nodes, const std::vector<const RawBlock*>& blocks) : blocks_(blocks) {
    start_.assign(as_size(n_nodes) + 1, 0);
    first_.push_back(0);
    for (const RawBlock* b : blocks) {
      first_.push_back(first_.back() + static_cast<Number>(b->nodes.size()) / node_count(b->shape));
      for (const Index i : b->nodes) ++start_[as_size(i) + 1];
    }
    if (first_.back() > std::numeric_limits<std::uint32_t>::max())
      throw InputError({}, "the mesh has more than 4e9 elements");
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
    number_.resize(as_size(start_.back()));
    std::vector<std::int64_t> fill(start_.begin(), start_.end() - 1);
    std::uint32_t number = 0;
    for (const RawBlock* b : blocks) {
      const auto nn = as_size(node_count(b->shape));
      for (std::size_t e = 0; e < b->nodes.size(); e += nn, ++number)
        for (std::size_t a = 0; a < nn; ++a) number_[as_size(fill[as_size(b->nodes[e + a])]++)] = number;
    }
  }

  /// Calls visit(nodes of the element) for each element around a node.
  template <class Visit>
  void visit_around(Index node, Visit&& visit) const {
    std::size_t block = 0;
    for (std::int64_t k = start_[as_size(node)]; k < start_[as_size(node) + 1]; ++k) {
      const Number number = number_[as_size(k)];
      while (number >= first_[block + 1]) ++block;  // they rise
      const auto nn = as_size(node_count(blocks_[block]->shape));
      visit(std::span(blocks_[block]->nodes).subspan(as_size(number - first_[block]) * nn, nn));
    }
  }

 private:
  using Number = std::int64_t;
  const std::vector<const RawBlock*>& blocks_;
  std::vector<Number> first_;  ///< number of the first element of each block; one more at the end
  std::vector<std::int64_t> start_;
  std::vector<std::uint32_t> number_;
};

// Work of a time step [µs]: per neighbour in a row of a matrix (three or four Newton iterations, each solved
// by conjugate gradients), and per entry of an element's matrix and quadrature point.
constexpr double k_mechanics_row = 0.9, k_heat_row = 0.03;
constexpr double k_mechanics_element = 4.5e-3, k_heat_element = 1e-3;
// Contact costs a surface's node about as much as the rows of a node inside (docs/log/benchmarks.md).
constexpr double k_mechanics_contact = 25, k_heat_contact = 1;
// Largest allowed work of a part over the mean, in mechanics and in heat.
constexpr double k_mechanics_imbalance = 1.01, k_heat_imbalance = 1.05;

double sum(const std::vector<double>& a) {
  return std::accumulate(a.begin(), a.end(), 0.0);
}

}  // namespace

NodeNeighbours neighbours(Index n_nodes, const std::vector<const RawBlock*>& blocks) {
  const ElementsOfNodes around(n_nodes, blocks);
  NodeNeighbours graph;
  graph.start.reserve(as_size(n_nodes) + 1);
  graph.start.push_back(0);
  // A row for each node: the nodes of its elements, each once.
  std::vector<Index> row, seen_from(as_size(n_nodes), -1);
  const auto find_row = [&](Index i) {
    row.clear();
    seen_from[as_size(i)] = i;
    around.visit_around(i, [&](std::span<const Index> nodes) {
      for (const Index node : nodes) {
        if (seen_from[as_size(node)] == i) continue;
        seen_from[as_size(node)] = i;
        row.push_back(node);
      }
    });
  };
  for (Index i = 0; i < n_nodes; ++i) {
    find_row(i);
    std::sort(row.begin(), row.end());
    graph.node.insert(graph.node.end(), row.begin(), row.end());
    graph.start.push_back(static_cast<std::int64_t>(graph.node.size()));
  }
  return graph;
}

NodeWork node_work(const NodeNeighbours& graph, const std::vector<const RawBlock*>& blocks,
                   const std::vector<BodyWork>& of_block, std::span<const char> in_contact) {
  const std::size_t n = as_size(graph.n_nodes());
  NodeWork work{std::vector<double>(n, 0.0), std::vector<double>(n, 0.0)};
  // The work of the elements at each node, then that of its row of the matrix and of contact.
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const bool mechanics = of_block[b] == BodyWork::all;
    const int nn = node_count(blocks[b]->shape);
    const double entries = nn * static_cast<double>(stiffness_rule(blocks[b]->shape).size());
    for (const Index i : blocks[b]->nodes) {
      work.heat[as_size(i)] += entries * k_heat_element;
      if (mechanics) work.mechanics[as_size(i)] += entries * k_mechanics_element;
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    const auto entries = static_cast<double>(graph.start[i + 1] - graph.start[i] + 1);
    const double contact = in_contact[i] != 0 ? 1.0 : 0.0;
    work.heat[i] += entries * k_heat_row + contact * k_heat_contact;
    if (work.mechanics[i] > 0) work.mechanics[i] += entries * k_mechanics_row + contact * k_mechanics_contact;
  }
  return work;
}

std::vector<int> assign_owners(const NodeNeighbours& graph, const NodeWork& work, int n_processes) {
  const auto n = as_size(graph.n_nodes());
  std::vector<int> owner(n, 0);
  if (n_processes == 1) return owner;
  // Fewer nodes than processes, or more edges than METIS can count, have no partition.
  if (n < as_size(n_processes))
    throw InputError({}, "the mesh has fewer nodes than there are processes", "fewer processes");
  if (graph.node.size() > as_size(std::numeric_limits<idx_t>::max()))
    throw InputError({}, "the mesh is too large for this build of METIS", "METIS with 64-bit indices");
  // Where some bodies only conduct heat, both kinds of work are balanced separately.
  const bool only_heat = std::find(work.mechanics.begin(), work.mechanics.end(), 0.0) != work.mechanics.end();
  const std::size_t n_constraints = only_heat && sum(work.mechanics) > 0 ? 2 : 1;
  std::vector<idx_t> start(graph.start.begin(), graph.start.end()),
      node(graph.node.begin(), graph.node.end()), weight(n * n_constraints), part(n);
  // Whole numbers whose sum METIS can count.
  const auto set_weights = [&](std::size_t constraint, auto work_of, double all) {
    const double scale = std::min(100.0 * static_cast<double>(n), 1e9) / all;
    for (std::size_t i = 0; i < n; ++i)
      weight[i * n_constraints + constraint] = static_cast<idx_t>(std::lround(scale * work_of(i)));
  };
  if (n_constraints == 2) {
    set_weights(
        0, [&](std::size_t i) { return work.mechanics[i]; }, sum(work.mechanics));
    set_weights(
        1, [&](std::size_t i) { return work.heat[i]; }, sum(work.heat));
  } else {
    set_weights(
        0, [&](std::size_t i) { return work.mechanics[i] + work.heat[i]; },
        sum(work.mechanics) + sum(work.heat));
  }
  // What METIS may be off by, and its seed, so that every run has the same parts.
  real_t imbalance[2] = {static_cast<real_t>(k_mechanics_imbalance), static_cast<real_t>(k_heat_imbalance)};
  idx_t vertices = static_cast<idx_t>(n), constraints = static_cast<idx_t>(n_constraints),
        parts = n_processes, cut = 0;
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;  // the same parts in every run
  // Halves of halves cut less where the parts are few, says METIS' manual.
  const auto partition = n_processes <= 8 ? METIS_PartGraphRecursive : METIS_PartGraphKway;
  const int status =
      partition(&vertices, &constraints, start.data(), node.data(), weight.data(), nullptr, nullptr, &parts,
                nullptr, n_constraints == 2 ? imbalance : nullptr, options, &cut, part.data());
  if (status == METIS_ERROR_MEMORY) throw std::bad_alloc();
  if (status != METIS_OK)
    throw std::runtime_error("METIS could not partition the mesh (status " + std::to_string(status) + ")");
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
  // Within each process nodes are numbered by reversed Cuthill and McKee's order, which keeps neighbours
  // close in memory and factors thin.
  const std::size_t n = owner.size();
  const auto degree = [&graph](Index i) { return graph.start[as_size(i) + 1] - graph.start[as_size(i)]; };
  std::vector<std::vector<Index>> owned(as_size(n_processes));
  for (std::size_t i = 0; i < n; ++i) owned[as_size(owner[i])].push_back(as_index(i));

  std::vector<GlobalIndex> number(n, -1);
  std::vector<char> seen(n, 0);
  GlobalIndex next = 0;
  for (auto& nodes : owned) {
    // Starts are nodes with few neighbours. Of each node the neighbours not yet seen follow, those with few
    // neighbours first.
    std::stable_sort(nodes.begin(), nodes.end(), [&](Index a, Index b) { return degree(a) < degree(b); });
    std::vector<Index> order, row;
    order.reserve(nodes.size());
    for (const Index seed : nodes) {  // one round for each connected piece, from a node of low degree
      if (seen[as_size(seed)]) continue;
      seen[as_size(seed)] = 1;
      std::size_t head = order.size();
      order.push_back(seed);
      for (; head < order.size(); ++head) {
        const auto i = as_size(order[head]);
        row.clear();
        for (std::int64_t k = graph.start[i]; k < graph.start[i + 1]; ++k) {
          const Index j = graph.node[as_size(k)];
          const auto jj = as_size(j);
          if (seen[jj] || owner[jj] != owner[i]) continue;
          seen[jj] = 1;
          row.push_back(j);
        }
        std::sort(row.begin(), row.end(), [&](Index a, Index b) { return degree(a) < degree(b); });
        order.insert(order.end(), row.begin(), row.end());
      }
    }
    // Reversing the order makes factors of a profile smaller.
    for (auto i = order.rbegin(); i != order.rend(); ++i) number[as_size(*i)] = next++;
  }
  return number;
}

}  // namespace solidus::mesh
