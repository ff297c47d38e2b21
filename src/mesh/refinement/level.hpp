/// One halving of all edges of the part of a mesh that a process holds: its new nodes, their owners and their
/// places, before what is not needed here is left out.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"
#include "mesh/refinement/node_table.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mesh {

/// Elements of a part and the nodes of their children.
struct Cut {
  const ElementBlock* block = nullptr;
  std::vector<Index> nodes;  ///< [element][lattice point]; −1: not on this process

  const Index* element(Index e) const {
    return nodes.data() + static_cast<std::ptrdiff_t>(e) *
                              static_cast<std::ptrdiff_t>(lattice_of(block->shape).points.size());
  }
};

/// The element that gives a new node its place and its number: of those around it the one with the lowest
/// number in the input, so that neither depends on the number of processes.
struct Source {
  std::int32_t block = -1;  ///< of the volumes; −1: none of them is on this process
  Index element = 0;
  std::int32_t point = 0;  ///< of its lattice
};

/// A mesh on this process with what goes along when it is refined.
struct Part {
  Mesh mesh;
  /// Faces of the skin at nodes that this process owns: those that no other element of their body has, of two
  /// bodies once. Numbers are the same whatever the number of processes. Empty where the skin stays flat.
  std::vector<ElementBlock> skin;
  /// Elements of groups that are neither bodies nor surfaces: lines in space, parts of bodies. Nodes that are
  /// not on this process have the number −1.
  std::map<std::string, std::vector<ElementBlock>> others;
};

struct Level {
  /// Makes new nodes, with owners, and puts them where the shape functions of the elements say. Keeps a
  /// reference. Collective.
  explicit Level(const Part& part);

  const Part& part;
  std::vector<GlobalIndex> first;  ///< number of the first node of each process, one more at the end
  NodeTable table;
  std::vector<Cut> volumes, skin;
  std::map<std::string, std::vector<Cut>> faces, others;
  std::vector<Source> source;  ///< of each new node
  std::vector<int> owner;      ///< of each node, old ones first
  std::vector<Point> x;

  Index n_old() const { return part.mesh.n_nodes(); }
  Index n_nodes() const { return n_old() + table.size(); }
  bool is_mine(Index node) const { return owner[as_size(node)] == rank_; }
  /// The process that owns a node of the mesh that is refined.
  int owner_of(GlobalIndex number) const;
  /// The process that owns a new node.
  int owner_of(const NodeKey& key) const;

 private:
  void cut_all();
  void find_sources();
  int rank_;
};

}  // namespace solidus::mesh
