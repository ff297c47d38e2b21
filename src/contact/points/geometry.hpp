/// Geometry of a contact pair: its two surfaces, the points of the slave and their partners, in the
/// configuration that is asked for, and the nodes that may meet. It knows neither forces nor heat, and what
/// it returns follows from displacement and time alone.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "contact/points/contact_kinematics.hpp"
#include "contact/points/current_configuration.hpp"
#include "contact/points/graph.hpp"
#include "contact/points/growing_kinematics.hpp"
#include "contact/points/parameters.hpp"
#include "contact/surfaces/surface.hpp"
#include "contact/surfaces/surface_curvature.hpp"
#include "mesh/mesh.hpp"

namespace solidus::contact {

/// The two surfaces of a pair in the reference configuration.
struct PairSurfaces {
  ContactSurface slave;
  std::optional<ContactSurface> master;  ///< absent: a rigid surface

  /// Throws InputError for surfaces that the mesh does not have, that are the same or share a node.
  /// Collective.
  PairSurfaces(const mesh::Mesh& mesh, const ContactParameters& spec);
  /// Whether all faces have linear shape functions.
  bool linear() const;
};

/// The specification with slave and master in the roles that it has, or is to choose
/// (ContactParameters::choose_roles). Collective.
/// @param body_modulus  E [Pa] of every body of the mesh; empty: not known
ContactParameters with_roles(const mesh::Mesh& mesh, ContactParameters spec,
                             std::span<const double> body_modulus);

class ContactGeometry {
 public:
  /// Finds the partners of bodies that have not moved. Keeps a reference to the mesh. Collective. Throws
  /// InputError for surfaces of which no part faces the other one, and for options that do not go together.
  ContactGeometry(const mesh::Mesh& mesh, AnalysisKind kind, const ContactParameters& spec,
                  const PairSurfaces& surfaces);

  const mesh::Mesh& mesh() const { return mesh_; }
  int components() const { return components_; }
  Index n_points() const { return kinematics_->n_points(); }
  /// The kinematics of the points in the configuration of the last at().
  const ContactKinematics& kinematics() const { return *kinematics_; }
  /// The same at a time and a displacement [local node][component] [m], which are kept until the next call.
  /// Local.
  const ContactKinematics& at(double time, std::span<const double> displacement,
                              ContactKinematics::Points points = ContactKinematics::Points::all) const {
    configuration_->place(time, displacement, points);
    return *kinematics_;
  }
  /// Which points have the faces on both of their sides, [point].
  std::vector<char> there() const;
  /// Sets which faces of the surfaces are there, where they may come and go (ContactParameters::growing).
  /// Local.
  void set_there(const FacesThere& faces);
  /// A displacement of zero, [local node][component].
  std::vector<double> no_displacement() const;

  /// Nodes that may meet, for the matrices of both phases.
  ContactGraph& graph() const { return *graph_; }
  /// Owned nodes of both surfaces, sorted.
  const std::vector<Index>& surface_nodes() const { return surface_nodes_; }
  /// Mean size of the slave's faces [m].
  double face_size() const { return face_size_; }
  /// No offset of an initial gap to zero is larger than this [m].
  double touching() const { return touching_; }
  /// What is added to the initial penetration of a point as the mesh has it [m]: to zero where it counts as
  /// touching, else in a curved fit to the gap between the surfaces that the facets stand for
  /// (facet_heights.hpp). Where the data say what counts as touching, in large sliding, and between surfaces
  /// that are no fit, facets are taken as they are.
  double initial_offset(Index point, double penetration) const;

 private:
  void make_kinematics(AnalysisKind kind, const ContactParameters& spec, const PairSurfaces& surfaces);
  /// The kinematics become those of faces that come and go.
  void let_grow(const ContactParameters& spec);

  const mesh::Mesh& mesh_;
  int components_;
  double face_size_, touching_;
  bool facets_close_ = false;  ///< the data do not say what counts as touching
  std::unique_ptr<ContactKinematics> kinematics_;
  GrowingKinematics* growing_ = nullptr;  ///< kinematics_ where faces come and go
  std::unique_ptr<CurrentConfiguration> configuration_;
  std::unique_ptr<ContactGraph> graph_;
  std::vector<Index> surface_nodes_;
};

/// The curvature of the slave's face at every point; empty where the surface is plane.
std::vector<SurfaceCurvature> slave_curvatures(const ContactGeometry& geometry, AnalysisKind kind,
                                               const ContactSurface& slave);
/// Means of the curvatures of the master's faces around its nodes, [local node]; empty where it is plane or
/// has no nodes.
std::vector<SurfaceCurvature> master_curvatures(const mesh::Mesh& mesh, AnalysisKind kind,
                                                const PairSurfaces& surfaces);

}  // namespace solidus::contact
