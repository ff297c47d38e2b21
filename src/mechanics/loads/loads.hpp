/// Conditions turned into nodal numbers once: load vectors per unit of each function that is the same
/// everywhere, points and weights of those that vary from place to place (placed_force.hpp), and the list of
/// prescribed displacements.
#pragma once

#include <span>
#include <vector>

#include "linear/active_set.hpp"
#include "mechanics/loads/mechanical_conditions.hpp"
#include "mechanics/loads/placed_force.hpp"
#include "mesh/mesh.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mechanics {

class Loads {
 public:
  /// Throws InputError for a condition that names no group of the mesh, and for a plane face that is not
  /// normal to a coordinate, prescribed in that direction or tied to another. Collective.
  /// @param active  that of the conditions' bodies
  /// @param start     displacement that relative ones count from, [local node][component]; empty: zero
  /// @param density   of each body, for forces per mass [kg/m³]
  Loads(const mesh::Mesh& mesh, AnalysisKind kind, MechanicalConditions conditions,
        const linear::ActiveSet& active, std::span<const double> start = {},
        std::span<const double> density = {});

  /// Adds a load that does not change in time, [local node][component] [N].
  void add_constant(std::span<const double> force);
  /// The loads at a time, [owned node][component] [N]. Collective. Throws InputError, on every process, where
  /// a function of position has no value.
  void evaluate(double time, std::span<double> force) const;
  /// Whether a force per volume acts besides the weight.
  bool has_body_forces() const { return !conditions_.body_forces.empty(); }
  /// force += the forces per volume at the middle of each element of a block, [element][3] [N/m³]. Not
  /// collective. Throws InputError as the functions do.
  void add_body_forces(const mesh::ElementBlock& block, double time, std::span<double> force) const;

  /// Non-zero for degrees of freedom that are prescribed or belong to no active body, [local
  /// node][component].
  const std::vector<char>& fixed() const { return fixed_; }
  /// The same without those that are held by no support: the radial direction on an axis of revolution,
  /// absent bodies.
  const std::vector<char>& supported() const { return supported_; }
  /// Writes the prescribed values of a time into a displacement, [local node][component]. Collective, as
  /// evaluate() is.
  void prescribe(double time, std::span<double> displacement) const;
  /// The same for velocities: the slopes of the tables from that time on, of formulas by differences.
  void prescribe_rate(double time, std::span<double> velocity) const;
  /// The degrees of freedom of each plane face, ghosts included, for BlockMatrix::constrain.
  const std::vector<std::vector<Index>>& constraint_groups() const { return constraint_groups_; }
  const MechanicalConditions& conditions() const { return conditions_; }

 private:
  struct Unit {
    PlaceFunction factor;
    std::vector<std::pair<Index, double>>
        force;  ///< entry of an owned degree of freedom, force per unit of the table
  };
  struct Support {
    PlaceFunction value;
    std::vector<Index> entries;  ///< local degrees of freedom
    std::vector<double> start;   ///< of a relative one, one per entry; else empty
    std::vector<Position> x;     ///< of the entries' nodes, where the value varies from place to place
    std::vector<double> values(double time) const;
  };
  void add_support(const mesh::Mesh& mesh, const linear::ActiveSet& active,
                   const PrescribedDisplacement& condition, std::span<const double> start);
  void add_plane_face(const mesh::Mesh& mesh, const linear::ActiveSet& active, const PlaneFace& face,
                      std::vector<char>& tied);
  void add_surface(const mesh::Mesh& mesh, AnalysisKind kind, const linear::ActiveSet& active,
                   const Pressure& pressure);
  void add_surface(const mesh::Mesh& mesh, AnalysisKind kind, const linear::ActiveSet& active,
                   const Traction& traction);
  /// A load of one direction on a surface.
  void add_component(const mesh::Mesh& mesh, AnalysisKind kind, const linear::ActiveSet& active,
                     const mesh::Surface& surface, int component, const PlaceFunction& value);
  void add_volume(AnalysisKind kind, const linear::ActiveSet& active, const BodyForce& force);
  /// The factor of a force by which a body is loaded: one, or its density.
  double scale_of(const BodyForce& force, int body) const {
    return force.per_mass ? density_[as_size(body)] : 1.0;
  }

  const mesh::Mesh& mesh_;
  std::vector<double> density_;  ///< of each body [kg/m³]
  MechanicalConditions conditions_;
  int components_;
  std::vector<Unit> units_;
  std::vector<PlacedForce> placed_;
  std::vector<Support> supports_;
  std::vector<std::vector<Index>> constraint_groups_;
  std::vector<double> constant_;  ///< [owned node][component]
  std::vector<char> fixed_, supported_;
};

}  // namespace solidus::mechanics
