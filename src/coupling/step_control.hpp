/// The size of the next step: lands on output times and on events of the conditions, cuts after a rejection,
/// and, where it is adaptive, grows and shrinks with the step limits and the effort of the iteration.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "coupling/step_limits.hpp"
#include "numbers/time_events.hpp"

namespace solidus::coupling {

struct StepOptions {
  double step = 1;        ///< the step asked for; where adaptive, the first one [s]
  bool adaptive = false;  ///< sizes follow `limits`, between min_step and max_step
  /// The smallest step [s]. Zero: errors make no step shorter than step / 1024, and one that does not
  /// converge is cut down to step / 2^20, whence it grows again.
  double min_step = 0;
  double max_step = 0;      ///< [s]; zero: 10 × step when adaptive, else step
  double growth = 1.5;      ///< largest factor from one step to the next
  double cut = 0.5;         ///< factor after a step that did not go through
  int easy_iterations = 6;  ///< a step whose phases all took at most this many Newton iterations is easy
  StepLimits limits;        ///< of adaptive steps

  double largest() const {  ///< step [s]
    if (!adaptive) return step;
    return max_step > 0 ? max_step : 10 * step;
  }
  bool operator==(const StepOptions&) const = default;
};

/// A planned step: from the present time to `time`.
struct PlannedStep {
  double time = 0;     ///< t_{n+1}, exactly a landing where the step ends at one
  double dt = 0;       ///< t_{n+1} − t_n
  std::string reason;  ///< why this size, for steps.csv
};

/// The longest step that something else than the step limits allows.
struct LongestStep {
  double dt = HUGE_VAL;  ///< [s]
  std::string reason;    ///< what asks for it, for steps.csv
};

/// State of the step control between steps, for checkpoints.
struct ControlState {
  double size = 0;                  ///< the step wanted next, before landing [s]
  std::string reason = "as asked";  ///< why
  /// Data of the first step from here that exceeded a limit, and the size wanted before it; zero: none did.
  double refused = 0, refused_ratio = 0, before_refusal = 0;
  /// Tries that did not go through since the last step that did, with augmentations that converged.
  int failures = 0;
};

class StepControl {
 public:
  /// @param landings times that must be met exactly (output times, the end), any order; those before `start`
  /// are ignored Throws std::invalid_argument for sizes that are not positive or contradict each other, or if
  /// no landing lies ahead.
  /// @param events  where conditions bend or jump, any order: steps end there too, but for events of averaged
  /// loads that are closer than the smallest step to another one or to a landing
  StepControl(const StepOptions& options, double start, std::vector<double> landings,
              std::vector<TimeEvent> events = {});

  bool finished(double time) const { return time >= end_; }
  double end() const { return end_; }
  /// @param longest  what bounds an adaptive step besides; a fixed one does not ask for it
  PlannedStep plan(double time, const LongestStep& longest = {}) const;
  /// Whether a condition jumps at this end of a step, so that what has gone before tells nothing of what
  /// follows.
  bool jumps_at(double time) const;
  /// The step is committed.
  void accepted(const PlannedStep& step, const StepMeasure& measure);
  /// The step did not go through, `why`. False when the next one would fall below the smallest step allowed.
  bool rejected(const PlannedStep& step, const std::string& why);
  /// Whether a step that went through exceeds a limit and is to be repeated with a smaller one. Not if it is
  /// the smallest, and not if it is a jump: what does not get smaller with the step (a body that snaps into
  /// another contact, a load that is put on at once) no step resolves.
  bool too_long(const PlannedStep& step, const StepMeasure& measure) const;
  /// The step was too long.
  /// @param what  has happened to it, for the reason of the next one
  void shortened(const PlannedStep& step, const StepMeasure& measure, const std::string& what = "rejected");
  /// Whether so many tries have failed that augmentations need not converge any more.
  bool may_end_early() const { return state_.failures >= k_patience; }

  const ControlState& state() const { return state_; }
  void resume(ControlState state) { state_ = std::move(state); }

 private:
  static constexpr int k_patience = 3;
  void add_events(std::vector<TimeEvent> events, const std::vector<double>& landings);
  void resize(double size, const std::string& reason);
  bool is_jump(const PlannedStep& step, const Strictest& limit) const;
  /// Without limits: back to the step asked for, after a cut.
  void recover();

  StepOptions options_;
  std::vector<double> landings_;   ///< rising
  std::vector<TimeEvent> events_;  ///< rising, none at a landing
  std::vector<double> jumps_;      ///< landings at which a condition jumps
  double end_ = 0;
  ControlState state_;
};

}  // namespace solidus::coupling
