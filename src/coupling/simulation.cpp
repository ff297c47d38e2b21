#include "coupling/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "coupling/finite_measure.hpp"
#include "heat/thermal_phase.hpp"
#include "linear/interruption.hpp"
#include "parallel/parallel.hpp"
#include "system/errors.hpp"
#include "system/log.hpp"

namespace solidus::coupling {

namespace {

// Output times this close to the end of a stage, as a share of its step, are that end.
constexpr double k_same_time = 1e-9;
constexpr double k_solid = 1 - 1e-12;  // solid by volume, but for the rounding of its sum

}  // namespace

struct Simulation::Progress {
  State committed, trial;
  SolidFraction solid_fraction_of;  ///< of a committed state
  std::size_t stage = 0;            ///< in TimeOptions::stages
  StageStart stage_start;
  std::optional<StepControl> control;  ///< of the stage
  std::optional<MeasuredStep> step;
  std::vector<double> outputs;   ///< times at which fields are written, rising
  std::vector<double> landings;  ///< these, and the end of the stage
  StepRecord record;             ///< of the step last committed; its rejections are those since
  struct Pending {
    PlannedStep step;
    StepMeasure measure;
    StepRecord record;
  };
  std::optional<Pending> pending;  ///< the step that `trial` is the end of
  bool ended = false;              ///< observers were told of the end
  double solid_fraction = 1;       ///< of the committed state
  ShotHistory shots;
  BodyHeat carried;     ///< of bodies that came and left since the last step
  int saved = -1;       ///< the step whose checkpoint is written
  bool warned = false;  ///< of a limit that the smallest step exceeds
  Stop stop;
};

Simulation::Simulation(std::unique_ptr<CouplingScheme> scheme, TimeOptions options,
                       std::optional<ErrorEstimate> estimate)
    : scheme_(std::move(scheme)), options_(std::move(options)), estimate_(std::move(estimate)) {
  if (options_.stages.empty()) options_.stages.push_back({"", 0, 0, options_.end, options_.step});
  for (const Stage& stage : options_.stages)
    if (measures_error(stage.step) && !estimate_)
      throw std::invalid_argument("adaptive steps need an estimate of their error");
}

Simulation::~Simulation() = default;

void Simulation::save(Progress& p, const ControlState& control) {
  scheme_->forget();
  const RestartData continuation{
      p.record.number, options_.stages[p.stage].step, control, p.stage_start, p.step->rates(), p.shots,
      p.carried};
  for (Observer* o : observers_) o->checkpoint(continuation, p.committed);
  p.saved = p.record.number;
}

void Simulation::measure_steps(Progress& p, const StepOptions& step, Rates rates) {
  const bool tells = !step.adaptive && estimate_ && step.limits.control != ErrorControl::none;
  if (!measures_error(step) && !tells) return void(p.step.emplace(*scheme_));
  p.step.emplace(*scheme_, step.limits.control, *estimate_, std::move(rates));
  if (tells) p.step->only_tell(p.committed.mechanics.displacement.empty());
}

void Simulation::enter_stage(Progress& p, const std::optional<RestartData>& from) {
  // A stage begins where the committed state lies at its start; a restart within a stage continues it.
  const Stage& stage = options_.stages[p.stage];
  const bool first = p.stage == 0, staged = stage.of_case > 0;
  const double start = first ? p.committed.time : options_.stages[p.stage - 1].end;
  const bool anew = p.committed.time == start && !(first && from);
  // Loads and contact jump at the start of a stage: rates of the steps before do not hold across it.
  if (anew) {
    p.stage_start = {staged ? static_cast<int>(p.stage) + 1 : 0, stage.name, start,
                     p.committed.mechanics.displacement};
    p.committed.mechanics.dt_before = 0;
    p.committed.displacement_rate.clear();
    p.committed.steady_gaps.clear();
    p.committed.pressure_rate.clear();
  } else {
    p.stage_start = from->stage;
  }
  // Steps land on times of output and on the end; times too close to the end would leave a step of rounding.
  std::vector<double> landings = options_.output_times;
  const bool asked_at_end = std::any_of(landings.begin(), landings.end(), [&](double t) {
    return std::abs(t - stage.end) <= k_same_time * stage.step.step;
  });
  std::erase_if(landings, [&](double t) { return t >= stage.end - k_same_time * stage.step.step; });
  // Fields are written at the landings, and at the end if that is asked for or ends the run.
  p.outputs = landings;
  landings.push_back(stage.end);
  if (asked_at_end || options_.output_at_stage_ends || &stage == &options_.stages.back())
    p.outputs.push_back(stage.end);
  std::sort(p.outputs.begin(), p.outputs.end());
  p.landings = landings;
  // The control of the step size goes on where a checkpoint left it, unless its options were changed.
  p.control.emplace(stage.step, p.committed.time, std::move(landings), events(p));
  if (!anew && from->options == stage.step) p.control->resume(from->control);
  measure_steps(p, stage.step, anew ? Rates{} : from->rates);
  p.record.stage = stage.name;
  p.record.stage_of_case = stage.of_case;
  p.record.cycle = stage.cycle;
  // Bodies that come or leave change the internal energy without heat: the difference is booked as carried
  // energy, so that the first law closes, once only where a checkpoint has booked it already.
  const bool changed_before = from && from->stage.number == p.stage_start.number;
  const bool energy_changes = staged && anew && !changed_before && p.stage > 0 && followers_.internal_energy;
  const double energy = energy_changes ? followers_.internal_energy(p.committed) : 0.0;
  if (staged) begin_bodies(p, anew, changed_before);
  p.solid_fraction = p.solid_fraction_of(p.committed);
  scheme_->synchronise(p.committed);
  if (energy_changes) p.carried.energy += followers_.internal_energy(p.committed) - energy;
  scheme_->forget();  // as after a checkpoint of this state
}

std::vector<TimeEvent> Simulation::events(const Progress& p) const {
  std::vector<TimeEvent> all = options_.events ? options_.events(p.stage) : std::vector<TimeEvent>{};
  if (followers_.growth != nullptr) add_births(*followers_.growth, all);
  return all;
}

/// Gives the phases the conditions of the stage.
/// @param anew            the stage begins at the committed time
/// @param changed_before  the state is changed for it already: a run that stopped before its first step
void Simulation::begin_bodies(Progress& p, bool anew, bool changed_before) {
  const Stage& stage = options_.stages[p.stage];
  const bool changes = anew && !changed_before;
  if (changes && stage.shot > 0) p.committed.shot = stage.shot;
  if (changes && stage.begins_shot && followers_.shots != nullptr)
    p.carried.corrected += followers_.shots->begin(p.committed, p.shots);
  const BodyHeat heat = followers_.stage_begins(p.stage, p.stage_start, changes ? &p.committed : nullptr);
  scheme_->conditions_changed();
  if (!changes) return;
  p.stage_start.displacement = p.committed.mechanics.displacement;
  if (p.stage > 0) {
    p.carried += heat;
    p.shots.heat += heat;
  }
  if (stage.pours) p.committed.poured = p.committed.time;
  if (!stage.pours || followers_.criteria == nullptr) return;
  const criteria::Criteria& criteria = *followers_.criteria;
  const criteria::CriterionInput start{0, p.committed.heat, p.committed.mechanics};
  // Criteria of dies go on from shot to shot; all others begin anew with the pour of each shot.
  auto& record = p.committed.criteria;
  if (stage.begins_shot && stage.shot > 1)
    record = criteria.next_shot(record, start);
  else
    record = stage.begins_shot || p.stage == 0 ? criteria.initial(start) : criteria.restart(record, start);
}

void Simulation::grow(Progress& p) {
  if (followers_.growth == nullptr || !followers_.growth->due(p.committed.time)) return;
  p.carried += let_grow(*followers_.growth, *scheme_, followers_.internal_energy, p.committed);
  p.solid_fraction = p.solid_fraction_of(p.committed);
}

bool Simulation::solid(const Progress& p) const {
  if (followers_.growth != nullptr && followers_.growth->goes_on(p.committed.time)) return false;
  return options_.until_solid && p.record.number > 0 && p.solid_fraction >= k_solid;
}

bool Simulation::periodic(const Progress& p) const {
  const Stage& stage = options_.stages[p.stage];
  return followers_.shots != nullptr && stage.ends_shot && p.committed.time == stage.end &&
         followers_.shots->periodic(p.shots);
}

void Simulation::end_shot(Progress& p) {
  if (followers_.shots == nullptr) return;
  const ShotRecord record = followers_.shots->end(p.committed, p.shots);
  for (Observer* o : observers_) o->shot(record, p.committed);
}

Outcome Simulation::stopped(const Stop& why, Progress& p, Outcome outcome) {
  for (Observer* o : observers_) o->stopped(why, p.committed);
  return outcome;
}

Outcome Simulation::run(State initial, const SolidFraction& solid_fraction,
                        const std::optional<RestartData>& from) {
  begin(std::move(initial), solid_fraction, from);
  std::optional<Outcome> outcome;
  while (!(outcome = take_step())) commit_step();
  progress_.reset();  // states are large
  return *outcome;
}

void Simulation::begin(State initial, SolidFraction solid_fraction, const std::optional<RestartData>& from) {
  progress_ = std::make_unique<Progress>();
  Progress& p = *progress_;
  p.solid_fraction_of = std::move(solid_fraction);
  criteria::CriteriaState records =
      std::move(initial.criteria);  // there is one of them, which commit() hands on
  p.trial = initial;
  p.committed = std::move(initial);
  p.committed.criteria = std::move(records);
  p.saved = from ? from->steps : -1;
  p.record.number = from ? from->steps : 0;
  p.record.time = p.committed.time;
  // A run that goes on has a state with all that was born before.
  if (from && followers_.growth != nullptr && followers_.growth->due(p.committed.time))
    followers_.growth->grow(p.committed.time, nullptr);
  if (from && followers_.moves_heat) followers_.moves_heat(p.committed, true);
  if (from) {
    p.shots = from->shots;
    p.carried = from->pending;
    p.stage = from->stage.number > 0 ? static_cast<std::size_t>(from->stage.number) - 1 : 0;
    if (periodic(p)) return end_at_once(p, from->stage);
  }
  const auto ahead = std::ranges::upper_bound(options_.stages, p.committed.time, {}, &Stage::end);
  if (ahead == options_.stages.end() && from) return end_at_once(p, from->stage);
  if (ahead == options_.stages.end()) throw std::invalid_argument("the end time must lie after the start");
  // A run that goes on from the end of a shot changes bodies as one that has not stopped.
  const auto next = static_cast<std::size_t>(ahead - options_.stages.begin());
  if (from && options_.stages[next].begins_shot && next == p.stage + 1)
    followers_.stage_begins(p.stage, from->stage, nullptr);
  p.stage = next;
  enter_stage(p, from);
  for (Observer* o : observers_) o->begin(p.committed);
}

void Simulation::end_at_once(Progress& p, const StageStart& stage_start) {
  if (!periodic(p)) p.stage = options_.stages.size() - 1;
  if (options_.stages[p.stage].of_case > 0) followers_.stage_begins(p.stage, stage_start, nullptr);
  scheme_->synchronise(p.committed);
  for (Observer* o : observers_) o->begin(p.committed);
  for (Observer* o : observers_) o->end(p.committed);
  p.ended = true;
}

std::optional<Outcome> Simulation::take_step() {
  Progress& p = *progress_;
  while (!p.ended) {
    if (p.control->finished(p.committed.time) || solid(p)) {
      if (p.stage + 1 < options_.stages.size() && !periodic(p)) {
        ++p.stage;
        enter_stage(p, {});
        continue;
      }
      for (Observer* o : observers_) o->end(p.committed);
      p.ended = true;
      break;
    }
    if (stop_asked()) {
      if (p.saved != p.record.number || p.record.rejected + p.record.shortened > 0)
        save(p, p.control->state());
      Stop asked;
      asked.asked = true;
      return stopped(asked, p, Outcome::interrupted);
    }
    switch (try_step(p)) {
      case Try::taken:
        return {};
      case Try::repeat:
        scheme_->synchronise(p.committed);
        break;
      case Try::stuck:
        // A run that continues from here has a changed case, so it starts with the step asked for, not with
        // the one that failed.
        save(p, {.size = options_.stages[p.stage].step.step});
        return stopped(p.stop, p, Outcome::stuck);
    }
  }
  return Outcome::finished;
}

void Simulation::commit_step() {
  Progress& p = *progress_;
  const Progress::Pending pending = std::move(*p.pending);
  p.pending.reset();
  p.record = pending.record;
  commit(p, pending.step, pending.measure);
  grow(p);
  if (checkpoint_due(p.record)) save(p, p.control->state());
}

void Simulation::discard_step(std::optional<double> step) {
  Progress& p = *progress_;
  p.pending.reset();
  ++p.record.rejected;
  p.record.rejection = "repeated as asked";
  scheme_->synchronise(p.committed);
  if (step) ask_step(*step);
}

void Simulation::ask_step(double step) {
  Progress& p = *progress_;
  ControlState control = p.control->state();
  control.size = step;
  control.reason = "as asked";
  p.control->resume(std::move(control));
}

void Simulation::conditions_changed() {
  Progress& p = *progress_;
  scheme_->conditions_changed();
  scheme_->synchronise(p.committed);
  scheme_->forget();
  if (p.ended || p.control->finished(p.committed.time)) return;
  ControlState control = p.control->state();
  p.control.emplace(options_.stages[p.stage].step, p.committed.time, p.landings, events(p));
  p.control->resume(std::move(control));
}

Present Simulation::present() const {
  const Progress& p = *progress_;
  return {.pending = p.pending.has_value(),
          .state = p.pending ? p.trial : p.committed,
          .record = p.pending ? p.pending->record : p.record,
          .stage_start = p.stage_start,
          .stage = p.stage};
}

PlannedStep Simulation::plan(const Progress& p) const {
  const StepOptions& options = options_.stages[p.stage].step;
  const double time = p.committed.time, least = options.limits.last_melt;
  LongestStep longest;
  // A casting is solid somewhere in the step in which its last melt freezes, and contracts fast then. Steps
  // go with the root of the error allowed, from a quarter of the step asked for on, which mush begins with.
  const double looser = std::sqrt(options.limits.temperature / StepLimits{}.temperature);
  const double left = looser * longest_before_solid(1 - p.solid_fraction, time - p.committed.poured, least);
  if (least > 0 && p.solid_fraction < k_solid) longest = {std::max(left, 0.25 * options.step), "last melt"};
  const PlannedStep step = p.control->plan(time, longest);
  if (followers_.loads == nullptr || !options.adaptive) return step;
  const double moves = heat::lasting_loads(*followers_.loads, time, step.time);
  return moves < step.dt ? p.control->plan(time, {moves, "load moves"}) : step;
}

// The committed state is not touched before the step is known to be good: a step that is repeated starts from
// the same bits.
Simulation::Try Simulation::try_step(Progress& p) {
  const PlannedStep step = plan(p);
  StepMeasure measure;
  StepRecord record;
  if (followers_.burning != nullptr)
    heat::begin_burning(*followers_.burning, p.committed.burning, p.committed.time, step.time);
  scheme_->allow_early_end(p.control->may_end_early());
  try {
    const auto measured = [](const LocalError& error) {
      StepMeasure of_error;
      of_error.temperature_error = error.temperature;
      of_error.displacement_error = error.displacement;
      of_error.stress_error = error.stress;
      of_error.skin_change = error.skin;
      of_error.skin_opening = error.opening;
      return of_error;
    };
    const MeasuredStep::Taken taken =
        p.step->take(p.committed, p.trial, step.time, step.dt,
                     [&](const LocalError& error) { return p.control->too_long(step, measured(error)); });
    measure = measured(taken.error);
    if (taken.effort) {
      measure.iterations = std::max(taken.effort->heat.hard(), taken.effort->mechanics.hard());
      measure.solid_fraction_change = std::abs(taken.effort->solid_fraction - p.solid_fraction);
      measure.ended_early = std::ranges::any_of(
          taken.effort->contacts, [](const ContactSummary& pair) { return pair.left_penetration > 0; });
    }
    require_finite(measure);
    if (!taken.effort || p.control->too_long(step, measure)) {
      ++(taken.effort ? p.record.rejected : p.record.shortened);
      p.record.rejection = strictest(options_.stages[p.stage].step.limits, measure).excess;
      p.control->shortened(step, measure, taken.effort ? "rejected" : "shortened");
      return Try::repeat;
    }
    record = p.record;
    static_cast<StepEffort&>(record) = *taken.effort;
  } catch (const linear::Interrupted&) {
    return Try::repeat;  // before which stop_asked() ends the run
  } catch (const StepRejected& rejection) {
    ++p.record.rejected;
    p.record.rejection = rejection.reason();
    if (p.control->rejected(step, rejection.reason())) return Try::repeat;
    p.stop = {false, rejection.reason(), rejection.where(), p.record.rejected, step.dt, rejection.failure(),
              {}};
    if (followers_.diagnose) p.stop.diagnosis = followers_.diagnose(p.committed, rejection, step.dt);
    return Try::stuck;
  }
  hold_pending(p, step, measure, std::move(record));
  return Try::taken;
}

/// The trial state is that at the end of a step that has been taken, and is told of as such.
void Simulation::hold_pending(Progress& p, const PlannedStep& step, const StepMeasure& measure,
                              StepRecord record) {
  if (followers_.burning != nullptr)
    p.trial.burning = heat::burnt(*followers_.burning, p.committed.burning, p.committed.heat, p.trial.heat,
                                  p.committed.time, step.time);
  p.trial.time = step.time;
  p.trial.shot = p.committed.shot;
  p.trial.poured = p.committed.poured;
  record.number = p.record.number + 1;
  record.time = step.time;
  record.dt = step.dt;
  record.reason = step.reason;
  record.temperature_error = measure.temperature_error;
  record.displacement_error = measure.displacement_error;
  record.stress_error = measure.stress_error;
  record.output = std::binary_search(p.outputs.begin(), p.outputs.end(), step.time) ||
                  (options_.until_solid && record.solid_fraction >= k_solid);
  record.energy.bodies = p.carried;
  p.pending = {step, measure, std::move(record)};
}

// A step that is committed although it exceeds a limit contains a jump, or is the smallest one: its rates are
// not used to predict the next step.
void Simulation::check_limits(Progress& p, const PlannedStep& step, const StepMeasure& measure) {
  if (!options_.stages[p.stage].step.adaptive) return;
  const Strictest limit = strictest(options_.stages[p.stage].step.limits, measure);
  if (!limit.exceeded) return;
  p.step->forget();
  if (std::exchange(p.warned, true)) return;
  logging::warn("t = {:g} s: {}, which steps down to {:g} s do not bring down; the run goes on", step.time,
                limit.excess, step.dt);
}

void Simulation::commit(Progress& p, const PlannedStep& step, const StepMeasure& measure) {
  p.trial.criteria = std::move(p.committed.criteria);
  if (followers_.criteria != nullptr)
    followers_.criteria->step(
        {p.committed.time - p.committed.poured, p.committed.heat, p.committed.mechanics},
        {p.trial.time - p.committed.poured, p.trial.heat, p.trial.mechanics}, p.trial.criteria);
  std::swap(p.committed, p.trial);
  move_heat(p.committed);
  p.step->commit();
  check_limits(p, step, measure);
  p.control->accepted(step, measure);
  if (p.control->jumps_at(step.time)) p.step->forget();
  p.solid_fraction = p.record.solid_fraction;
  p.carried = {};
  if (followers_.shots != nullptr) {
    p.shots.lowest = std::min(p.shots.lowest, p.record.min_temperature);
    p.shots.highest = std::max(p.shots.highest, p.record.max_temperature);
  }
  for (Observer* o : observers_) o->step(p.record, p.committed);
  if (const Stage& stage = options_.stages[p.stage]; stage.ends_shot && step.time == stage.end) end_shot(p);
  p.record.rejected = p.record.shortened = 0;
  p.record.rejection.clear();
}

}  // namespace solidus::coupling
