/// Elements that come one after the other: everything is made again from the mesh that holds them, and nodes
/// get the heat of what is new at them.
#include <stdexcept>

#include "heat/thermal_parts.hpp"
#include "heat/thermal_phase.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::heat {

namespace {

constexpr double k_rounding = 1e-12;  ///< of the volume of a body at a node

}  // namespace

double ThermalPhase::grow(const ThermalConditions& conditions, const std::function<double(Index, int)>& fresh,
                          ThermalState* state) {
  if (parts_->options.integration != HeatIntegration::closed ||
      parts_->options.sensible != SensibleForm::enthalpy)
    throw std::invalid_argument("bodies grow where nodes hold their heat as enthalpy");
  // The old storage says how much of each body the nodes had.
  const std::unique_ptr<NodalEnthalpy> before = std::move(parts_->storage);
  parts_->build(conditions);
  if (state == nullptr) return 0;
  double carried = 0;
  for (Index i = 0; i < parts_->mesh.n_owned_nodes; ++i) {
    // The share of each body at the node that is new brings its own heat; what was there keeps the heat it
    // has, and the temperature of both is that of their sum.
    bool any = false;
    const auto of_new = [&](const auto& per_volume) {
      return parts_->storage->sum_of_bodies(i, [&](int body) {
        const double now = parts_->storage->volume(i, body), was = before->volume(i, body);
        if (now - was <= k_rounding * now) return 0.0;
        any = true;
        return (now - was) / now * per_volume(body);
      });
    };
    const double heat = of_new([&](int body) { return fresh(i, body); });
    if (!any) continue;
    carried += heat - of_new([&](int body) { return parts_->storage->body_enthalpy(body, k_counted_from); });
    const auto node = as_size(i);
    state->enthalpy[node] += heat;
    state->temperature[node] = parts_->storage->temperature(i, state->enthalpy[node]);
  }
  parts_->ghosts.update(state->temperature, 1);
  parts_->ghosts.update(state->enthalpy, 1);
  return parallel::global_sum(carried);
}

}  // namespace solidus::heat
