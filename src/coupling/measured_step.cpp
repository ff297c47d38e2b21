/// A step is taken once with an estimate from the past, or three times (whole and in halves) where the past
/// tells nothing.
#include "coupling/measured_step.hpp"

#include <utility>

namespace solidus::coupling {

namespace {

/// What a record keeps of the flows of a step: its stages, without the flows themselves.
StepEffort::Fields kept(heat::StageFlows flows) {
  flows.first.clear();
  flows.last.clear();
  return {std::move(flows), {}};
}

}  // namespace

MeasuredStep::Taken MeasuredStep::take(const State& old, State& trial, double time, double dt,
                                       const TooLong& too_long) {
  // Doubling measures the error by two half steps; it is also used while the rates that a predictor
  // extrapolates with are not known yet (first step, new stage).
  if (tells_) return told(old, trial, time, dt);
  if (control_ == ErrorControl::doubling || (control_ == ErrorControl::predictor && !rates_.known()))
    return doubled(old, trial, time, dt);
  // Without control of the error the step is taken as it is.
  if (control_ == ErrorControl::none) {
    Taken taken{scheme_.advance(old, trial, time, dt), {}};
    taken.effort->fields = kept(std::move(taken.effort->fields.flows));
    return taken;
  }
  // With the predictor, heat is judged as soon as it has been conducted: a step that is too long for its
  // temperatures, or for the share of skin that lets go, ends before mechanics is solved.
  std::optional<double> conducted;
  double skin = 0;
  const HeatJudge stop = [&](const State& warm, const heat::StageFlows& flows) {
    conducted = estimate_->temperature_predictor(old, warm, dt, rates_, flows);
    skin = estimate_->skin_change(old, warm);
    return too_long({.temperature = *conducted, .skin = skin});
  };
  Taken taken{scheme_.advance_unless(old, trial, time, dt, stop),
              {.temperature = conducted.value_or(0), .skin = skin}};
  if (!taken.effort) return taken;
  // The step went through, so its deformation is judged too, against what the rates before it predict.
  heat::StageFlows flows = std::exchange(taken.effort->fields, {}).flows;
  taken.error.displacement = estimate_->displacement_predictor(old, trial, dt, rates_);
  taken.error.stress = estimate_->stress_predictor(old, trial, dt, rates_);
  taken.error.opening = estimate_->skin_opening(old, trial);
  // Schemes that do not conduct first are judged for their heat now.
  if (!conducted) {
    taken.error.temperature = estimate_->temperature_predictor(old, trial, dt, rates_, flows);
    taken.error.skin = estimate_->skin_change(old, trial);
  }
  // The rates of this step predict the next one; they become those of the state when the step is committed.
  next_rates_ = estimate_->rates_of(old, trial, dt, flows);
  next_rates_.changed = rates_.changed + estimate_->change_of(old, trial, flows);
  taken.effort->fields = kept(std::move(flows));
  return taken;
}

MeasuredStep::Taken MeasuredStep::told(const State& old, State& trial, double time, double dt) {
  // The first step has no rates to predict from: its error is that against two half steps, which leave the
  // phases as they were.
  const bool first = !rates_.known();
  State halves = old;
  bool halved = false;
  if (first && tells_first_) {
    try {
      halves.time = time - dt / 2;
      State middle = halves;
      scheme_.advance(old, middle, middle.time, dt / 2);
      scheme_.advance(middle, halves, time, dt / 2);
      halved = true;
    } catch (const StepRejected&) {
      // The error of the step stays untold.
    }
    scheme_.synchronise(old);
  }
  // Then the step itself. Later steps are compared with what the rates of the one before predict.
  Taken taken{scheme_.advance(old, trial, time, dt), {}};
  heat::StageFlows flows = std::exchange(taken.effort->fields, {}).flows;
  if (!first) {
    taken.error.temperature = estimate_->temperature_predictor(old, trial, dt, rates_, flows);
    taken.error.displacement = estimate_->displacement_predictor(old, trial, dt, rates_);
    taken.error.stress = estimate_->stress_predictor(old, trial, dt, rates_);
  } else if (halved) {
    taken.error = estimate_->doubling(old, trial, halves, rates_, dt, flows);
    taken.error.temperature *= 2;  // of the whole, which commits twice what its halves do
    taken.error.displacement *= 2;
    taken.error.stress *= 2;
  }
  // The rates and changes of this step are kept until it is accepted.
  next_rates_ = estimate_->rates_of(old, trial, dt, flows);
  next_rates_.changed = rates_.changed + estimate_->change_of(old, trial, flows);
  taken.effort->fields = kept(std::move(flows));
  return taken;
}

MeasuredStep::Taken MeasuredStep::doubled(const State& old, State& trial, double time, double dt) {
  // The whole step first, whose contact must be forgotten; then both halves, which are kept.
  State whole = old;
  scheme_.advance(old, whole, time, dt);
  scheme_.synchronise(old);  // contact is where the whole step left it
  State middle = old;
  middle.time = time - dt / 2;
  Taken taken{scheme_.advance(old, middle, middle.time, dt / 2), {}};
  *taken.effort += scheme_.advance(middle, trial, time, dt / 2);
  const heat::StageFlows flows = std::exchange(taken.effort->fields, {}).flows;
  taken.error = estimate_->doubling(old, whole, trial, rates_, dt, flows);
  if (control_ == ErrorControl::predictor) next_rates_ = estimate_->rates_of(middle, trial, dt / 2, flows);
  next_rates_.changed = rates_.changed + estimate_->change_of(old, trial, flows);
  return taken;
}

}  // namespace solidus::coupling
