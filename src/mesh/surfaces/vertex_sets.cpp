/// Sets are sorted by their smallest vertex, which few of them share, and compared by the others.
#include "mesh/surfaces/vertex_sets.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "numbers/index_casts.hpp"

namespace solidus::mesh {

namespace {

/// Mixes the bits of a number so that each depends on all (splitmix64).
std::uint64_t mixed(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15ULL;
  x = (x ^ (x >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  x = (x ^ (x >> 27U)) * 0x94D049BB133111EBULL;
  return x ^ (x >> 31U);
}

}  // namespace

VertexSet vertex_set(std::span<const Index> vertices) {
  // A sum and a number for each vertex that depends on all of its bits: no vertex has to be sorted.
  std::uint64_t sum = 0;
  for (const Index v : vertices) sum += mixed(static_cast<std::uint64_t>(v));
  return {*std::ranges::min_element(vertices), sum};
}

void append_element_vertex_sets(const RawGroup& group, std::vector<VertexSet>& sets) {
  for (const RawBlock& block : group.blocks) {
    const auto n = as_size(node_count(block.shape)), n_vertices = as_size(vertex_count(block.shape));
    for (std::size_t first = 0; first + n <= block.nodes.size(); first += n)
      sets.push_back(vertex_set(std::span(block.nodes).subspan(first, n_vertices)));
  }
}

std::vector<Index> first_equal_set(std::span<const VertexSet> sets) {
  std::size_t n_nodes = 0;
  for (const VertexSet& set : sets) n_nodes = std::max(n_nodes, as_size(set.smallest) + 1);
  // The sets are counted and placed by their smallest vertex. Few share one, and meshes number vertices that
  // are near each other one after the other, so that this stays in the cache where a hash of all would not.
  std::vector<Index> begin(n_nodes + 1, 0);
  for (const VertexSet& set : sets) ++begin[as_size(set.smallest) + 1];
  for (std::size_t v = 0; v < n_nodes; ++v) begin[v + 1] += begin[v];
  using Entry = std::pair<std::uint64_t, Index>;  // the other vertices, and the number of the set
  std::vector<Entry> placed(sets.size());
  std::vector<Index> next(begin.begin(), begin.end() - 1);
  for (std::size_t i = 0; i < sets.size(); ++i)
    placed[as_size(next[as_size(sets[i].smallest)]++)] = {sets[i].others, as_index(i)};

  // Among those with one smallest vertex equal sets come together, the first of them first.
  std::vector<Index> first(sets.size());
  for (std::size_t v = 0; v < n_nodes; ++v) {
    const auto from = placed.begin() + begin[v], to = placed.begin() + begin[v + 1];
    std::sort(from, to);
    for (auto each = from; each != to; ++each) {
      const bool repeated = each != from && std::prev(each)->first == each->first;
      first[as_size(each->second)] = repeated ? first[as_size(std::prev(each)->second)] : each->second;
    }
  }
  return first;
}

}  // namespace solidus::mesh
