/// Unions of ranges of temperature, on a process and over all of them.
#pragma once

#include <algorithm>

#include "heat/loads/thermal_state.hpp"
#include "parallel/parallel.hpp"

namespace solidus::heat {

/// The smallest range that holds both.
inline TemperatureRange united(const TemperatureRange& a, const TemperatureRange& b) {
  return {std::min(a.lowest, b.lowest), std::max(a.highest, b.highest)};
}

/// The union of the ranges of all processes. Collective.
inline TemperatureRange over_processes(const TemperatureRange& range) {
  return {parallel::global_min(range.lowest), parallel::global_max(range.highest)};
}

}  // namespace solidus::heat
