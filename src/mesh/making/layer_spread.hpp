/// Displacements of the vertices of a body that follow those of its wall, to make room for layers.
#pragma once

#include <vector>

#include "mesh/making/wall_topology.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mesh {

/// Vertices of a body that are not of its wall move as the mean of their neighbours does, where near
/// neighbours count for more than distant ones. So the mesh gives way over the whole depth of the body, its
/// larger elements more than its small ones. Vertices of plane boundary faces slide within their plane, those
/// of straight edges along the edge; a vertex stays where surfaces of different groups meet within one plane,
/// and where another body has it too.
class LayerSpread {
 public:
  /// @param body  has the wall
  LayerSpread(const RawMesh& mesh, const RawGroup& body, const WallTopology& wall);

  /// @param u  [node]: displacements; those of the wall are given, those of the other vertices are a first
  ///           guess and become the answer
  void sweep(std::vector<Point>& u, int n_sweeps) const;

  /// The vertex of the wall that is nearest to a vertex of the body, counted in edges; -1: none.
  Index wall_vertex(Index node) const { return owner_[as_size(node)]; }

 private:
  /// What holds a vertex of the boundary: normals of its planes, orthogonal to each other.
  struct Guide {
    std::vector<Point> normals;
    bool fixed = false;
  };
  void find_neighbours(const RawMesh& mesh, const RawGroup& body);
  void find_guides(const RawMesh& mesh, const RawGroup& body, const WallTopology& wall);
  void find_owners(const WallTopology& wall);

  std::vector<Index> first_, neighbour_;  ///< [node], [first_[node] ...): the neighbours
  std::vector<double> weight_;            ///< [as neighbour_] 1 / length of the edge [1/m]
  std::vector<Index> moving_;             ///< vertices that follow
  std::vector<int> guide_of_;             ///< [as moving_] index into guides_; -1: inside the body
  std::vector<Guide> guides_;
  std::vector<Index> owner_;
};

}  // namespace solidus::mesh
