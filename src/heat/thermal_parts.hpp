/// Parts of a thermal phase: the storage of heat in its bodies, the system of conduction and loads, and its
/// solver. Its steps (thermal_phase.hpp), its states (thermal_states.hpp) and a step that is
/// solved together with displacements (thermal_iteration.hpp) work with these.
#pragma once

#include <memory>
#include <vector>

#include "heat/iteration/heat_solver.hpp"
#include "heat/iteration/heat_spread.hpp"
#include "heat/iteration/heat_system.hpp"
#include "heat/iteration/temperature_system.hpp"
#include "heat/iteration/truncated_newton.hpp"
#include "heat/storage/consistent_heat.hpp"
#include "heat/storage/nodal_enthalpy.hpp"
#include "heat/storage/point_storage.hpp"
#include "heat/storage/printed_heat.hpp"
#include "heat/thermal_phase.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::heat {

struct ThermalParts {
  ThermalParts(const mesh::Mesh& mesh, AnalysisKind kind, const std::vector<material::Material>& materials,
               const HeatOptions& options, std::vector<linear::Contribution*> contributions);
  /// Makes everything from the mesh and these conditions.
  void build(const ThermalConditions& conditions);
  /// Whether the enthalpy of the nodes is the unknown: with the closed rule, and with the open one where a
  /// material has an isothermal change.
  bool nodal() const { return truncated_newton != nullptr; }
  /// Whether a body stores its heat at the nodes.
  bool stores_at_nodes(int body) const;
  std::unique_ptr<PointStorage> store_at_points(const mesh::ElementBlock& block) const;
  /// Metal of a node over what was poured.
  double held_at(Index node) const { return held.empty() ? 1.0 : held[as_size(node)]; }
  /// Makes the matrix again where a contribution asks for it; then true. Collective.
  bool follow_graph();

  const mesh::Mesh& mesh;
  AnalysisKind kind;
  HeatOptions options;
  std::vector<material::Material> materials;
  std::vector<linear::Contribution*> contributions;
  parallel::GhostExchange ghosts;
  std::unique_ptr<NodalEnthalpy> storage;
  std::vector<double> held;  ///< of move_metal(), but for what gas stores, [owned node]; empty: one
  std::unique_ptr<NodalEnthalpy> at_nodes;  ///< of bodies that store there, where it is not all of them
  // The last contributions, in this order.
  std::unique_ptr<PrintedHeat> printed;        ///< of bodies that store at the nodes, with a printed form
  std::unique_ptr<ConsistentHeat> consistent;  ///< of the other bodies, where some store at the nodes
  std::unique_ptr<HeatSystem> system;
  std::vector<std::unique_ptr<PointStorage>> points;  ///< of bodies that store there: open rule only
  std::unique_ptr<HeatSolver> solver;
  std::unique_ptr<TruncatedNewton> truncated_newton;
  std::unique_ptr<TemperatureSystem> temperature_system;
  std::unique_ptr<HeatSpread> spread;
  bool keeps_stages = false;  ///< reports hold the state between the two stages of a step (StageFlows)
};

}  // namespace solidus::heat
