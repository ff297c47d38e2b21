/// Partition of a mesh: the owner process of every node, and the order of the nodes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/parts/distribute.hpp"
#include "mesh/raw_mesh.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mesh {

/// Neighbours of every node: those it shares an element with, itself excluded.
struct NodeNeighbours {
  std::vector<std::int64_t> start;  ///< of node i: node[start[i]] … node[start[i + 1] − 1]
  std::vector<Index> node;
  Index n_nodes() const { return as_index(start.size()) - 1; }
};
NodeNeighbours neighbours(Index n_nodes, const std::vector<const RawBlock*>& blocks);

/// Work of a time step that a node brings its owner, in microseconds of one process [node]: its rows of the
/// matrices, a share of the elements around it, and of contact where it lies on such a surface. Measured on
/// blocks of hexahedra and tetrahedra (docs/log/scaling.md); only ratios matter.
struct NodeWork {
  std::vector<double> mechanics;  ///< zero at nodes of bodies that only conduct heat
  std::vector<double> heat;
};

/// @param of_block    what the elements of each block are computed for
/// @param in_contact  [node], non-zero on surfaces in contact
NodeWork node_work(const NodeNeighbours& graph, const std::vector<const RawBlock*>& blocks,
                   const std::vector<BodyWork>& of_block, std::span<const char> in_contact);

/// The owner of every node: parts of equal work with few cut edges (METIS). Where bodies only conduct heat,
/// the parts are equal in the work of each phase, for processes wait for each other after either. Throws
/// InputError for a mesh that has fewer nodes than there are processes, or more neighbours than METIS can
/// count, std::bad_alloc where METIS runs out of memory, std::runtime_error where it fails otherwise.
std::vector<int> assign_owners(const NodeNeighbours& graph, const NodeWork& work, int n_processes);

/// New number of every node: processes one behind the other, within each the reverse Cuthill–McKee order,
/// which keeps neighbours close in memory.
std::vector<GlobalIndex> number_nodes(const NodeNeighbours& graph, const std::vector<int>& owner,
                                      int n_processes);

}  // namespace solidus::mesh
