/// Rates of temperatures and displacements over the last step, from which the next one is predicted.
#pragma once

#include <vector>

#include "mechanics/creep_error.hpp"

namespace solidus::coupling {

/// Difference quotients of a step that was taken. Empty where none was, and where nothing asks for them.
struct Rates {
  /// [local node] [K/s]; empty where `heat_flow` is known.
  std::vector<double> temperature;
  /// ThermalPhase::flow_at_end(): where nodes hold the heat, its rate at the end of the step, [local node]
  /// [W].
  std::vector<double> heat_flow;
  std::vector<double> displacement;  ///< [local node][component] [m/s]
  /// Coherency::at of the state that the step set out from: rates of melt say nothing of the next step. Empty
  /// where nothing that deforms melts.
  std::vector<double> coherency;

  mechanics::CreepField creep;  ///< of ε^vp where flow takes time [1/s]; empty where nothing creeps

  /// Sum of the changes of heat of all steps so far [K] (ErrorEstimate::change_of): since the run or its
  /// stage began, or a jump.
  double changed = 0;

  /// The next step is predicted from these.
  bool known() const { return !temperature.empty() || !heat_flow.empty() || !displacement.empty(); }
};

}  // namespace solidus::coupling
