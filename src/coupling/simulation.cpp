#include "coupling/simulation.hpp"

#include <algorithm>
#include <utility>

#include "base/errors.hpp"

namespace solidus::coupling {

Simulation::Simulation(std::unique_ptr<CouplingScheme> scheme, TimeOptions options)
    : scheme_(std::move(scheme)), options_(std::move(options)) {}

Outcome Simulation::run(State initial) {
  std::vector<double> landings = options_.output_times;
  std::erase_if(landings, [this](double t) { return t >= options_.end; });
  landings.push_back(options_.end);
  StepControl control(options_.step, initial.time, std::move(landings));

  State committed = std::move(initial);
  State trial = committed;
  scheme_->synchronise(committed);
  for (Observer* o : observers_) o->begin(committed);

  StepRecord record;
  while (!control.finished(committed.time)) {
    const PlannedStep step = control.plan(committed.time);
    try {
      static_cast<StepEffort&>(record) = scheme_->advance(committed, trial, step.time, step.dt);
    } catch (const StepRejected& rejection) {
      ++record.rejected;
      record.rejection = rejection.reason();
      if (!control.rejected(step)) {
        for (Observer* o : observers_) o->stopped(rejection.what(), committed);
        return Outcome::stuck;
      }
      scheme_->synchronise(committed);
      continue;
    }
    trial.time = step.time;
    std::swap(committed, trial);
    control.accepted(std::max(record.heat.iterations, record.mechanics.iterations));

    ++record.number;
    record.time = step.time;
    record.dt = step.dt;
    record.reason = step.reason;
    record.output = control.is_landing(step.time);
    for (Observer* o : observers_) o->step(record, committed);
    record.rejected = 0;
    record.rejection.clear();
  }
  for (Observer* o : observers_) o->end(committed);
  return Outcome::finished;
}

}  // namespace solidus::coupling
