/// Refinement behind the partition: each process halves the edges of its own part, so that none holds the
/// refined mesh whole.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mesh/raw_mesh.hpp"

namespace solidus::mesh {

struct Refinement {
  int times = 0;       ///< how often edges are halved
  bool curved = true;  ///< new nodes on the skin of linear elements lie on arcs (refinement/curved_skin.hpp)
};

/// Elements of groups that are neither bodies nor surfaces, with the numbers of their nodes in the input.
struct OtherGroup {
  std::string name;
  Shape shape = Shape::line2;
  std::vector<GlobalIndex> nodes;
};

/// Numbers the elements of bodies of the whole mesh from one on, its nodes too where two have the same
/// number, so that those of new ones follow from them; and collects what the parts of the mesh do not know.
/// On process 0, before distribute().
std::vector<OtherGroup> prepare_refinement(RawMesh& raw, const std::vector<std::string>& bodies);

/// Throws InputError where the refined mesh would have more elements than can be counted, 2³¹ on a process,
/// or than the memory of this machine holds. Collective.
void check_refined_size(const Mesh& mesh, int times);

struct RefinementReport {
  std::int64_t on_arcs = 0;       ///< new nodes on curved parts of the skin
  std::int64_t straightened = 0;  ///< that lie on straight edges, since an element would have been folded
};

/// All edges halved: elements have 4 children in the plane, 8 in space, of the same shape and order; nodes of
/// the mesh keep their places and their numbers in the input. Groups and surfaces follow. Numbers of new
/// nodes and elements in the input, and places of nodes, do not depend on the number of processes.
/// Collective.
/// @param mesh    of distribute(), after prepare_refinement()
/// @param others  of process 0; ignored on others
Mesh refine(Mesh mesh, const Refinement& refinement, const std::vector<OtherGroup>& others,
            RefinementReport& report);

}  // namespace solidus::mesh
