/// Averaged normals at the nodes of a surface, and the field that their interpolation makes.
///
///   m_a = S_a/|S_a|,  S_a = Σ_i n_i over the faces i that meet at node a,      ν(ξ) = ν̂/|ν̂|,  ν̂ = Σ N_a(ξ)
///   m_a
///
/// n_i is the unit normal of face i at the node. Faces that meet at more than the feature angle in the
/// reference configuration are not averaged: across such an edge each side keeps its own normal.
#pragma once

#include <vector>

#include "contact/surfaces/master.hpp"
#include "contact/surfaces/surface.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::contact {

class AveragedNormals {
 public:
  AveragedNormals(const ContactSurface& surface, double feature_angle);
  /// Computes the normals of a configuration.
  void place(std::span<const Face> faces);
  /// Nodes that the normals of a face depend on: its own first.
  std::span<const Index> nodes(Index face) const;
  struct Director {
    Point nu{};
    std::array<Point, 2> nu_xi{};
  };
  Director at(Index face, mesh::Shape shape, const Point& xi) const;
  /// ∂ν/∂x of nodes(face) at fixed ξ. @param faces the configuration of the last place()
  void rates(Index face, std::span<const Face> faces, const Point& xi, std::span<Tensor> nu_rate) const;

 private:
  struct Member {
    Index face = 0;
    int node = 0;                ///< local
    std::size_t first_slot = 0;  ///< in slot_: where the member's nodes are in nodes(face)
  };
  std::size_t first(Index face) const { return first_node_[as_size(face)]; }
  Point mean_of(Index face, mesh::Shape shape, const Point& xi) const;  ///< ν̂

  std::vector<std::size_t> first_node_;    ///< [face], of [face][node] arrays
  std::vector<std::size_t> first_member_;  ///< [face][node]
  std::vector<Member> members_;
  std::vector<int> slot_;
  std::vector<std::size_t> first_patch_;  ///< [face]
  std::vector<Index> patch_;
  std::vector<Point> mean_;     ///< m_a [face][node]
  std::vector<double> length_;  ///< |S_a| [face][node]
  std::vector<Point> own_;      ///< n_i [face][node]
};

}  // namespace solidus::contact
