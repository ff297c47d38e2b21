/// Elements and faces told apart by the set of their vertices, in a time that grows with their number.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/raw_mesh.hpp"

namespace solidus::mesh {

/// A set of vertices as two numbers; the order of the vertices and the orientation do not matter.
struct VertexSet {
  Index smallest = -1;       ///< the smallest vertex
  std::uint64_t others = 0;  ///< a number of 64 bits from all vertices; different sets that share their
                             ///< smallest vertex have the same number with a probability of 2⁻⁶⁴
};

VertexSet vertex_set(std::span<const Index> vertices);

/// Appends the sets of the elements of a group, in the order of its blocks.
void append_element_vertex_sets(const RawGroup& group, std::vector<VertexSet>& sets);

/// [set] the number of the first set that is equal to it; its own number where none before it is.
std::vector<Index> first_equal_set(std::span<const VertexSet> sets);

}  // namespace solidus::mesh
