/// When a run stops, when it writes a checkpoint, and whether its steps follow their errors.
#include "coupling/simulation.hpp"
#include "parallel/parallel.hpp"

namespace solidus::coupling {

bool Simulation::measures_error(const StepOptions& step) {
  return step.adaptive && step.limits.control != ErrorControl::none;
}

bool Simulation::checkpoint_due(const StepRecord& record) const {
  return record.output || (options_.checkpoint_every > 0 && record.number % options_.checkpoint_every == 0);
}

bool Simulation::stop_asked() const {
  return followers_.stop_asked && parallel::any_process(followers_.stop_asked());
}

void Simulation::move_heat(State& state) {
  if (!followers_.moves_heat) return;
  followers_.moves_heat(state, false);
  scheme_->synchronise(state);
}

}  // namespace solidus::coupling
