#include "coupling/step_control.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace solidus::coupling {

namespace {

// Two times closer than this share of the step are the same.
constexpr double k_same_time = 1e-9;
// A step may be longer by this share to land. Sums of steps carry rounding, which grows with the square of
// their number: 1e-8 of a step after 30 000 of them. A step as short as what is left would be no step that a
// method in time can resolve.
constexpr double k_stretch = 1e-3;
// A jump of temperature is called one after a cut to this share of the step that was refused first: an error
// that nodes commit as they pass a kink need not fall with every cut.
constexpr double k_tells = 0.3;
// An estimate that is far off must not cost more than this at once.
constexpr double k_deepest_cut = 0.1;
/// Powers of two of the smallest steps. An error in time does not end a run, so it need not be chased for
/// ever. A step that does not converge does: contact that closes within a long step, or a melt that is
/// chilled at once, may need the first moment of it.
constexpr int k_of_errors = -10, k_of_failures = -20;

double smallest_of_errors(const StepOptions& options) {
  return options.min_step > 0 ? options.min_step : std::ldexp(options.step, k_of_errors);
}

double smallest_of_failures(const StepOptions& options) {
  return options.min_step > 0 ? options.min_step : std::ldexp(options.step, k_of_failures);
}

}  // namespace

StepControl::StepControl(const StepOptions& options, double start, std::vector<double> landings,
                         std::vector<TimeEvent> events)
    : options_(options), landings_(std::move(landings)) {
  // The options have to make sense together; what a user gives has been checked with its place before.
  if (!(options_.step > 0)) throw std::invalid_argument("the time step must be positive");
  options_.max_step = options_.largest();
  if (smallest_of_errors(options_) > options_.step || options_.max_step < options_.step)
    throw std::invalid_argument("min_step <= step <= max_step must hold");
  if (!(options_.growth > 1) || !(options_.cut > 0 && options_.cut < 1))
    throw std::invalid_argument("growth must exceed one and cut lie between zero and one");
  const StepLimits& limits = options_.limits;
  if (!(limits.temperature > 0) || !(limits.displacement > 0) || !(limits.solid_fraction > 0))
    throw std::invalid_argument("the limits of a step must be positive");
  // Landings up to the start are past. The last one is the end.
  std::sort(landings_.begin(), landings_.end());
  const std::vector<double> all = landings_;
  std::erase_if(landings_, [start](double t) { return t <= start; });
  if (landings_.empty()) throw std::invalid_argument("the end time must lie after the start");
  end_ = landings_.back();
  state_.size = options_.step;
  add_events(std::move(events), all);
}

/// @param landings  those before the start too: a run that goes on has the events of one that has not stopped
void StepControl::add_events(std::vector<TimeEvent> events, const std::vector<double>& landings) {
  const double same = k_same_time * options_.step, shortest = smallest_of_errors(options_);
  for (const TimeEvent& event : in_order(std::move(events), same, shortest)) {
    const auto next = std::lower_bound(landings.begin(), landings.end(), event.time);
    double nearest = HUGE_VAL;
    const auto see = [&](double landing) {
      if (std::abs(landing - event.time) < std::abs(nearest - event.time)) nearest = landing;
    };
    if (next != landings.end()) see(*next);
    if (next != landings.begin()) see(*(next - 1));
    if (std::abs(nearest - event.time) > (event.at_ends ? same : shortest))
      events_.push_back(event);
    else if (event.jump)
      jumps_.push_back(nearest);
  }
}

bool StepControl::jumps_at(double time) const {
  const auto found = std::lower_bound(events_.begin(), events_.end(), time,
                                      [](const TimeEvent& e, double t) { return e.time < t; });
  if (found != events_.end() && found->time == time) return found->jump;
  return std::find(jumps_.begin(), jumps_.end(), time) != jumps_.end();
}

PlannedStep StepControl::plan(double time, const LongestStep& longest) const {
  const double least = std::min(smallest_of_errors(options_), state_.size);
  const bool held = options_.adaptive && std::max(longest.dt, least) < state_.size;
  const double size = held ? std::max(longest.dt, least) : state_.size;
  const std::string reason = held ? longest.reason : state_.reason;
  const double beyond = time + k_same_time * state_.size;
  const auto next = std::upper_bound(landings_.begin(), landings_.end(), beyond);
  double landing = next == landings_.end() ? end_ : *next;
  const auto event = std::upper_bound(events_.begin(), events_.end(), beyond,
                                      [](double t, const TimeEvent& e) { return t < e.time; });
  const bool at_event = event != events_.end() && event->time < landing;
  if (at_event) landing = event->time;
  const std::string what = at_event ? "event" : landing == end_ ? "end" : "output time";
  // A step is stretched by less than a cut shortens it, so that a step that was rejected is not planned
  // again.
  const double stretch = std::min(k_stretch, 0.5 * (1 / options_.cut - 1));
  const double rest = landing - time, tolerance = stretch * size;
  if (rest <= size + tolerance) return {landing, rest, rest < size - tolerance ? what : reason};
  // Two halves rather than a full step and a sliver, where the size is ours to choose.
  if (options_.adaptive && rest < 1.5 * size) {
    const double half = rest / 2;
    return {time + half, half, at_event ? "event ahead" : "output time ahead"};
  }
  return {time + size, size, reason};
}

