/// Edges of a mesh of tetrahedra taken out: the ring around one is divided again. Rank 0 only.
#pragma once

#include "mesh/tetrahedra.hpp"

namespace solidus::mesh {

/// A change of a mesh that has not been made yet.
struct Change {
  double quality = 0;  ///< the least of what would be made; 0: there is no change
  std::vector<std::size_t> old;
  std::vector<Tetrahedron> made;
};

/// The best tetrahedra without the edge (a, b), by the best triangulation of the ring around it (Klincsek
/// 1980; Shewchuk 2002, "Two discrete optimization algorithms for the topological improvement of tetrahedral
/// meshes"). An edge of a surface is turned in it: the two faces at the edge become the two across, where
/// these are as good as flat, and the rings of both sides are divided again.
Change without_edge(const Tetrahedra& mesh, Index a, Index b);

}  // namespace solidus::mesh
