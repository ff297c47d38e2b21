/// Wear of a master surface, kept at its nodes.
///
/// A point of the slave with the area w that rubs the depth dh off the master at its partner takes the volume
/// w dh from there. The nodes of the face share it by their shape functions, s_a = N_a(ξ̄); where some of them
/// are negative, by the positive ones in their ratio. The depth at a node is its volume over ∫ s_a dA: the
/// sum of depth and area is the volume that was worn off, whatever the meshes. Friction's dissipation
/// likewise.
///
/// The partner is that of the step's end: a step should not slide farther than a face of the master is long.
#pragma once

#include <span>
#include <vector>

#include "contact/points/contact_kinematics.hpp"
#include "contact/surfaces/surface.hpp"

namespace solidus::contact {

class MasterWear {
 public:
  /// Local.
  MasterWear(const mesh::Mesh& mesh, AnalysisKind kind, const ContactSurface& master);

  /// Nothing worn yet.
  std::vector<WornNode> initial_state() const;
  /// Adds the wear and the dissipation of one point in a step to the nodes of the master around it.
  /// @param depth [m], of the master; @param dissipation [J/m²]
  void add(const PointMotion& motion, double depth, double dissipation, std::vector<WornNode>& nodes) const;

  struct Depth {
    Index node = 0;                     ///< local number
    double depth = 0, dissipation = 0;  ///< [m], [J/m²]
  };
  /// At every node of the surface.
  std::vector<Depth> depths(const std::vector<WornNode>& nodes) const;

 private:
  const mesh::Mesh& mesh_;
  std::vector<Index> nodes_;  ///< local numbers, sorted
  std::vector<double> area_;  ///< ∫ s_a dA, with 2πr [m²]
};

}  // namespace solidus::contact
