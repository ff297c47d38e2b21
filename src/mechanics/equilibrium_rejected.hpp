/// A step whose equilibrium was not found, with the bodies as the iteration left them: what a diagnosis of a
/// run that cannot go on is made from.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "system/errors.hpp"

namespace solidus::mechanics {

/// Points of a contact pair at the last iterate, over all processes.
struct ContactCount {
  std::int64_t closed = 0;
  std::int64_t changed = 0;  ///< between open, sticking and slipping, from the iterate before
};

struct LastIterate {
  std::vector<double> displacement;    ///< [local node][component] [m]
  std::vector<double> flowing;         ///< share of the volume that flows plastically, [body]
  double law_temperature = 0;          ///< of the point whose law finds no state [K]
  std::vector<ContactCount> contacts;  ///< [pair]; empty: whoever knows the pairs has not entered them
};

class EquilibriumRejected : public StepRejected {
 public:
  EquilibriumRejected(const std::string& reason, std::string where, Failure failure, LastIterate last)
      : StepRejected(reason, std::move(where), failure), iterate(std::move(last)) {}
  LastIterate iterate;
};

}  // namespace solidus::mechanics
