/// The loop over time: plan a step, take and measure it, commit or repeat it.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "coupling/error_estimate.hpp"
#include "coupling/measured_step.hpp"
#include "coupling/observer.hpp"
#include "coupling/scheme.hpp"
#include "coupling/state.hpp"
#include "coupling/step_control.hpp"

namespace solidus::coupling {

struct TimeOptions {
  double end = 0;  ///< [s]
  StepOptions step;
  std::vector<double> output_times;  ///< met exactly; a checkpoint is due at each of them
  int checkpoint_every = 0;          ///< steps between further checkpoints; zero: none
};

enum class Outcome {
  finished,
  stuck,       ///< the smallest step was rejected; the last committed state stands
  interrupted  ///< asked to stop; the last committed state stands
};

class Simulation {
 public:
  /// @param estimate  how adaptive steps measure their local error; needed unless they do not
  /// Throws std::invalid_argument where it is missing.
  Simulation(std::unique_ptr<CouplingScheme> scheme, TimeOptions options,
             std::optional<ErrorEstimate> estimate = {});
  /// Observers are called in the order they were added; they must outlive the simulation.
  void add(Observer& observer) { observers_.push_back(&observer); }
  /// Asked before each step, on every process; the run stops when one of them says so.
  void stop_when(std::function<bool()> asked) { stop_asked_ = std::move(asked); }
  /// Runs from `initial` to the end time, which must lie ahead. Collective.
  /// @param solid_fraction  of `initial`, as StepEffort gives it of the states that follow
  /// @param from where the run that `initial` comes from stood; without it a new run begins. Its step size
  /// counts only if the step options are still the same.
  Outcome run(State initial, double solid_fraction, const std::optional<Continuation>& from = {});

 private:
  struct Progress;  ///< what changes from step to step

  enum class Try { committed, repeat, stuck };
  Try try_step(Progress& p);
  void commit(Progress& p, const PlannedStep& step, const StepMeasure& measure);
  void look_at_excess(Progress& p, const PlannedStep& step, const StepMeasure& measure);
  bool measures_error() const;
  bool stop_asked() const;
  bool checkpoint_due(const StepRecord& record) const;
  /// Writes a checkpoint of the committed state, from which a run goes on with this step control.
  void save(Progress& p, const ControlState& control);
  MeasuredStep measured_step(const std::optional<Continuation>& from);

  std::unique_ptr<CouplingScheme> scheme_;
  TimeOptions options_;
  std::optional<ErrorEstimate> estimate_;
  std::vector<Observer*> observers_;
  std::function<bool()> stop_asked_;
};

}  // namespace solidus::coupling
