/// A shell around castings, as investment foundries dip it: coats that follow the skin of what is cast. Rank
/// 0 only, as reading a mesh is.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "mesh/raw_mesh.hpp"

namespace solidus::mesh {

/// One coat, or several coats of one material.
struct Coat {
  std::string name;      ///< the group of its elements, which is made
  double thickness = 0;  ///< [m]
};

/// A coat that was made.
struct CoatReport {
  std::string name;
  std::size_t elements = 0;
  double volume = 0;  ///< [m³]
};

/// Makes coats of a block of mould: each holds what is no farther from the skin of the other bodies than it
/// and those within it are thick together, by straight lines to the flat facets of that skin. So the coats of
/// neighbouring parts run together where they meet, fill holes that are narrower than twice their thickness,
/// and end where the block ends, in a pouring cup that is open for instance. A cavity inside of the parts
/// that no coat reaches across stays empty.
/// @param block  the body that is cut, in tetrahedra; what lies beyond the coats is left out of the mesh
/// @param bed    whether it stays instead: a bed of sand around the shell
/// @param coats  from the metal outward, not empty
/// Throws InputError where the mesh has a group of a coat's name, and where there is no skin to be coated.
std::vector<CoatReport> make_coats(RawMesh& mesh, const std::string& block, const std::vector<Coat>& coats,
                                   bool bed, const std::string& source);

}  // namespace solidus::mesh
