/// Arcs in place of the straight edges of a skin of linear elements, so that new nodes lie on a surface that
/// is as smooth as the one that the mesh was made of.
#pragma once

#include <unordered_map>

#include "mesh/refinement/exchange.hpp"
#include "mesh/refinement/level.hpp"

namespace solidus::mesh {

/// From the middles of edges of the skin to where their new nodes belong [m], by new node: of all nodes on
/// edges that this process holds; none where the edge stays straight.
///
/// The plane that touches the surface at a vertex is normal to the sum of cross products of the edges of the
/// smooth faces around it, each divided by the squared lengths of both edges, which is exact on a sphere (Max
/// 1999, "Weights for computing vertex normals from facet normals", J. Graph. Tools 4(2), 1–6). Along edges
/// at which the skin bends by more than k_smooth_bend, and in the plane, the tangent is that of the circle
/// through the vertex and its two neighbours on the line. Between tangents t_a and t_b at the ends of an edge
/// of length L and direction c the arc's middle is off that of the edge by
///   L/4 ( t_a⊥/(1 + t_a·c) − t_b⊥/(1 + t_b·c) ),
/// with the parts normal to c (⊥): exact for circles. Where a line has no tangent at one end, a circle
/// follows from the other; tangents more than 45° off the edge are not believed, and the edge stays straight.
/// Collective.
std::unordered_map<Index, Point> arc_offsets(const Level& level, const Sharing& sharing);

}  // namespace solidus::mesh
