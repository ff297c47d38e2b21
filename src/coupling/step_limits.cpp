#include "coupling/step_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace solidus::coupling {

namespace {

// Steps are planned this much shorter than the limit allows, so that few of them have to be repeated.
constexpr double k_safety = 0.8;
// Estimates are no sharper than this: a step is repeated only where it is above its limit by this factor.
constexpr double k_tolerated = 1.5;

}  // namespace

Strictest strictest(const StepLimits& limits, const StepMeasure& measure) {
  Strictest result;
  result.factor = std::numeric_limits<double>::infinity();
  const auto look = [&](const char* name, const char* unit, double value, double allowed, double order) {
    if (value <= 0) return;
    // What is not a number exceeds every limit by far.
    const double ratio = std::isnan(value) ? std::numeric_limits<double>::infinity() : value / allowed;
    result.ratio = std::max(result.ratio, ratio);
    const double factor = k_safety * std::pow(ratio, -1 / order);
    if (factor >= result.factor) return;
    result.factor = factor;
    result.name = name;
    result.excess = fmt::format("{} {:.3g}{}, allowed {:g}{}", name, value, unit, allowed, unit);
  };
  if (limits.control != ErrorControl::none) {
    look("temperature error", " K", measure.temperature_error, limits.temperature, 2);
    look("displacement error", " m", measure.displacement_error, limits.displacement, 2);
  }
  look("solid fraction", "", measure.solid_fraction_change, limits.solid_fraction, 1);
  result.exceeded = result.ratio > k_tolerated;
  return result;
}

}  // namespace solidus::coupling
