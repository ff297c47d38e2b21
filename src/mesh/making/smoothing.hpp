/// Poor tetrahedra made better by moving their inner nodes. Rank 0 only.
#pragma once

#include "mesh/raw_mesh.hpp"

namespace solidus::mesh {

/// Moves nodes that lie on no skin and no surface group, each to where the worst of the linear tetrahedra
/// around it is best (Freitag, Ollivier-Gooch 1997, "Tetrahedral mesh improvement using swapping and
/// smoothing", Int. J. Numer. Meth. Eng. 40, 3979-4002: optimisation-based smoothing; here by a search along
/// the axes). No element gets worse than the worst around its node was.
/// @param below  elements of less quality are worth it
/// @return  the least quality of all linear tetrahedra afterwards; 1 where there are none
double smooth_poor_tetrahedra(RawMesh& mesh, double below = 0.3);

}  // namespace solidus::mesh
