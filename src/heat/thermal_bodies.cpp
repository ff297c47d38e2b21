/// Bodies of the thermal phase: their heat at the start, and what they bring and carry away when they come
/// and leave.
#include <cassert>
#include <stdexcept>

#include "heat/iteration/heat_solver.hpp"
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

namespace {

constexpr double k_counted_from = 293.15;  ///< heat contents [K]

}  // namespace

CarriedHeat ThermalPhase::set_conditions(const ThermalConditions& conditions, ThermalState* state,
                                         const std::function<double(Index, int)>& fresh) {
  // Bodies that come need their heat; if none comes or goes only the factors of the solver are forgotten.
  const linear::ActiveSet before = system_->parts().elements.active(), now(mesh_, conditions.absent_bodies);
  for (int body = 0; body < static_cast<int>(materials_.size()); ++body)
    if (now.body(body) && !before.body(body) && !fresh)
      throw std::invalid_argument("a body that comes back needs its heat");
  if (!system_->set_conditions(conditions)) {
    solver_->forget();
    return {};
  }
  // The heat that bodies take away and bring is reported.
  CarriedHeat carried;
  if (state != nullptr) carried.away = take_out(now, *state);
  change_bodies(before);
  if (state != nullptr && fresh) carried.along = put_in(before, fresh, *state);
  solver_->reset();
  return carried;
}

/// Takes the heat of the bodies that are not there out of the nodes that hold it.
double ThermalPhase::take_out(const linear::ActiveSet& active, ThermalState& state) const {
  double carried = 0;
  for (Index i = 0; i < mesh_.n_owned_nodes; ++i) {
    const double heat = heat_at(state, i), cold = storage_->upper(i, k_counted_from);
    const double left = storage_->held_by(active, i, heat, state.temperature[as_size(i)]);
    carried += heat - left - (cold - storage_->held_by(active, i, cold, k_counted_from));
    if (!state.enthalpy.empty()) state.enthalpy[as_size(i)] = left;
  }
  if (options_.integration == HeatIntegration::closed) ghosts_.update(state.enthalpy, 1);
  return parallel::global_sum(carried);
}

/// Adds the heat of bodies that have come back to their nodes, whose temperatures follow; other nodes keep
/// theirs to the last bit.
double ThermalPhase::put_in(const linear::ActiveSet& before, const std::function<double(Index, int)>& fresh,
                            ThermalState& state) const {
  double carried = 0;
  for (Index i = 0; i < mesh_.n_owned_nodes; ++i) {
    bool any = false;
    double kept = 0;  // with the open rule the heat of bodies that were there follows from the temperature
    const double heat = storage_->sum_of_bodies(i, [&](int body) {
      if (before.body(body)) {
        kept += storage_->volume(i, body) * storage_->body_enthalpy(body, state.temperature[as_size(i)]);
        return 0.0;
      }
      any = true;
      return fresh(i, body);
    });
    if (!any) continue;
    // Carried in is the heat of the new bodies above what they would have at the temperature that
    // balances count from.
    carried += heat - storage_->sum_of_bodies(i, [&](int body) {
      return before.body(body) ? 0.0 : storage_->body_enthalpy(body, k_counted_from);
    });
    // The node's temperature is that of the heat of all its bodies together.
    const double all = heat + (state.enthalpy.empty() ? kept : state.enthalpy[as_size(i)]);
    if (!state.enthalpy.empty()) state.enthalpy[as_size(i)] = all;
    state.temperature[as_size(i)] = storage_->temperature(i, all);
  }
  ghosts_.update(state.temperature, 1);
  if (nodal()) ghosts_.update(state.enthalpy, 1);
  return parallel::global_sum(carried);
}

double ThermalPhase::heat_content(const ThermalState& state) const {
  double content = 0;
  for (Index i = 0; i < mesh_.n_owned_nodes; ++i)
    content += heat_at(state, i) - storage_->upper(i, k_counted_from);
  return parallel::global_sum(content);
}

void ThermalPhase::change_bodies(const linear::ActiveSet& before) {
  const linear::ActiveSet& now = system_->parts().elements.active();
  storage_->set_active(now);
  if (at_nodes_) at_nodes_->set_active(now);
  if (consistent_) consistent_->set_active(now);
  if (options_.integration == HeatIntegration::closed) return;
  // Blocks that stay keep their points, those that come get new ones.
  std::vector<std::unique_ptr<PointStorage>> left;
  auto points = points_.begin();
  for (const mesh::ElementBlock& block : mesh_.blocks) {
    if (at_nodes(block.body)) continue;
    std::unique_ptr<PointStorage> had = before.body(block.body) ? std::move(*points++) : nullptr;
    if (now.body(block.body)) left.push_back(had ? std::move(had) : store_at_points(block));
  }
  points_ = std::move(left);
  for (const auto& block : points_) block->bind(system_->matrix());
  temperature_system_ = std::make_unique<TemperatureSystem>(mesh_, *system_, ghosts_, points_);
}

ThermalState ThermalPhase::initial_state(std::span<const double> body_temperature) const {
  assert(body_temperature.size() == mesh_.bodies.size());
  std::vector<double> enthalpy;
  for (std::size_t b = 0; b < body_temperature.size(); ++b)
    enthalpy.push_back(storage_->body_enthalpy(static_cast<int>(b), body_temperature[b]));
  return initial_state_of([&](Index, int body) { return enthalpy[as_size(body)]; });
}

ThermalState ThermalPhase::initial_state_of(const std::function<double(Index, int)>& enthalpy) const {
  ThermalState state;
  state.temperature.resize(mesh_.x.size());
  state.enthalpy.resize(mesh_.x.size());
  for (Index i = 0; i < mesh_.n_owned_nodes; ++i) {
    state.enthalpy[as_size(i)] = storage_->sum_of_bodies(i, [&](int body) { return enthalpy(i, body); });
    // A node at which nothing has grown yet has no heat, and a temperature that nothing reads.
    const bool bare = storage_->sum_of_bodies(i, [](int) { return 1.0; }) == 0;
    state.temperature[as_size(i)] =
        bare ? k_counted_from : storage_->temperature(i, state.enthalpy[as_size(i)]);
  }
  ghosts_.update(state.temperature, 1);
  ghosts_.update(state.enthalpy, 1);
  if (!nodal()) state.enthalpy.clear();
  return state;
}

ThermalState ThermalPhase::initial_state_at_nodes(std::span<const double> temperature) const {
  ThermalState state{{temperature.begin(), temperature.end()}, {}};
  if (!nodal()) return state;
  state.enthalpy.resize(mesh_.x.size());
  for (Index i = 0; i < mesh_.n_owned_nodes; ++i)
    state.enthalpy[as_size(i)] = storage_->upper(i, temperature[as_size(i)]);
  ghosts_.update(state.enthalpy, 1);
  return state;
}

}  // namespace solidus::heat
