/// Cells that Solidus has no element for, wedges and pyramids of first order and bricks whose corners fall
/// together, become tetrahedra.
///
/// A cell is cut from its corner v with the lowest number: every face that does not hold v is cut into
/// triangles, and each of them makes a tetrahedron with v. A quadrilateral is cut by the diagonal from its
/// own lowest corner, in each cell that has it, so that both sides of it match: J. Dompierre, P. Labbé,
/// M.-G. Vallet, R. Camarero, How to subdivide pyramids, prisms, and hexahedra into tetrahedra, Proc. 8th
/// International Meshing Roundtable (1999) 195-204.
#pragma once

#include <string>

#include "mesh/raw_mesh.hpp"

namespace solidus::mesh {

/// Splits all wedges and pyramids, hexahedra with repeated corners, and those hexahedra that hang together
/// with one of them by quadrilateral faces: a hexahedron has no diagonal that could match theirs.
/// Quadrilaterals of surfaces on what is split become triangles, as do those with a repeated corner. Parts of
/// a cell keep its number in the input. A note of the mesh tells how many there were. Throws InputError for a
/// cell of no volume or so warped that its parts would overlap, and for hexahedra of second order next to a
/// cell that is split.
/// @param path  of the mesh, for messages
void split_cells(RawMesh& mesh, const std::string& path);

/// The corners of face i of a wedge or a pyramid as Abaqus and CalculiX number them, i + 1 = 1 …; outward.
/// Empty where there is no such face.
std::span<const int> face_of_split_cell(Shape shape, int face);

}  // namespace solidus::mesh
