/// Faults of a mesh that change an answer without a word: things that are there twice, faces inside of a
/// body, halves whose nodes were not merged, bodies in one place.
#pragma once

#include <string>
#include <vector>

#include "mesh/raw_mesh.hpp"
#include "mesh/surfaces/body_skin.hpp"

namespace solidus::mesh {

/// Leaves elements (or faces) of a group out that have the vertices of one before them. Returns how many.
std::size_t drop_repeated(RawGroup& group);

/// Faces of a group that lie between two elements of one and the same body.
struct InnerFaces {
  std::size_t n = 0, n_all = 0;  ///< of them, and of the group
  Point where{};                 ///< the middle of one [m]
};
/// @param skins  [body] faces_on_skin of each
InnerFaces inner_faces(const RawMesh& mesh, const std::vector<std::string>& bodies,
                       const std::vector<std::vector<OuterFace>>& skins, const RawGroup& surface);

/// Faces of the skin of a body that lie on each other, corner on corner, and share no nodes: the parts on
/// both sides were meshed apart.
struct Crack {
  std::size_t n_pairs = 0;
  Point where{};                ///< the middle of one face [m]
  std::vector<Index> replaced;  ///< [node] the one in its place; itself where it stays; empty without pairs
};
/// @param kept_apart  [node] faces with such a node are meant to be apart
Crack find_crack(const RawMesh& mesh, const std::vector<OuterFace>& skin,
                 const std::vector<char>& kept_apart);

/// Puts one node in the place of another in all groups.
void replace_nodes(RawMesh& mesh, const std::vector<Index>& replaced);

/// Corners of the skin of a body that lie inside of a face of it, or of an edge of one: the finer side of two
/// meshes that were put together without joining them.
struct HangingNodes {
  std::size_t n = 0;
  Point where{};
};
HangingNodes hanging_nodes(const RawMesh& mesh, const std::vector<OuterFace>& skin,
                           const std::vector<char>& kept_apart);

/// The number of pieces of a body that have no node in common.
std::size_t n_pieces(const RawMesh& mesh, const std::string& body);

}  // namespace solidus::mesh
