/// How temperatures and displacements changed over the last step: what the next one is predicted from.
#pragma once

#include <vector>

namespace solidus::coupling {

/// Difference quotients of a step that was taken. Empty where none was, and where nothing asks for them.
struct Rates {
  std::vector<double> temperature;   ///< [local node] [K/s]
  std::vector<double> displacement;  ///< [local node][component] [m/s]
  /// Coherency::at of the state that the step set out from: rates of melt say nothing of the next step. Empty
  /// where nothing that deforms melts.
  std::vector<double> coherency;

  bool known() const { return !temperature.empty() || !displacement.empty(); }
};

}  // namespace solidus::coupling
