/// The bodies of the mechanical phase and what acts on them: elements, loads, weight, inertia, pressure.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "linear/active_set.hpp"
#include "linear/contribution.hpp"
#include "material/material.hpp"
#include "material/melt.hpp"
#include "mechanics/loads/mechanical_conditions.hpp"
#include "mechanics/mechanics_options.hpp"
#include "mechanics/solver/balance.hpp"
#include "mechanics/state/mechanical_state.hpp"
#include "mechanics/state/pass.hpp"
#include "mechanics/state/phase_fields.hpp"
#include "mesh/mesh.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"

namespace solidus::mechanics {

class BlockKernel;
class InertialForces;
class Loads;
class NodalPressure;
struct BlockWork;

/// Density of each body's material [kg/m³].
std::vector<double> densities(const std::vector<material::Material>& materials);

struct MechanicalBodies {
  /// Loads and inertia are those of the active bodies; the pressure is not there yet.
  /// Throws InputError for a condition that names no group of the mesh or contradicts another.
  MechanicalBodies(const mesh::Mesh& of, AnalysisKind analysis,
                   const std::vector<material::Material>& of_bodies, std::span<const double> at_start,
                   MechanicalConditions conditions, MechanicsOptions chosen,
                   std::vector<linear::Contribution*> terms);
  ~MechanicalBodies();
  /// Mixed elements need the force per volume of a moment itself, beside the nodal forces that it makes.
  /// Collective.
  void set_body_force(double time);

  const material::Material& material(int body) const { return materials[as_size(body)]; }
  /// The share of t_{n+1} in the mean of the forces that a step works with in the balance of momentum.
  double force_share() const { return inertia ? inertia->motion().force_share() : 1.0; }
  /// The share of t_{n+1} in the mean of the forces whose work a step does (Motion::work_share).
  double work_share() const { return inertia ? inertia->motion().work_share : 1.0; }

  // The unknowns of Newton's method are displacements [local node][component] and, where elements are mixed,
  // pressures in their unit [local node][field]; residuals are on owned nodes.
  std::size_t n_displacements() const { return mesh.x.size() * as_size(components); }
  std::size_t n_unknowns() const;
  /// Entries of the displacement in the residuals.
  std::size_t n_forces() const { return as_size(mesh.n_owned_nodes) * as_size(components); }
  std::size_t n_residuals() const;
  /// Newton's start, with the prescribed displacements at the end of the pass.
  std::vector<double> start(const MechanicalState& old, const MechanicalPass& pass) const;
  /// Writes the history at the unknowns x.
  /// @param stress    at the points at x, of the right size; null: not asked for
  /// @param at_work   of every block; null: not asked for
  /// @param elements  MechanicalState::elements; null: not asked for
  /// @param deformation  at x; null: not asked for
  BlockWork finish(const MechanicalState& old, std::span<const double> x, std::vector<BlockHistory>& history,
                   std::vector<BlockHistory>* stress = nullptr, std::vector<StressAtWork>* at_work = nullptr,
                   std::vector<SharedElementValues>* elements = nullptr,
                   StepDeformation* deformation = nullptr) const;

  const mesh::Mesh& mesh;
  AnalysisKind kind;
  const std::vector<material::Material>& materials;  ///< [body]
  int components;                                    ///< of the displacement
  MechanicsOptions options;
  std::vector<linear::Contribution*> contributions;
  linear::ActiveSet active;  ///< bodies and nodes in the present stage
  /// True when a material can flow plastically: then there are plastic fields to show.
  bool plastic = false;
  std::vector<std::unique_ptr<BlockKernel>> blocks;
  std::unique_ptr<Loads> loads;
  std::vector<double> weight;               ///< [local node][component] [N]
  std::vector<material::MeltModulus> melt;  ///< of bodies whose material does not give its viscosity, [body]
  std::unique_ptr<NodalPressure> pressure;  ///< null without mixed elements; made again with the conditions
  std::unique_ptr<InertialForces> inertia;  ///< null in quasi-statics
  parallel::GhostExchange ghosts;
  BodyBalance balance;
  std::vector<double> initial_temperature;  ///< Θ_0 of 2.51 [K], [local node]
  mutable NodalPhases nodal_phases;         ///< evaluates phases in storage of its own
};

}  // namespace solidus::mechanics
