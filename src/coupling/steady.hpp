/// The steady state of heat and deformation: what a step of no end would find.
///
///   conduction(Θ, gaps of u) − sources = 0,     ∫ B̄ᵀ σ(ε(u), Θ) dV − f + contact = 0
///
/// Nothing changes any more, so deformation exchanges no heat, interfaces store none and friction makes none.
/// Heat and deformation meet where the conductance of a contact follows its gap or pressure, and in the
/// properties that follow the temperature. Both are solved in alternation, the temperature that the
/// mechanical phase sees relaxed by Aitken's factor (relaxation.hpp), until they agree.
///
/// Loads and temperatures act at once on the bodies as they are at the start, free of stress at their initial
/// temperatures. Plastic flow is one step of the return mapping. What flows with time has done so: the step
/// is k_long, in which overstress decays and melt carries pressure alone.
#pragma once

#include "coupling/phases.hpp"

namespace solidus::coupling {

/// [s]
inline constexpr double k_long = 1e12;

struct SteadyOptions {
  double tolerance =
      1e-8;  ///< of an iteration's change, as a share of what the temperatures have changed in all
  int max_iterations = 200;
};

/// Solves for the conditions of t = 0 from `initial`. With heat or mechanics alone one iteration is all. The
/// heat of the report is that of one second. Throws StepRejected on all processes. Collective.
/// @param phases  without structural heat and inertia
StepEffort solve_steady(const Phases& phases, const State& initial, State& steady,
                        const SteadyOptions& options = {});

}  // namespace solidus::coupling
