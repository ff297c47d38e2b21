/// Conditions turned into nodal numbers once: load vectors per unit of each table, and the list of prescribed
/// displacements.
#pragma once

#include <span>
#include <vector>

#include "linear/active_set.hpp"
#include "mechanics/loads/mechanical_conditions.hpp"
#include "mesh/mesh.hpp"

namespace solidus::mechanics {

class Loads {
 public:
  /// Throws InputError for a condition that names no group of the mesh, and for a plane face that is not
  /// normal to a coordinate, prescribed in that direction or tied to another. Collective.
  /// @param active  that of the conditions' bodies
  /// @param start     displacement that relative ones count from, [local node][component]; empty: zero
  Loads(const mesh::Mesh& mesh, AnalysisKind kind, MechanicalConditions conditions,
        const linear::ActiveSet& active, std::span<const double> start = {});

  /// Adds a load that does not change in time, [local node][component] [N].
  void add_constant(std::span<const double> force);
  /// The loads at a time, [owned node][component] [N].
  void evaluate(double time, std::span<double> force) const;

  /// Non-zero for degrees of freedom that are prescribed or belong to no active body, [local
  /// node][component].
  const std::vector<char>& fixed() const { return fixed_; }
  /// The same without those that are held by no support: the radial direction on an axis of revolution,
  /// absent bodies.
  const std::vector<char>& supported() const { return supported_; }
  /// Writes the prescribed values of a time into a displacement, [local node][component].
  void prescribe(double time, std::span<double> displacement) const;
  /// The same for velocities: the slopes of the tables from that time on.
  void prescribe_rate(double time, std::span<double> velocity) const;
  /// The degrees of freedom of each plane face, ghosts included, for BlockMatrix::constrain.
  const std::vector<std::vector<Index>>& constraint_groups() const { return constraint_groups_; }
  const MechanicalConditions& conditions() const { return conditions_; }

 private:
  struct Unit {
    TimeFunction factor;
    std::vector<std::pair<Index, double>>
        force;  ///< entry of an owned degree of freedom, force per unit of the table
  };
  struct Support {
    TimeFunction value;
    std::vector<Index> entries;  ///< local degrees of freedom
    std::vector<double> start;   ///< of a relative one, one per entry; else empty
  };
  void add_support(const mesh::Mesh& mesh, const linear::ActiveSet& active,
                   const PrescribedDisplacement& condition, std::span<const double> start);
  void add_plane_face(const mesh::Mesh& mesh, const linear::ActiveSet& active, const PlaneFace& face,
                      std::vector<char>& tied);
  void add_surface(const mesh::Mesh& mesh, AnalysisKind kind, const linear::ActiveSet& active,
                   const Pressure& pressure);
  void add_surface(const mesh::Mesh& mesh, AnalysisKind kind, const linear::ActiveSet& active,
                   const Traction& traction);

  MechanicalConditions conditions_;
  int components_;
  std::vector<Unit> units_;
  std::vector<Support> supports_;
  std::vector<std::vector<Index>> constraint_groups_;
  std::vector<double> constant_;  ///< [owned node][component]
  std::vector<char> fixed_, supported_;
};

}  // namespace solidus::mechanics
