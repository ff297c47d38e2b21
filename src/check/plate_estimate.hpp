/// Freezing times of plates in the mould of a casting, for the map of moduli (criteria/plate_times.hpp).
#pragma once

#include "check/freezing_estimate.hpp"
#include "criteria/plate_times.hpp"

namespace solidus::check {

/// Plates from an eighth of the modulus of a casting to eight times as much, each behind the same thickness
/// of the same moulds and with the same films as the casting, in equal shares of its skin. Sizes that never
/// freeze are left out. Takes some tens of milliseconds. No MPI.
criteria::PlateTimes plate_times(const FreezingProblem& casting);

}  // namespace solidus::check
