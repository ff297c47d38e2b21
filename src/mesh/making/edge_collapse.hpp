/// Edges of a mesh of tetrahedra drawn together to one of their ends. Rank 0 only.
#pragma once

#include "mesh/making/edge_removal.hpp"

namespace solidus::mesh {

/// The mesh with the node `from` moved onto its neighbour `to`. Bodies keep their topology (Dey,
/// Edelsbrunner, Guha and Nekhayev 1999, "Topology preserving edge contraction": the link condition, in the
/// volume, in the surfaces between bodies, and in the curves where these meet). Surfaces stay where they are,
/// up to a twentieth of an element; where the edge is much shorter than those around, up to its length.
Change with_node_on(const Tetrahedra& mesh, Index from, Index to);

}  // namespace solidus::mesh
