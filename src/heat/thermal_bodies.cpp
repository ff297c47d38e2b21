/// Bodies of the thermal phase: what they bring and carry away when they come and leave.
#include <stdexcept>

#include "heat/thermal_parts.hpp"
#include "heat/thermal_phase.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::heat {

CarriedHeat ThermalPhase::set_conditions(const ThermalConditions& conditions, ThermalState* state,
                                         const std::function<double(Index, int)>& fresh) {
  // Bodies that come need their heat; if none comes or goes only the factors of the solver are forgotten.
  const linear::ActiveSet before = parts_->system->parts().elements.active(),
                          now(parts_->mesh, conditions.absent_bodies);
  for (int body = 0; body < static_cast<int>(parts_->materials.size()); ++body)
    if (now.body(body) && !before.body(body) && !fresh)
      throw std::invalid_argument("a body that comes back needs its heat");
  if (!parts_->system->set_conditions(conditions)) {
    parts_->solver->forget();
    return {};
  }
  // The heat that bodies take away and bring is reported.
  CarriedHeat carried;
  if (state != nullptr) carried.away = take_out(now, *state);
  change_bodies(before);
  if (state != nullptr && fresh) carried.along = put_in(before, fresh, *state);
  parts_->solver->reset();
  return carried;
}

/// Takes the heat of the bodies that are not there out of the nodes that hold it.
double ThermalPhase::take_out(const linear::ActiveSet& active, ThermalState& state) const {
  double carried = 0;
  for (Index i = 0; i < parts_->mesh.n_owned_nodes; ++i) {
    const double heat = heat_at(*parts_->storage, state, i), cold = parts_->storage->upper(i, k_counted_from);
    const double left = parts_->storage->held_by(active, i, heat, state.temperature[as_size(i)]);
    carried += heat - left - (cold - parts_->storage->held_by(active, i, cold, k_counted_from));
    if (!state.enthalpy.empty()) state.enthalpy[as_size(i)] = left;
  }
  if (parts_->options.integration == HeatIntegration::closed) parts_->ghosts.update(state.enthalpy, 1);
  return parallel::global_sum(carried);
}

/// Adds the heat of bodies that have come back to their nodes, whose temperatures follow; other nodes keep
/// theirs to the last bit.
double ThermalPhase::put_in(const linear::ActiveSet& before, const std::function<double(Index, int)>& fresh,
                            ThermalState& state) const {
  double carried = 0;
  for (Index i = 0; i < parts_->mesh.n_owned_nodes; ++i) {
    bool any = false;
    double kept = 0;  // with the open rule the heat of bodies that were there follows from the temperature
    const double heat = parts_->storage->sum_of_bodies(i, [&](int body) {
      if (before.body(body)) {
        kept += parts_->storage->volume(i, body) *
                parts_->storage->body_enthalpy(body, state.temperature[as_size(i)]);
        return 0.0;
      }
      any = true;
      return fresh(i, body);
    });
    if (!any) continue;
    // Carried in is the heat of the new bodies above what they would have at the temperature that
    // balances count from.
    carried += heat - parts_->storage->sum_of_bodies(i, [&](int body) {
      return before.body(body) ? 0.0 : parts_->storage->body_enthalpy(body, k_counted_from);
    });
    // The node's temperature is that of the heat of all its bodies together.
    const double all = heat + (state.enthalpy.empty() ? kept : state.enthalpy[as_size(i)]);
    if (!state.enthalpy.empty()) state.enthalpy[as_size(i)] = all;
    state.temperature[as_size(i)] = parts_->storage->temperature(i, all);
  }
  parts_->ghosts.update(state.temperature, 1);
  if (parts_->nodal()) parts_->ghosts.update(state.enthalpy, 1);
  return parallel::global_sum(carried);
}

void ThermalPhase::change_bodies(const linear::ActiveSet& before) {
  const linear::ActiveSet& now = parts_->system->parts().elements.active();
  parts_->storage->set_active(now);
  if (parts_->at_nodes) parts_->at_nodes->set_active(now);
  if (parts_->consistent) parts_->consistent->set_active(now);
  if (parts_->options.integration == HeatIntegration::closed) return;
  // Blocks that stay keep their points, those that come get new ones.
  std::vector<std::unique_ptr<PointStorage>> left;
  auto points = parts_->points.begin();
  for (const mesh::ElementBlock& block : parts_->mesh.blocks) {
    if (parts_->stores_at_nodes(block.body)) continue;
    std::unique_ptr<PointStorage> had = before.body(block.body) ? std::move(*points++) : nullptr;
    if (now.body(block.body)) left.push_back(had ? std::move(had) : parts_->store_at_points(block));
  }
  parts_->points = std::move(left);
  for (const auto& block : parts_->points) block->bind(parts_->system->matrix());
  parts_->temperature_system =
      std::make_unique<TemperatureSystem>(parts_->mesh, *parts_->system, parts_->ghosts, parts_->points);
}

}  // namespace solidus::heat
