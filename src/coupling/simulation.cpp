#include "coupling/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "algebra/parallel.hpp"
#include "base/errors.hpp"
#include "base/log.hpp"

namespace solidus::coupling {

struct Simulation::Progress {
  StepControl control;
  MeasuredStep step;
  State committed, trial;
  StepRecord record;  ///< of the step last committed; its rejections are those since
  double solid_fraction = 1;
  int saved = -1;       ///< the step whose checkpoint is written
  bool warned = false;  ///< of a limit that the smallest step exceeds
  Stop stop;
};

Simulation::Simulation(std::unique_ptr<CouplingScheme> scheme, TimeOptions options,
                       std::optional<ErrorEstimate> estimate)
    : scheme_(std::move(scheme)), options_(std::move(options)), estimate_(std::move(estimate)) {
  if (measures_error() && !estimate_)
    throw std::invalid_argument("adaptive steps need an estimate of their error");
}

bool Simulation::measures_error() const {
  return options_.step.adaptive && options_.step.limits.control != ErrorControl::none;
}

bool Simulation::checkpoint_due(const StepRecord& record) const {
  return record.output || (options_.checkpoint_every > 0 && record.number % options_.checkpoint_every == 0);
}

bool Simulation::stop_asked() const {
  return stop_asked_ && algebra::any_process(stop_asked_());
}

void Simulation::save(Progress& p, const ControlState& control) {
  scheme_->forget();
  const Continuation continuation{p.record.number, options_.step, control, p.step.rates()};
  for (Observer* o : observers_) o->checkpoint(continuation, p.committed);
  p.saved = p.record.number;
}

MeasuredStep Simulation::measured_step(const std::optional<Continuation>& from) {
  if (!measures_error()) return MeasuredStep(*scheme_);
  return {*scheme_, options_.step.limits.control, *estimate_, from ? from->rates : Rates{}};
}

Outcome Simulation::run(State initial, double solid_fraction, const std::optional<Continuation>& from) {
  std::vector<double> landings = options_.output_times;
  std::erase_if(landings, [this](double t) { return t >= options_.end; });
  landings.push_back(options_.end);
  State trial = initial;
  const double start = initial.time;
  Progress p{.control = StepControl(options_.step, start, std::move(landings)),
             .step = measured_step(from),
             .committed = std::move(initial),
             .trial = std::move(trial),
             .record = {},
             .solid_fraction = solid_fraction,
             .saved = from ? from->steps : -1,
             .warned = false,
             .stop = {}};
  p.record.number = from ? from->steps : 0;
  if (from && from->options == options_.step) p.control.resume(from->control);
  scheme_->synchronise(p.committed);
  for (Observer* o : observers_) o->begin(p.committed);

  const auto stopped = [&](const Stop& why, Outcome outcome) {
    for (Observer* o : observers_) o->stopped(why, p.committed);
    return outcome;
  };
  while (!p.control.finished(p.committed.time)) {
    if (stop_asked()) {
      if (p.saved != p.record.number || p.record.rejected > 0) save(p, p.control.state());
      Stop asked;
      asked.asked = true;
      return stopped(asked, Outcome::interrupted);
    }
    switch (try_step(p)) {
      case Try::committed:
        if (checkpoint_due(p.record)) save(p, p.control.state());
        break;
      case Try::repeat:
        scheme_->synchronise(p.committed);
        break;
      case Try::stuck:
        // Whoever continues has changed something: with the step asked for, not with the one that failed.
        save(p, {.size = options_.step.step});
        return stopped(p.stop, Outcome::stuck);
    }
  }
  for (Observer* o : observers_) o->end(p.committed);
  return Outcome::finished;
}

// The committed state is not touched before the step is known to be good: a step that is repeated starts from
// the same bits.
Simulation::Try Simulation::try_step(Progress& p) {
  const PlannedStep step = p.control.plan(p.committed.time);
  StepMeasure measure;
  try {
    const MeasuredStep::Taken taken = p.step.take(p.committed, p.trial, step.time, step.dt);
    measure = {std::max(taken.effort.heat.iterations, taken.effort.mechanics.iterations),
               taken.error.temperature, taken.error.displacement,
               std::abs(taken.effort.solid_fraction - p.solid_fraction)};
    if (p.control.too_long(step, measure)) {
      ++p.record.rejected;
      p.record.rejection = strictest(options_.step.limits, measure).excess;
      p.control.shortened(step, measure);
      return Try::repeat;
    }
    static_cast<StepEffort&>(p.record) = taken.effort;
  } catch (const StepRejected& rejection) {
    ++p.record.rejected;
    p.record.rejection = rejection.reason();
    if (p.control.rejected(step, rejection.reason())) return Try::repeat;
    p.stop = {false, rejection.reason(), rejection.where(), p.record.rejected, step.dt};
    return Try::stuck;
  }
  commit(p, step, measure);
  return Try::committed;
}

// A step that is committed beyond a limit holds a jump, or is the smallest: its rates predict nothing.
void Simulation::look_at_excess(Progress& p, const PlannedStep& step, const StepMeasure& measure) {
  if (!options_.step.adaptive) return;
  const Strictest limit = strictest(options_.step.limits, measure);
  if (!limit.exceeded) return;
  p.step.forget();
  if (p.warned) return;
  logging::warn("t = {:g} s: {}, which steps down to {:g} s do not bring down; the run goes on", step.time,
                limit.excess, step.dt);
  p.warned = true;
}

void Simulation::commit(Progress& p, const PlannedStep& step, const StepMeasure& measure) {
  p.trial.time = step.time;
  std::swap(p.committed, p.trial);
  p.step.commit();
  look_at_excess(p, step, measure);
  p.control.accepted(step, measure);
  p.solid_fraction = p.record.solid_fraction;

  ++p.record.number;
  p.record.time = step.time;
  p.record.dt = step.dt;
  p.record.reason = step.reason;
  p.record.temperature_error = measure.temperature_error;
  p.record.displacement_error = measure.displacement_error;
  p.record.output = p.control.is_landing(step.time);
  for (Observer* o : observers_) o->step(p.record, p.committed);
  p.record.rejected = 0;
  p.record.rejection.clear();
}

}  // namespace solidus::coupling
