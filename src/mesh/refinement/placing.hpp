/// Puts the new nodes of linear elements next to a curved skin, without folding an element.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <unordered_map>

#include "mesh/refinement/exchange.hpp"
#include "mesh/refinement/level.hpp"

namespace solidus::mesh {

/// Nodes of the skin, over all processes.
struct Arcs {
  std::int64_t kept = 0;          ///< new nodes that lie on arcs
  std::int64_t straightened = 0;  ///< that lie on the chord, for an element would have been folded
};

/// The list of children of an element that is taken: of a tetrahedron that along the shortest diagonal of its
/// inner octahedron; the first one of equal ones.
/// @param nodes  of the element's lattice
std::size_t choice_of(const Lattice& lattice, const Index* nodes, std::span<const Point> x);

/// Moves nodes on edges by their offsets, those in faces of four vertices by half the sum of the offsets
/// around them, those within hexahedra by a quarter of it (transfinite interpolation). Where a child would
/// keep less than a quarter of its Jacobian, the edges around go back to their chords. Then every process has
/// the same places of nodes. Collective.
Arcs place_on_arcs(std::unordered_map<Index, Point> offsets, const Sharing& sharing, Level& level);

}  // namespace solidus::mesh
