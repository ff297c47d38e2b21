#include "coupling/step_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace solidus::coupling {

namespace {

// Steps are planned this much shorter than the limit allows, so that few of them have to be repeated. That of
// a casting which deforms is judged by its heat before mechanics is solved, which is most of the work: a
// repetition costs it less than shorter steps.
constexpr double k_safety = 0.8, k_safety_before_mechanics = 0.9;
// Estimates are no sharper than this: a step is repeated only where it is above its limit by this factor.
constexpr double k_tolerated = 1.5;
// Without inertia a displacement is not integrated in time, it follows from equilibrium at t_{n+1}: its error
// is not carried on, and that of one point of contact that opens is not worth a second try.
constexpr double k_tolerated_displacement = 3;
// That of a casting is of its worst node, some three to eight times the root mean square over the body, and a
// node that snaps into another contact moves in the shortest step: such a step sets the size of the next one.
constexpr double k_tolerated_worst_node = 12;

}  // namespace

Strictest strictest(const StepLimits& limits, const StepMeasure& measure) {
  // Each measure is compared with its limit. The limit that allows the smallest next step sets the factor and
  // is named; a step is repeated where a measure exceeds its limit by more than its tolerated ratio.
  Strictest result;
  result.factor = std::numeric_limits<double>::infinity();
  const auto look = [&](const char* name, const char* unit, double value, double allowed, double order,
                        double tolerated, double safety = k_safety) {
    if (value <= 0) return;
    // A value that is not a number exceeds every limit by far.
    const double ratio = std::isnan(value) ? std::numeric_limits<double>::infinity() : value / allowed;
    result.ratio = std::max(result.ratio, ratio);
    result.exceeded = result.exceeded || ratio > tolerated;
    const double factor = safety * std::pow(ratio, -1 / order);
    if (factor >= result.factor) return;
    result.factor = factor;
    result.name = name;
    result.excess = fmt::format("{} {:.3g}{}, allowed {:g}{}", name, value, unit, allowed, unit);
  };
  if (limits.control != ErrorControl::none) {
    look("temperature error", " K", measure.temperature_error, limits.temperature, 2, k_tolerated,
         limits.last_melt > 0 ? k_safety_before_mechanics : k_safety);
    look("displacement error", " m", measure.displacement_error, limits.displacement, 2,
         limits.inertia         ? k_tolerated
         : limits.last_melt > 0 ? k_tolerated_worst_node
                                : k_tolerated_displacement);
    look("stress error", "", measure.stress_error, limits.stress, 2, k_tolerated);
  }
  look("coherent skin", "", measure.skin_change, limits.skin, 1, k_tolerated);
  if (limits.opening > 0) look("opening skin", " m", measure.skin_opening, limits.opening, 1, k_tolerated);
  look("solid fraction", "", measure.solid_fraction_change, limits.solid_fraction, 1, k_tolerated);
  return result;
}

double longest_before_solid(double melt, double elapsed, double least) {
  constexpr double k_most_melt = 0.2, k_of_what_is_left = 0.5;
  if (!(melt > 0) || melt >= k_most_melt || !(elapsed > 0)) return std::numeric_limits<double>::infinity();
  return std::max(k_of_what_is_left * melt, least) * elapsed;
}

}  // namespace solidus::coupling
