/// Points and groups as weights on nodes: what probes read.
#pragma once

#include <string>
#include <vector>

#include "mesh/mesh.hpp"

namespace solidus::mesh {

/// A linear functional of a nodal field: Σ weights[i] × field[nodes[i]], summed over all processes.
struct NodalWeights {
  std::vector<Index> nodes;  ///< local numbers; on each process its own share
  std::vector<double> weights;
};

struct LocatedPoint {
  NodalWeights interpolation;  ///< on the one process that holds the element; empty on the others
  double distance = 0;         ///< from the point to the mesh, zero inside [m]; the same on every process
};

/// The element that holds a point, or the nearest one. Where elements touch, the lowest body wins.
/// Collective.
/// @param body  index into Mesh::bodies to look in; −1: all
LocatedPoint locate(const Mesh& mesh, const Point& x, int body = -1);

/// The mean over a surface (by area) or a body (by volume): ∫ N_a / ∫ 1. Collective. Throws std::out_of_range
/// when the group is neither a surface nor a body.
NodalWeights mean_over(const Mesh& mesh, AnalysisKind kind, const std::string& group);

}  // namespace solidus::mesh
