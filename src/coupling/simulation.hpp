/// The loop over time: plan a step, advance, commit or cut.
#pragma once

#include <memory>
#include <vector>

#include "coupling/observer.hpp"
#include "coupling/scheme.hpp"
#include "coupling/state.hpp"
#include "coupling/step_control.hpp"

namespace solidus::coupling {

struct TimeOptions {
  double end = 0;  ///< [s]
  StepOptions step;
  std::vector<double> output_times;  ///< met exactly
};

enum class Outcome {
  finished,
  stuck  ///< the smallest step was rejected; the last committed state stands
};

class Simulation {
 public:
  Simulation(std::unique_ptr<CouplingScheme> scheme, TimeOptions options);
  /// Observers are called in the order they were added; they must outlive the simulation.
  void add(Observer& observer) { observers_.push_back(&observer); }
  /// Runs from `initial` to the end time. Collective.
  Outcome run(State initial);

 private:
  std::unique_ptr<CouplingScheme> scheme_;
  TimeOptions options_;
  std::vector<Observer*> observers_;
};

}  // namespace solidus::coupling
