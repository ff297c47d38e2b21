/// Parts of a phase that a stage has: friction makes its heat evenly, so that they go with its length.
#include "contact/heat/heat_stages.hpp"

#include <utility>

#include "numbers/index_casts.hpp"

namespace solidus::contact {

void HeatStages::begin_stage(double dt, std::optional<FirstStage> first) {
  phase_->first = std::move(first);
  phase_->stage_dt = dt;
}

InterfaceStep HeatStages::step(Index point, InterfaceStep whole) const {
  if (!phase_) return whole;
  const double part = phase_->stage_dt / phase_->span.dt;
  whole.time_step = phase_->stage_dt;
  whole.dissipation *= part;
  whole.structural_entropy *= part;
  if (phase_->first) whole.temperature = phase_->first->temperature[as_size(point)];
  return whole;
}

double HeatStages::dissipated(Index point, double whole) const {
  if (!phase_ || !phase_->first) return whole;
  return phase_->first->dissipation[as_size(point)] + whole * phase_->stage_dt / phase_->span.dt;
}

}  // namespace solidus::contact
