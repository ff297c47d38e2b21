/// A step whose balance of heat was not found, with the temperatures as the iteration left them: what a
/// diagnosis of a run that cannot go on is made from.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "numbers/types.hpp"
#include "system/errors.hpp"

namespace solidus::heat {

class HeatRejected : public StepRejected {
 public:
  /// @param worst  the owned node that the message names, on its process; −1 on all others
  HeatRejected(const std::string& reason, std::string where, Failure failure,
               std::span<const double> temperatures, Index worst)
      : StepRejected(reason, std::move(where), failure),
        temperature(temperatures.begin(), temperatures.end()),
        node(worst) {}
  std::vector<double> temperature;  ///< of the last iterate, [local node] [K]
  Index node;
};

}  // namespace solidus::heat
