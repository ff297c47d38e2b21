/// Data of a run between two steps, besides its state, that a restart needs to continue as if the run had not
/// stopped.
#pragma once

#include <string>
#include <vector>

#include "coupling/diagnosis.hpp"
#include "coupling/rates.hpp"
#include "coupling/shot.hpp"
#include "coupling/step_control.hpp"
#include "system/errors.hpp"

namespace solidus::coupling {

/// Start of the present stage of a run; a run without stages has number zero.
struct StageStart {
  int number = 0;  ///< in the order of the run, from one
  std::string name;
  double time = 0;                   ///< [s]
  std::vector<double> displacement;  ///< [local node][component] [m]; empty without mechanics
};

struct RestartData {
  int steps = 0;        ///< taken so far
  StepOptions options;  ///< that the step control worked with
  ControlState control;
  StageStart stage;
  Rates rates;        ///< of the last step, where adaptive steps predict from them
  ShotHistory shots;  ///< where the run follows shots
  BodyHeat pending;   ///< of bodies that came and left since the last step
};

/// The reason why a run ended before its end time.
struct Stop {
  bool asked = false;                ///< from outside; the rest is then empty
  std::string reason;                ///< of the last rejection: "mechanics: no convergence in 25 iterations"
  std::string where;                 ///< the place with its state; may be empty
  int tries = 0;                     ///< rejected in a row, each with a smaller step
  double smallest_step = 0;          ///< the last one tried [s]
  Failure failure = Failure::other;  ///< of the last rejection
  Diagnosis diagnosis{};             ///< the physical state behind it
};

}  // namespace solidus::coupling
