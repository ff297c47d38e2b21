/// Where a run stands between two steps, beside its state: what it needs to go on as if it had not stopped.
#pragma once

#include <string>

#include "coupling/rates.hpp"
#include "coupling/step_control.hpp"

namespace solidus::coupling {

struct Continuation {
  int steps = 0;        ///< taken so far
  StepOptions options;  ///< that the step control worked with
  ControlState control;
  Rates rates;  ///< of the last step, where adaptive steps predict from them
};

/// Why a run ended before its end time.
struct Stop {
  bool asked = false;        ///< from outside; the rest is then empty
  std::string reason;        ///< of the last rejection: "mechanics: no convergence in 25 iterations"
  std::string where;         ///< the place with its state; may be empty
  int tries = 0;             ///< rejected in a row, each with a smaller step
  double smallest_step = 0;  ///< the last one tried [s]
};

}  // namespace solidus::coupling
