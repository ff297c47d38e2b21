#include "coupling/simulation.hpp"

#include <algorithm>
#include <utility>

#include "algebra/parallel.hpp"
#include "base/errors.hpp"

namespace solidus::coupling {

Simulation::Simulation(std::unique_ptr<CouplingScheme> scheme, TimeOptions options)
    : scheme_(std::move(scheme)), options_(std::move(options)) {}

bool Simulation::checkpoint_due(const StepRecord& record) const {
  return record.output || (options_.checkpoint_every > 0 && record.number % options_.checkpoint_every == 0);
}

void Simulation::write_checkpoint(const Continuation& continuation, const State& state) {
  scheme_->forget();
  for (Observer* o : observers_) o->checkpoint(continuation, state);
}

Outcome Simulation::run(State initial, const std::optional<Continuation>& from) {
  std::vector<double> landings = options_.output_times;
  std::erase_if(landings, [this](double t) { return t >= options_.end; });
  landings.push_back(options_.end);
  StepControl control(options_.step, initial.time, std::move(landings));
  if (from && from->options == options_.step) control.resume(from->size, from->reason);

  State committed = std::move(initial);
  State trial = committed;
  scheme_->synchronise(committed);
  for (Observer* o : observers_) o->begin(committed);

  StepRecord record;
  record.number = from ? from->steps : 0;
  int saved = from ? from->steps : -1;  // the step whose checkpoint is written
  const auto save = [&](double size, const std::string& reason) {
    write_checkpoint({record.number, options_.step, size, reason}, committed);
    saved = record.number;
  };
  const auto stop = [&](const Stop& why) {
    for (Observer* o : observers_) o->stopped(why, committed);
  };
  while (!control.finished(committed.time)) {
    if (stop_asked_ && algebra::any_process(stop_asked_())) {
      if (saved != record.number || record.rejected > 0)
        save(control.present_size(), control.present_reason());
      Stop asked;
      asked.asked = true;
      stop(asked);
      return Outcome::interrupted;
    }
    const PlannedStep step = control.plan(committed.time);
    try {
      static_cast<StepEffort&>(record) = scheme_->advance(committed, trial, step.time, step.dt);
    } catch (const StepRejected& rejection) {
      ++record.rejected;
      record.rejection = rejection.reason();
      if (!control.rejected(step)) {
        // Whoever continues has changed something: with the step asked for, not with the one that failed.
        save(options_.step.step, "as asked");
        stop({false, rejection.reason(), rejection.where(), record.rejected, step.dt});
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
    if (checkpoint_due(record)) save(control.present_size(), control.present_reason());
  }
  for (Observer* o : observers_) o->end(committed);
  return Outcome::finished;
}

}  // namespace solidus::coupling
