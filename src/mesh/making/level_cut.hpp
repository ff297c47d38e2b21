/// Cuts the tetrahedra of a body along a surface on which a function is zero. Rank 0 only, as reading a mesh
/// is.
#pragma once

#include <functional>
#include <string>

#include "mesh/raw_mesh.hpp"

namespace solidus::mesh {

/// Negative on one side of a surface, positive on the other, continuous between them.
using LevelFunction = std::function<double(const Point&)>;

/// Moves what lies below the surface, where the function is negative, from a body into another group, which
/// is made where there is none. Elements that the surface crosses are cut: a tetrahedron becomes up to four
/// on either side, as in marching tetrahedra (Doi and Koide 1991, "An efficient method of triangulating
/// equi-valued surfaces by using tetrahedral cells", IEICE Transactions E74, 214-224), and neighbours agree
/// in the diagonals, because these begin at the vertex of the least number (Dompierre, Labbé, Vallet and
/// Camarero 1999, "How to subdivide pyramids, prisms and hexahedra into tetrahedra", 8th International
/// Meshing Roundtable, 195-204). Nodes of the body alone that are nearer to the surface than three tenths of
/// an edge are drawn onto it first where their elements stay sound, so that no slivers are cut off (Labelle
/// and Shewchuk 2007, "Isosurface stuffing", ACM Transactions on Graphics 26, 57).
///
/// Nodes on the outside of the mesh stay in its plane. Second-order tetrahedra keep the middles of the edges
/// that stay; new edges are straight.
/// Throws InputError where the body has elements other than tetrahedra.
/// @param source  for messages: the file of the mesh
void cut_at_level(RawMesh& mesh, const std::string& body, const std::string& below,
                  const LevelFunction& level, const std::string& source);

}  // namespace solidus::mesh
