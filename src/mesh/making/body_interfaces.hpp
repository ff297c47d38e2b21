/// Faces of bodies that touch or face each other: found, made groups, and given nodes of their own. Rank 0
/// only, as reading a mesh is.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "mesh/making/casting_geometry.hpp"
#include "mesh/raw_mesh.hpp"

namespace solidus::mesh {

/// Two bodies, by their numbers in a list of groups; the first is the smaller one.
using BodyPair = std::pair<int, int>;

/// Number of nodes that two bodies shared before they were split.
struct SplitNodes {
  BodyPair bodies;
  std::size_t nodes = 0;
};

/// Returns the pairs of bodies that share nodes, among all bodies.
std::vector<SplitNodes> shared_by(const RawMesh& mesh, const std::vector<std::string>& bodies);

/// Gives each body of these pairs nodes of its own where they share them. Faces of surface groups go with the
/// first of the bodies that has them, points and lines stay with the first body.
void split_nodes(RawMesh& mesh, const std::vector<std::string>& bodies, const std::set<BodyPair>& pairs);

/// Two bodies between which facing faces are to be searched for.
struct FacingWish {
  BodyPair bodies;
  double distance = 0;  ///< [m]; 0: a quarter of the mean edge of the finer skin
};

/// Result of the search between two bodies. Areas are those of the first body's side and of the second's.
struct Facing {
  BodyPair bodies;
  std::string surface_a, surface_b;      ///< the groups A_to_B and B_to_A
  double distance = 0;                   ///< that was looked within [m]
  double area_a = 0, area_b = 0;         ///< of the faces of the groups [m²]
  double covered_a = 0, covered_b = 0;   ///< the part of it that has a partner [m²]
  double mean_gap = 0, largest_gap = 0;  ///< of the first side [m]
};

/// Finds the faces of the pairs that face each other: normals opposed, no farther apart than the distance.
/// Makes the surface groups A_to_B and B_to_A of each pair that has some, and A_free of what of each body
/// faces none, where there is some; faces where bodies share their nodes are no free skin.
/// @param cut     the plane at which the geometry was cut: what of a skin lies in it is A_symmetry, not
/// A_free
/// @param bodies  groups of full dimension
/// @param names   of the bodies, for the names of the groups
/// @param source  for messages: the file or shape of the mesh
std::vector<Facing> find_facing(RawMesh& mesh, const std::vector<std::string>& bodies,
                                const std::vector<std::string>& names, const std::vector<FacingWish>& wishes,
                                const std::optional<HalfSpace>& cut, const std::string& source);

}  // namespace solidus::mesh
