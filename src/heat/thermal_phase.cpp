/// The phase is put together here: storage by the rule of each body, conduction, loads, the solver that
/// fits. The steps are in thermal_step.cpp, reports in thermal_report.cpp.
#include "heat/thermal_phase.hpp"

#include <algorithm>
#include <cassert>

#include "heat/iteration/heat_solver.hpp"
#include "heat/iteration/heat_spread.hpp"
#include "heat/iteration/heat_system.hpp"
#include "heat/iteration/temperature_system.hpp"
#include "heat/iteration/truncated_newton.hpp"
#include "heat/storage/consistent_heat.hpp"
#include "heat/storage/nodal_enthalpy.hpp"
#include "heat/storage/point_storage.hpp"
#include "heat/storage/printed_heat.hpp"
#include "heat/thermal_iteration.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::heat {

namespace {

/// Owned nodes, [owned node], of which no volume belongs to bodies that store at points.
std::vector<char> nodes_without_points(const mesh::Mesh& mesh, const NodalEnthalpy& all,
                                       const NodalEnthalpy& at_nodes) {
  const auto one = [](const material::Material&) { return 1.0; };
  std::vector<char> without;
  for (Index i = 0; i < mesh.n_owned_nodes; ++i)
    without.push_back(at_nodes.sum(i, one) == all.sum(i, one) ? 1 : 0);
  return without;
}

}  // namespace

ThermalPhase::ThermalPhase(const mesh::Mesh& mesh, AnalysisKind kind,
                           const std::vector<material::Material>& materials,
                           const ThermalConditions& conditions, HeatOptions options,
                           std::vector<linear::Contribution*> contributions)
    : mesh_(mesh),
      kind_(kind),
      options_(options),
      materials_(materials),
      contributions_(std::move(contributions)),
      ghosts_(mesh) {
  build(conditions);
}

void ThermalPhase::build(const ThermalConditions& conditions) {
  // Where heat is stored is decided body by body: at the nodes under the closed rule, and under the open rule
  // for materials with a change at one temperature, whose heat a Gauss point could not follow.
  assert(materials_.size() == mesh_.bodies.size());
  const bool closed = options_.integration == HeatIntegration::closed;
  storage_ = std::make_unique<NodalEnthalpy>(mesh_, kind_, materials_);
  const bool nodal = closed || storage_->has_plateaus();
  // Bodies that store at nodes and those that do not are kept apart, because both may share nodes of an
  // interface.
  std::vector<char> kept, others;
  for (int body = 0; body < static_cast<int>(materials_.size()); ++body) {
    kept.push_back(at_nodes(body));
    others.push_back(!at_nodes(body));
  }
  if (nodal && std::count(others.begin(), others.end(), 1) > 0) {
    at_nodes_ = std::make_unique<NodalEnthalpy>(*storage_);
    at_nodes_->keep_bodies(kept);
    NodalEnthalpy of_others = *storage_;
    of_others.keep_bodies(others);
    consistent_ = std::make_unique<ConsistentHeat>(mesh_, points_, std::move(of_others));
  }
  // The printed forms of sensible heat (4.43a) are a contribution in addition to the enthalpy of the nodes.
  if (nodal && options_.sensible != SensibleForm::enthalpy) {
    printed_ = std::make_unique<PrintedHeat>(at_nodes_ ? *at_nodes_ : *storage_, options_.sensible);
    contributions_.push_back(printed_.get());
  }
  if (consistent_) contributions_.push_back(consistent_.get());
  // The system of equations is made with all contributions. Half of the matrix is stored where no other field
  // shares it and the solver does not need the whole.
  system_ = std::make_unique<HeatSystem>(
      mesh_, kind_, materials_, conditions, closed, contributions_,
      options_.alone ? HeatSolver::storage_for(mesh_, options_.solver, options_.symmetric)
                     : linear::BlockMatrix::Storage::whole,
      options_.edges);
  solver_ =
      std::make_unique<HeatSolver>(mesh_, options_.solver, options_.symmetric, options_.linear_tolerance);
  // Nodes that hold heat are solved for by the truncated Newton method. Its sweeps change a node only where
  // the node's own curve is all of its storage, and none of its volume belongs to bodies that store at
  // points.
  if (nodal) {
    truncated_newton_ = std::make_unique<TruncatedNewton>(
        mesh_, *system_, *storage_, *solver_, ghosts_,
        TruncatedNewtonOptions{options_.tolerance > 0 ? options_.tolerance : k_nodal_tolerance,
                               options_.max_iterations, k_nodal_tolerance},
        at_nodes_ ? nodes_without_points(mesh_, *storage_, *at_nodes_) : std::vector<char>());
  }
  // Bodies that store at Gauss points get their kernels at last, once the matrix exists into which they
  // write.
  for (const mesh::ElementBlock& block : mesh_.blocks) {
    if (at_nodes(block.body)) continue;
    points_.push_back(store_at_points(block));
    points_.back()->bind(system_->matrix());
  }
  temperature_system_ = std::make_unique<TemperatureSystem>(mesh_, *system_, ghosts_, points_);
  spread_ = std::make_unique<HeatSpread>(*system_, *storage_, ghosts_);
}

