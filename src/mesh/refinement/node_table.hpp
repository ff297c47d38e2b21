/// New nodes of a refined mesh by the edge, face or element that they lie within, so that all elements around
/// it have the same node there.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/mesh.hpp"
#include "mesh/refinement/lattice.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mesh {

/// Where a node lies: the same key on all processes, but for the local numbers of its vertices. Vertices are
/// in the order of their numbers over all processes. Of a place within a hexahedron they are the lowest one
/// and the one across, and the code has the coordinates along the edges from the lowest one, in the order of
/// the numbers at their other ends. Of an old node there is one vertex and the code zero.
struct NodeKey {
  std::array<Index, 4> vertex{-1, -1, -1, -1};  ///< local numbers in the mesh that is refined
  std::uint32_t code = 0;                       ///< weights of the vertices
  bool operator==(const NodeKey&) const = default;
};

/// The key of a lattice point of an element. A vertex that is not on this process has the number −1; the
/// first of the key is then −1 if it is one of those that the point lies within.
/// @param nodes  of the element, local numbers
/// @param global  of each local node
NodeKey key_of(const LatticePoint& point, const Index* nodes, const InputNumbers& global);

/// Vertices of an edge, face or element by their local numbers, of which the key names at most four.
class NodeTable {
 public:
  /// @param first  number of the first new node
  explicit NodeTable(Index first) : first_(first), slots_(64, -1) {}
  /// The node at a key, a new one if there is none yet.
  Index at(const NodeKey& key);
  /// −1: there is none.
  Index find(const NodeKey& key) const;

  Index first() const { return first_; }
  Index size() const { return as_index(keys_.size()); }
  const NodeKey& key(Index node) const { return keys_[as_size(node - first_)]; }

 private:
  std::size_t slot_of(const NodeKey& key) const;
  void grow();

  Index first_;
  std::vector<NodeKey> keys_;
  std::vector<Index> slots_;  ///< places in keys_, −1: free; a power of two of them
};

}  // namespace solidus::mesh
