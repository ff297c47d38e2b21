/// The mesh of the chosen bodies with its owners and new numbers, on process 0, before its parts are
/// distributed.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "mesh/parts/distribute.hpp"
#include "mesh/raw_mesh.hpp"

namespace solidus::mesh {

/// A named surface of the chosen bodies.
struct NamedFaces {
  std::string name;
  bool replicated = false;
  std::vector<RawBlock> blocks;  ///< faces, outward
  std::vector<int> body;         ///< of each block
};

/// Keeps pointers into the RawMesh it was made of.
struct GlobalMesh {
  std::vector<const RawBlock*> blocks;
  std::vector<int> body;            ///< of each block
  std::vector<int> owner;           ///< of each raw node; −1: unused
  std::vector<GlobalIndex> number;  ///< new number of each raw node
  std::vector<GlobalIndex> first;   ///< first number of each process; one more at the end
  std::vector<NamedFaces> surfaces;
  std::vector<std::pair<std::string, std::vector<Index>>> node_sets;  ///< raw nodes, sorted

  int n_processes() const { return static_cast<int>(first.size()) - 1; }
};

/// Throws InputError for bodies and surfaces that the mesh does not have.
GlobalMesh make_global_mesh(const RawMesh& raw, const std::vector<std::string>& bodies,
                            const std::vector<std::string>& replicated, const std::vector<BodyWork>& work,
                            int n_processes);

}  // namespace solidus::mesh
