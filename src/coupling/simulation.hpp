/// The loop over time: plan a step, advance, commit or cut.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

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
  Simulation(std::unique_ptr<CouplingScheme> scheme, TimeOptions options);
  /// Observers are called in the order they were added; they must outlive the simulation.
  void add(Observer& observer) { observers_.push_back(&observer); }
  /// Asked before each step, on every process; the run stops when one of them says so.
  void stop_when(std::function<bool()> asked) { stop_asked_ = std::move(asked); }
  /// Runs from `initial` to the end time, which must lie ahead. Collective.
  /// @param from where the run that `initial` comes from stood; without it a new run begins. Its step size
  /// counts only if the step options are still the same.
  Outcome run(State initial, const std::optional<Continuation>& from = {});

 private:
  bool checkpoint_due(const StepRecord& record) const;
  void write_checkpoint(const Continuation& continuation, const State& state);

  std::unique_ptr<CouplingScheme> scheme_;
  TimeOptions options_;
  std::vector<Observer*> observers_;
  std::function<bool()> stop_asked_;
};

}  // namespace solidus::coupling
