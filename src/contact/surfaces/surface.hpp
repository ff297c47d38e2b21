/// A contact surface: the faces of a named group, held whole by every process (mesh::Surface::replicated).
#pragma once

#include <span>
#include <string>
#include <vector>

#include "contact/surfaces/face.hpp"
#include "mesh/mesh.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::contact {

/// Faces are kept in an order that depends only on the input's node numbers, so that every process, and a run
/// on another number of processes, pairs them in the same way and to the same bits.
class ContactSurface {
 public:
  /// Throws InputError when the mesh has no surface `name` or it has no faces.
  ContactSurface(const mesh::Mesh& mesh, const std::string& name);

  const std::string& name() const { return name_; }
  Index n_faces() const { return as_index(shape_.size()); }
  mesh::Shape shape(Index face) const { return shape_[as_size(face)]; }
  /// Local node numbers of a face, in the order of its shape.
  std::span<const Index> nodes(Index face) const;
  /// All nodes of the surface, local numbers, sorted.
  const std::vector<Index>& all_nodes() const { return all_nodes_; }
  /// The face in the reference configuration.
  Face reference_face(Index face) const;
  /// The face at x + u; u [local node][component], ghosts up to date [m].
  Face current_face(Index face, std::span<const double> displacement, int components) const;
  /// Unit normals at the nodes of every face, [face][node of the face]: the mean over the faces that meet at
  /// the node and whose normals differ by less than `feature_angle` [rad];
  /// across a sharper edge each side keeps its own.
  std::vector<Point> averaged_normals(std::span<const double> displacement, int components,
                                      double feature_angle) const;
  /// Sum of the faces' lengths or areas [m], [m²] (not multiplied by 2πr).
  double measure() const;
  /// Mean size of its faces [m].
  double mean_face_size() const;
  /// Length of the diagonal of the bounding box [m].
  double extent() const;

 private:
  const mesh::Mesh& mesh_;
  std::string name_;
  std::vector<mesh::Shape> shape_;
  std::vector<std::size_t> first_node_;  ///< of each face in nodes_, one more at the end
  std::vector<Index> nodes_;
  std::vector<Index> all_nodes_;
};

}  // namespace solidus::contact
