/// Where and why a step of the mechanical phase fails.
#pragma once

#include <span>
#include <string>

#include "system/errors.hpp"

namespace solidus::mechanics {

class MechanicalPhase;

/// Throws EquilibriumRejected on all processes, with the place that says most: the element whose law found no
/// state, with its inputs, or the node of the largest residual. Collective.
/// @param x        the unknowns at which the step has failed
/// @param failure  unless a law finds no state at x
[[noreturn]] void reject(MechanicalPhase& phase, const std::string& reason, std::span<const double> x,
                         Failure failure = Failure::equilibrium);

}  // namespace solidus::mechanics
