/// A shell around castings, as in investment casting: coats that follow the surface of the castings. On rank
/// 0 only, like the reading of a mesh.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "mesh/raw_mesh.hpp"

namespace solidus::mesh {

/// One coat, or several coats of one material.
struct Coat {
  std::string name;      ///< name of the group of its elements, which is created
  double thickness = 0;  ///< [m]
};

/// A finished coat.
struct CoatReport {
  std::string name;
  std::size_t elements = 0;
  double volume = 0;  ///< [m³]
};

/// Makes coats from a mould block: a coat is the part of the block whose distance from the surface of the
/// other bodies (from its flat facets) is at most the total thickness of this coat and those inside it. So
/// the coats of neighbouring parts merge where they meet, fill holes narrower than twice their thickness, and
/// end at the end of the block, for instance at an open pouring cup. The middle of a wider cavity
/// inside the parts stays empty.
/// @param block  the body that is cut, of tetrahedra; its part outside the coats is removed from the mesh
/// @param bed    whether that part is kept instead: a bed of sand around the shell
/// @param coats  from the metal outward, not empty
/// Throws InputError if the mesh already has a group with a coat's name, or if there is no surface to be
/// coated.
std::vector<CoatReport> make_coats(RawMesh& mesh, const std::string& block, const std::vector<Coat>& coats,
                                   bool bed, const std::string& source);

}  // namespace solidus::mesh
