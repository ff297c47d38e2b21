/// Which process owns which node, and in what order.
#pragma once

#include <vector>

#include "mesh/raw_mesh.hpp"

namespace solidus::mesh {

/// Neighbours of every node: those it shares an element with, itself excluded.
struct NodeNeighbours {
  std::vector<Index> start, node;  ///< of node i: node[start[i]] … node[start[i + 1] − 1]
};
NodeNeighbours neighbours(Index n_nodes, const std::vector<const RawBlock*>& blocks);

/// The owner of every node: parts of equal size with few cut edges (METIS).
std::vector<int> assign_owners(const NodeNeighbours& graph, int n_processes);

/// New number of every node: processes one behind the other, within each the reverse Cuthill–McKee order,
/// which keeps neighbours close in memory.
std::vector<GlobalIndex> number_nodes(const NodeNeighbours& graph, const std::vector<int>& owner,
                                      int n_processes);

}  // namespace solidus::mesh