ThermalPhase::~ThermalPhase() = default;

std::unique_ptr<PointStorage> ThermalPhase::store_at_points(const mesh::ElementBlock& block) const {
  return make_point_storage(mesh_, block, kind_, materials_[as_size(block.body)], options_.sensible,
                            options_.open_degree);
}

bool ThermalPhase::at_nodes(int body) const {
  return options_.integration == HeatIntegration::closed || materials_[as_size(body)].changes_isothermally();
}

std::unique_ptr<ThermalIteration> ThermalPhase::iteration() {
  return std::make_unique<ThermalIteration>(*this);
}

const linear::ActiveSet& ThermalPhase::active() const {
  return system_->parts().elements.active();
}

bool ThermalPhase::follow_graph() {
  if (!system_->follow_graph()) return false;
  for (const auto& block : points_) block->bind(system_->matrix());
  solver_->reset();
  return true;
}

void ThermalPhase::forget() {
  solver_->forget();
}

std::size_t ThermalPhase::bytes() const {
  std::size_t total = storage_->bytes() + system_->bytes();
  for (const auto& block : points_) total += block->bytes();
  if (at_nodes_) total += at_nodes_->bytes();
  if (consistent_) total += consistent_->bytes();
  return total;
}

double ThermalPhase::seconds_solver() const {
  return solver_->seconds();
}

double ThermalPhase::lasting_loads(double from, double to) const {
  const HeatParts& parts = system_->parts();
  return std::min(parts.surfaces.lasting(from, to), parts.sources.lasting(from, to));
}

TemperatureRange ThermalPhase::ambient_range(double time, bool with_contributions) const {
  system_->set_window(LoadWindow::at(time));
  return system_->limits().ambient(with_contributions);
}

TemperatureRange ThermalPhase::range_around(double time, std::span<const double> temperature) const {
  const TemperatureRange range = ambient_range(time);
  const bool open = range.lowest == -HUGE_VAL || range.highest == HUGE_VAL;
  return open ? system_->limits().closed(range, {}, temperature) : range;
}

void ThermalPhase::begin_burning(const BurningState& state, double begin, double end) {
  system_->parts().sources.set_burning(state, begin, end);
}

BurningState ThermalPhase::burnt(const BurningState& state, const ThermalState& before,
                                 const ThermalState& after, double begin, double end) const {
  if (state.lit.empty() || system_->parts().sources.ignition().empty()) return state;
  return burn(state, system_->parts().sources.ignition(), before.temperature, after.temperature, begin, end);
}

}  // namespace solidus::heat
