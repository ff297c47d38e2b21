/// Whether the change of a step could be measured.
#pragma once

#include "coupling/step_limits.hpp"

namespace solidus::coupling {

/// A state whose change cannot be measured is none to go on from: throws StepRejected. The same on every
/// process.
void require_finite(const StepMeasure& measure);

}  // namespace solidus::coupling
