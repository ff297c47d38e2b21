/// An error that is not a number would let the controller take any step.
#include "coupling/finite_measure.hpp"

#include <cmath>

#include "system/errors.hpp"

namespace solidus::coupling {

void require_finite(const StepMeasure& measure) {
  if (std::isfinite(measure.temperature_error + measure.displacement_error + measure.stress_error +
                    measure.solid_fraction_change + measure.skin_change + measure.skin_opening))
    return;
  throw StepRejected("coupling: the error of the step is not a number", {}, Failure::divergence);
}

}  // namespace solidus::coupling
