/// Elements that come one after the other: everything is made again from the mesh that holds them, and nodes
/// get the heat of what is new at them.
#include <stdexcept>

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

namespace {

constexpr double k_counted_from = 293.15;  ///< heat contents [K]
constexpr double k_rounding = 1e-12;       ///< of the volume of a body at a node

}  // namespace

double ThermalPhase::grow(const ThermalConditions& conditions, const std::function<double(Index, int)>& fresh,
                          ThermalState* state) {
  if (options_.integration != HeatIntegration::closed || options_.sensible != SensibleForm::enthalpy)
    throw std::invalid_argument("bodies grow where nodes hold their heat as enthalpy");
  // The old storage says how much of each body the nodes had.
  const std::unique_ptr<NodalEnthalpy> before = std::move(storage_);
  build(conditions);
  if (state == nullptr) return 0;
  double carried = 0;
  for (Index i = 0; i < mesh_.n_owned_nodes; ++i) {
    // The share of each body at the node that is new brings its own heat; what was there keeps the heat it
    // has, and the temperature of both is that of their sum.
    bool any = false;
    const auto of_new = [&](const auto& per_volume) {
      return storage_->sum_of_bodies(i, [&](int body) {
        const double now = storage_->volume(i, body), was = before->volume(i, body);
        if (now - was <= k_rounding * now) return 0.0;
        any = true;
        return (now - was) / now * per_volume(body);
      });
    };
    const double heat = of_new([&](int body) { return fresh(i, body); });
    if (!any) continue;
    carried += heat - of_new([&](int body) { return storage_->body_enthalpy(body, k_counted_from); });
    const auto node = as_size(i);
    state->enthalpy[node] += heat;
    state->temperature[node] = storage_->temperature(i, state->enthalpy[node]);
  }
  ghosts_.update(state->temperature, 1);
  ghosts_.update(state->enthalpy, 1);
  return parallel::global_sum(carried);
}

}  // namespace solidus::heat
