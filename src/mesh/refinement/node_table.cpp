/// Open addressing: the next free slot behind that of the hash.
#include "mesh/refinement/node_table.hpp"

#include <algorithm>
#include <utility>

#include "numbers/index_casts.hpp"

namespace solidus::mesh {

namespace {

std::uint64_t hash_of(const NodeKey& key) {
  std::uint64_t h = key.code;
  for (const Index v : key.vertex) {
    h = (h ^ static_cast<std::uint32_t>(v)) * 0x9E3779B97F4A7C15ULL;
    h ^= h >> 29;
  }
  return h ^ h >> 32;
}

/// Of a place within a hexahedron.
NodeKey inner_key(const LatticePoint& point, const Index* nodes, const InputNumbers& global) {
  // From the vertex of the lowest number on, coordinates go along its three edges, in the order of the
  // numbers at their other ends: so the code does not depend on how the element lists its nodes.
  const auto number = [&](int v) { return global[as_size(nodes[v])]; };
  int lowest = 0;
  for (int v = 1; v < 8; ++v)
    if (number(v) < number(lowest)) lowest = v;
  const int bits = corner_bits(lowest);
  std::array<std::pair<GlobalIndex, int>, 3> axes{};
  for (int i = 0; i < 3; ++i) {
    const int q = point.quarters[as_size(i)];
    axes[as_size(i)] = {number(vertex_at(bits ^ 1 << i)), (bits >> i & 1) != 0 ? 4 - q : q};
  }
  std::sort(axes.begin(), axes.end());
  constexpr std::uint32_t k_within = 0xC0000000U;  // no weights have these bits
  NodeKey key;
  key.vertex = {nodes[lowest], nodes[vertex_at(bits ^ 7)], -1, -1};
  key.code = k_within;
  for (std::size_t i = 0; i < 3; ++i) key.code |= static_cast<std::uint32_t>(axes[i].second) << (4 * i);
  return key;
}

}  // namespace

NodeKey key_of(const LatticePoint& point, const Index* nodes, const InputNumbers& global) {
  NodeKey key;
  const std::size_t n = point.vertices.size();
  for (const int v : point.vertices)
    if (nodes[v] < 0) return key;
  if (n == 8) return inner_key(point, nodes, global);
  // Pairs of vertex and weight in the order of the vertices' numbers over all processes.
  std::array<std::pair<GlobalIndex, std::size_t>, 4> order{};
  for (std::size_t i = 0; i < n; ++i) order[i] = {global[as_size(nodes[point.vertices[i]])], i};
  std::sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(n));
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t k = order[i].second;
    key.vertex[i] = nodes[point.vertices[k]];
    key.code |= static_cast<std::uint32_t>(point.weights[k]) << (8 * i);
  }
  return key;
}

std::size_t NodeTable::slot_of(const NodeKey& key) const {
  std::size_t slot = hash_of(key) & (slots_.size() - 1);
  while (slots_[slot] >= 0 && !(keys_[as_size(slots_[slot])] == key)) slot = (slot + 1) & (slots_.size() - 1);
  return slot;
}

void NodeTable::grow() {
  slots_.assign(2 * slots_.size(), -1);
  for (std::size_t i = 0; i < keys_.size(); ++i) slots_[slot_of(keys_[i])] = as_index(i);
}

Index NodeTable::at(const NodeKey& key) {
  std::size_t slot = slot_of(key);
  if (slots_[slot] < 0) {
    // At most two thirds of the slots are taken, so that searches stay short.
    if (3 * (keys_.size() + 1) > 2 * slots_.size()) {
      grow();
      slot = slot_of(key);
    }
    slots_[slot] = as_index(keys_.size());
    keys_.push_back(key);
  }
  return first_ + slots_[slot];
}

Index NodeTable::find(const NodeKey& key) const {
  const Index place = slots_[slot_of(key)];
  return place < 0 ? -1 : first_ + place;
}

}  // namespace solidus::mesh
