#include "coupling/measured_step.hpp"

#include <utility>

namespace solidus::coupling {

MeasuredStep::Taken MeasuredStep::take(const State& old, State& trial, double time, double dt) {
  if (control_ == ErrorControl::doubling || (control_ == ErrorControl::predictor && !rates_.known()))
    return doubled(old, trial, time, dt);
  Taken taken{scheme_.advance(old, trial, time, dt), {}};
  const heat::StageFlows flows = std::exchange(taken.effort.fields, {}).flows;
  if (control_ == ErrorControl::none) return taken;
  taken.error = estimate_->predictor(old, trial, dt, rates_, flows);
  next_rates_ = estimate_->rates_of(old, trial, dt, flows);
  next_rates_.changed = rates_.changed + estimate_->change_of(old, trial, flows);
  return taken;
}

MeasuredStep::Taken MeasuredStep::doubled(const State& old, State& trial, double time, double dt) {
  State whole = old;
  scheme_.advance(old, whole, time, dt);
  scheme_.synchronise(old);  // contact stands where the whole step left it
  State middle = old;
  middle.time = time - dt / 2;
  Taken taken{scheme_.advance(old, middle, middle.time, dt / 2), {}};
  taken.effort += scheme_.advance(middle, trial, time, dt / 2);
  const heat::StageFlows flows = std::exchange(taken.effort.fields, {}).flows;
  taken.error = estimate_->doubling(old, whole, trial, rates_, flows);
  if (control_ == ErrorControl::predictor) next_rates_ = estimate_->rates_of(middle, trial, dt / 2, flows);
  next_rates_.changed = rates_.changed + estimate_->change_of(old, trial, flows);
  return taken;
}

}  // namespace solidus::coupling
