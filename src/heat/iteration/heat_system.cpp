#include "heat/iteration/heat_system.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "system/common_failure.hpp"

namespace solidus::heat {

namespace {

/// Whether the bodies store their heat at the nodes.
std::vector<char> stored_at_nodes(const std::vector<material::Material>& materials, bool closed) {
  std::vector<char> at_nodes;
  for (const material::Material& m : materials) at_nodes.push_back(closed || m.changes_isothermally());
  return at_nodes;
}

}  // namespace

HeatSystem::HeatSystem(const mesh::Mesh& mesh, AnalysisKind kind,
                       const std::vector<material::Material>& materials, const ThermalConditions& conditions,
                       bool closed, std::vector<linear::Contribution*> contributions,
                       linear::BlockMatrix::Storage storage, bool correct_edges)
    : mesh_(mesh),
      kind_(kind),
      closed_(closed),
      at_nodes_(stored_at_nodes(materials, closed)),
      parts_(mesh, kind, materials, conditions, closed, at_nodes_, std::move(contributions), correct_edges),
      limits_(parts_, closed) {
  if (!conditions.absent_bodies.empty()) throw std::invalid_argument("every body is there when a run begins");
  // The matrix has room for all that adds to it, contact included.
  matrix_ = std::make_unique<linear::BlockMatrix>(mesh, 1, graph(), storage);
  matrix_->set_fixed(parts_.prescribed.fixed());
  bind();
}

linear::NodeGraph HeatSystem::graph() const {
  linear::NodeGraph graph(mesh_);
  for (const mesh::ElementBlock& block : mesh_.blocks)
    if (parts_.elements.active().body(block.body))
      graph.add_cliques(block.nodes, mesh::node_count(block.shape));
  for (const linear::Contribution* contribution : parts_.contributions.each())
    contribution->add_to_graph(graph);
  return graph;
}

void HeatSystem::bind() {
  parts_.conduction.bind(*matrix_);
  parts_.conduction.set_others_diagonal(parts_.contributions.empty() && diagonal(parts_.surfaces));
  parts_.elements.bind(*matrix_);
  parts_.surfaces.bind(*matrix_);
  for (linear::Contribution* contribution : parts_.contributions.each()) contribution->bind(*matrix_);
}

bool HeatSystem::follow_graph() {
  if (!linear::graph_outdated(parts_.contributions.each())) return false;
  matrix_->set_graph(graph());
  bind();
  return true;
}

// While the bodies are the same the graph need not change: the nodes of a face are nodes of one element.
bool HeatSystem::set_conditions(const ThermalConditions& conditions) {
  const linear::ActiveSet active(mesh_, conditions.absent_bodies);
  const bool others = active != parts_.elements.active();
  if (others) parts_.elements.set_active(active);
  parts_.surfaces = SurfaceHeats(mesh_, kind_, active, closed_, conditions);
  parts_.enclosed.set(mesh_, kind_, active, closed_, conditions);
  parts_.channels.set(mesh_, kind_, active, closed_, conditions);
  parts_.sources = BodySources(mesh_, kind_, active, at_nodes_, conditions);
  parts_.prescribed = PrescribedNodes(mesh_, active, conditions.temperatures);
  if (others) matrix_->set_graph(graph());
  matrix_->set_fixed(parts_.prescribed.fixed());
  if (others) {
    bind();
  } else {
    parts_.surfaces.bind(*matrix_);
    parts_.conduction.set_others_diagonal(parts_.contributions.empty() && diagonal(parts_.surfaces));
  }
  return others;
}

void HeatSystem::set_window(const LoadWindow& window) {
  for (SurfaceHeat& surface : parts_.surfaces.each()) surface.set_window(window);
  parts_.channels.set_window(window);
  parts_.sources.set_window(window);
  // A function of position may fail on one process alone.
  const auto prescribe = [&] { parts_.prescribed.set_time(window.time); };
  if (placed(parts_.surfaces) || parts_.sources.placed() || parts_.prescribed.placed())
    run_collectively(prescribe);
  else
    prescribe();
}

double HeatSystem::residual(std::span<const double> temperature, std::span<double> r) {
  // The residual is the sum of flows out of the nodes: conduction, surfaces and sources, less what limits
  // hold back. Contributions add theirs.
  double moved = 0;
  std::fill(parts_.supplied.begin(), parts_.supplied.end(), 0.0);
  parts_.surfaces.clear_powers();
  parts_.channels.clear_powers();
  parts_.sources.clear_powers();
  if (parts_.exchanges) {
    const std::span<double> flow = parts_.conduction.flow(temperature);
    parts_.surfaces.add_residual(temperature, parts_.supplied, moved);
    parts_.channels.add_residual(temperature, parts_.supplied, moved);
    parts_.sources.add_residual(parts_.supplied, moved);
    for (std::size_t i = 0; i < flow.size(); ++i) flow[i] += parts_.supplied[i];
    std::copy_n(flow.begin(), r.size(), r.begin());
    if (const ConductionLimiter* const limiter = parts_.conduction.limiter())
      limiter->add_heat(temperature, r);
  } else {
    std::fill(r.begin(), r.end(), 0.0);
  }
  parts_.contributions.add_residual(temperature, parts_.exchanges, r, moved);
  return moved;
}

void HeatSystem::assemble(std::span<const double> temperature) {
  assert((parts_.elements.nodal().identity() || matrix_->storage() == linear::BlockMatrix::Storage::whole) &&
         "it is not symmetric");
  // The matrix of the temperature formulation: contributions first, then conduction with the conductivity at
  // the nodes.
  parts_.conduction.keep_apart();
  matrix_->set_zero();
  parts_.contributions.add_tangent(temperature, parts_.exchanges, *matrix_);
  if (!parts_.exchanges) return;
  parts_.elements.add_tangent(temperature);
  parts_.surfaces.add_tangent(temperature, *matrix_);
  parts_.channels.add_tangent(*matrix_);
  if (const ConductionLimiter* const limiter = parts_.conduction.limiter())
    limiter->add_tangent(temperature, *matrix_);
}

/// Replaces S = ∂r/∂Θ in the matrix by c^-1/2 S c^-1/2.
void HeatSystem::scale_by_slopes(std::span<const double> slopes) {
  const std::span<const std::int64_t> start = matrix_->row_start();
  const std::span<const Index> columns = matrix_->columns();
  double* values = matrix_->block(0);
  const auto root = [&](Index i) { return 1.0 / std::sqrt(slopes[as_size(i)]); };
  for (std::size_t row = 0; row + 1 < start.size(); ++row)
    for (std::int64_t s = start[row]; s < start[row + 1]; ++s) {
      double& value = values[s];
      if (value == 0) continue;
      const Index column = columns[as_size(s)];
      const double by_row = root(as_index(row)), by_column = root(column), of_t = value;
      value *= by_row * by_column;
      if (column != as_index(row))
        parts_.unsymmetric.note(*matrix_, mesh_.n_owned_nodes, as_index(row), column, value,
                                of_t * by_column * by_column, of_t * by_row * by_row);
    }
}

void HeatSystem::assemble_symmetric(std::span<const double> temperature, std::span<const double> slopes,
                                    const std::function<void(linear::BlockMatrix&)>& further,
                                    SharedNodes shared) {
  // The symmetric matrix of Kirchhoff's potential: conduction is kept from step to step, so that only the
  // diagonal changes where nothing else adds to it.
  const bool exchanges = parts_.exchanges;
  if (exchanges) parts_.conduction.keep();
  parts_.unsymmetric.clear();
  const auto add_surfaces = [&] {
    parts_.surfaces.add_tangent(temperature, *matrix_);
    parts_.channels.add_tangent(*matrix_);
  };
  if (exchanges && !further && parts_.conduction.assemble_diagonal(slopes, add_surfaces)) return;
  // Otherwise all parts are assembled, and scaled from temperature to potential.
  parts_.conduction.keep_apart();
  matrix_->set_zero();
  parts_.contributions.add_tangent(temperature, exchanges, *matrix_);
  if (exchanges) add_surfaces();
  if (further) further(*matrix_);
  if (!parts_.elements.nodal().identity()) scale_by_slopes(slopes);
  if (!exchanges) return;
  parts_.conduction.add(temperature, slopes, shared, parts_.unsymmetric);
  if (const ConductionLimiter* const limiter = parts_.conduction.limiter())
    limiter->add_symmetric_tangent(*matrix_);
}

}  // namespace solidus::heat
