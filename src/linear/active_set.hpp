/// Active set of a phase: the bodies of a mesh that take part in it, with the nodes and faces that are active
/// with them.
///
/// A node is active if it belongs to an element of an active body; a face is active if it bounds such an
/// element on either side.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::linear {

class ActiveSet {
 public:
  /// @param absent  names of bodies of the mesh
  /// Throws std::invalid_argument for a name that is none. Collective.
  explicit ActiveSet(const mesh::Mesh& mesh, std::span<const std::string> absent = {});

  /// Whether all bodies are active.
  bool complete() const { return complete_; }
  bool body(int body) const { return bodies_[as_size(body)] != 0; }
  /// [local node], ghosts included.
  bool node(Index node) const { return nodes_[as_size(node)] != 0; }
  /// Returns the active faces of a surface of that mesh, in blocks like its own; without its nodes.
  mesh::Surface part(const mesh::Mesh& mesh, const mesh::Surface& surface) const;
  /// Whether the faces belong to an inactive body (where two bodies share nodes, faces belong to the first of
  /// them, mesh/surfaces/faces.hpp): the other body lies on the side to which their normals point.
  bool reversed(const mesh::ElementBlock& faces) const { return faces.body >= 0 && !body(faces.body); }

  bool operator==(const ActiveSet&) const = default;

 private:
  bool complete_ = true;
  std::vector<char> bodies_;  ///< [body of the mesh]
  std::vector<char> nodes_;   ///< [local node]
};

}  // namespace solidus::linear
