/// The parts are put together here: storage by the rule of each body, conduction, loads, the solver that
/// fits.
#include "heat/thermal_parts.hpp"

#include <algorithm>
#include <cassert>

#include "numbers/index_casts.hpp"

namespace solidus::heat {

ThermalParts::ThermalParts(const mesh::Mesh& of, AnalysisKind analysis,
                           const std::vector<material::Material>& of_bodies, const HeatOptions& chosen,
                           std::vector<linear::Contribution*> further)
    : mesh(of),
      kind(analysis),
      options(chosen),
      materials(of_bodies),
      contributions(std::move(further)),
      ghosts(of) {}

void ThermalParts::build(const ThermalConditions& conditions) {
  // Where heat is stored is decided body by body: at the nodes under the closed rule, and under the open rule
  // for materials with a change at one temperature, whose heat a Gauss point could not follow.
  assert(materials.size() == mesh.bodies.size());
  const bool closed = options.integration == HeatIntegration::closed;
  storage = std::make_unique<NodalEnthalpy>(mesh, kind, materials);
  const bool by_nodes = closed || storage->has_plateaus();
  // Bodies that store at nodes and those that do not are kept apart, because both may share nodes of an
  // interface.
  std::vector<char> kept, others;
  for (int body = 0; body < static_cast<int>(materials.size()); ++body) {
    kept.push_back(stores_at_nodes(body));
    others.push_back(!stores_at_nodes(body));
  }
  if (by_nodes && std::count(others.begin(), others.end(), 1) > 0) {
    at_nodes = std::make_unique<NodalEnthalpy>(*storage);
    at_nodes->keep_bodies(kept);
    NodalEnthalpy of_others = *storage;
    of_others.keep_bodies(others);
    consistent = std::make_unique<ConsistentHeat>(mesh, points, std::move(of_others));
  }
  // The printed forms of sensible heat (4.43a) are a contribution in addition to the enthalpy of the nodes.
  if (by_nodes && options.sensible != SensibleForm::enthalpy) {
    printed = std::make_unique<PrintedHeat>(at_nodes ? *at_nodes : *storage, options.sensible);
    contributions.push_back(printed.get());
  }
  if (consistent) contributions.push_back(consistent.get());
  // The system of equations is made with all contributions. Half of the matrix is stored where no other field
  // shares it and the solver does not need the whole.
  system = std::make_unique<HeatSystem>(mesh, kind, materials, conditions, closed, contributions,
                                        options.alone
                                            ? HeatSolver::storage_for(mesh, options.solver, options.symmetric)
                                            : linear::BlockMatrix::Storage::whole,
                                        options.edges);
  solver = std::make_unique<HeatSolver>(mesh, options.solver, options.symmetric, options.linear_tolerance);
  // Nodes that hold heat are solved for by the truncated Newton method. Its sweeps change a node only where
  // the node's own curve is all of its storage, and none of its volume belongs to bodies that store at
  // points.
  if (by_nodes) {
    std::vector<char> relaxed;
    const auto one = [](const material::Material&) { return 1.0; };
    if (at_nodes)
      for (Index i = 0; i < mesh.n_owned_nodes; ++i)
        relaxed.push_back(at_nodes->sum(i, one) == storage->sum(i, one) ? 1 : 0);
    truncated_newton = std::make_unique<TruncatedNewton>(
        mesh, *system, *storage, *solver, ghosts,
        TruncatedNewtonOptions{options.tolerance > 0 ? options.tolerance : k_nodal_tolerance,
                               options.max_iterations, k_nodal_tolerance},
        std::move(relaxed));
  }
  // Bodies that store at Gauss points get their kernels at last, once the matrix exists into which they
  // write.
  for (const mesh::ElementBlock& block : mesh.blocks) {
    if (stores_at_nodes(block.body)) continue;
    points.push_back(store_at_points(block));
    points.back()->bind(system->matrix());
  }
  temperature_system = std::make_unique<TemperatureSystem>(mesh, *system, ghosts, points);
  spread = std::make_unique<HeatSpread>(*system, *storage, ghosts);
}

std::unique_ptr<PointStorage> ThermalParts::store_at_points(const mesh::ElementBlock& block) const {
  return make_point_storage(mesh, block, kind, materials[as_size(block.body)], options.sensible,
                            options.open_degree);
}

bool ThermalParts::stores_at_nodes(int body) const {
  return options.integration == HeatIntegration::closed || materials[as_size(body)].changes_isothermally();
}

bool ThermalParts::follow_graph() {
  if (!system->follow_graph()) return false;
  for (const auto& block : points) block->bind(system->matrix());
  solver->reset();
  return true;
}

}  // namespace solidus::heat