void StepControl::accepted(const PlannedStep& step, const StepMeasure& measure) {
  // Where augmentations have ended early they may do so in the steps that follow, which need not fail again.
  if (!measure.ended_early) state_.failures = 0;
  if (!options_.adaptive) return recover();
  const Strictest limit = strictest(options_.limits, measure);
  const bool jump = is_jump(step, limit);
  const double before = state_.before_refusal;
  state_.refused = state_.refused_ratio = state_.before_refusal = 0;
  if (limit.exceeded && jump) return resize(before, "after a jump");
  const bool full = step.dt >= state_.size * (1 - k_same_time);
  // A step that was shortened to land says little of one much longer.
  double size = full ? state_.size * options_.growth : std::max(state_.size, step.dt * options_.growth);
  std::string reason = size > state_.size ? "growth limit" : "as before the output time";
  const auto at_most = [&](double bound, const std::string& why) {
    if (bound >= size) return;
    size = bound;
    reason = why;
  };
  at_most(options_.max_step, "largest allowed");
  if (measure.iterations > options_.easy_iterations) {
    // Half the step pays only where it halves the iterations, and where metal yields or contact opens they
    // often stay what they are: steps grow the less the more iterations there are, and shorter ones are a way
    // out for those that come near to failing, never below what was asked.
    constexpr double k_no_growth = 3, k_hard = 4;  ///< times as many iterations as are easy
    const double effort = static_cast<double>(measure.iterations) / options_.easy_iterations;
    const double growth =
        1 + (options_.growth - 1) * std::max(0.0, (k_no_growth - effort) / (k_no_growth - 1));
    const double wanted = (effort > k_hard ? k_hard / effort : growth) * state_.size;
    at_most(std::max(wanted, std::min(options_.step, size)), "newton effort");
  }
  at_most(step.dt * limit.factor, limit.name);
  resize(size, reason);
}

void StepControl::recover() {
  // After a cut the size comes back to what was asked, also when steps are not easy: one hard moment must not
  // slow the rest.
  const double size = std::min(state_.size * options_.growth, options_.step);
  resize(size, size == options_.step ? "as asked" : "growing after a cut");
}

bool StepControl::rejected(const PlannedStep& step, const std::string& why) {
  state_.size = step.dt * options_.cut;
  state_.reason = "rejected: " + why;
  ++state_.failures;
  return state_.size >= smallest_of_failures(options_) * (1 - k_same_time);
}

// Errors at a kink of the solution fall as Δt, in a shock as √Δt, its root mean square over a body, which
// sees the layer of a width of √Δt, as Δt^¼; a jump stays.
bool StepControl::is_jump(const PlannedStep& step, const Strictest& limit) const {
  if (state_.refused == 0) return false;
  const bool of_temperature = limit.name == "temperature error";
  if (of_temperature && step.dt > k_tells * state_.refused) return false;
  const double shock = of_temperature ? 0.125 : 0.25;
  return limit.ratio > state_.refused_ratio * std::pow(step.dt / state_.refused, shock);
}

bool StepControl::too_long(const PlannedStep& step, const StepMeasure& measure) const {
  if (!options_.adaptive || step.dt <= smallest_of_errors(options_) * (1 + k_stretch) * (1 + k_same_time))
    return false;
  const Strictest limit = strictest(options_.limits, measure);
  return limit.exceeded && !is_jump(step, limit);
}

void StepControl::shortened(const PlannedStep& step, const StepMeasure& measure, const std::string& what) {
  const Strictest limit = strictest(options_.limits, measure);
  if (state_.refused == 0) {
    state_.before_refusal = state_.size;
    state_.refused = step.dt;
    state_.refused_ratio = limit.ratio;
  }
  resize(step.dt * std::max(limit.factor, k_deepest_cut), what + ": " + limit.name);
}

void StepControl::resize(double size, const std::string& reason) {
  state_.size = std::max(size, std::min(smallest_of_errors(options_), state_.size));
  state_.reason = state_.size > size ? "smallest allowed" : reason;
}

}  // namespace solidus::coupling
