/// Interruption: a run that is asked to stop leaves its step, also from within a linear solver.
#pragma once

#include <exception>
#include <functional>

#include "parallel/petsc_types.hpp"

namespace solidus::linear {

/// The step under way is given up because the run was asked to stop; the committed state is whole. No failure
/// of the physics, hence no StepRejected: nothing tries again.
class Interrupted : public std::exception {
 public:
  const char* what() const noexcept override { return "stopped as asked within a step"; }
};

/// Sets the function that tells whether the run is asked to stop, on every process; an empty one ends the
/// checks. Once it returns true it must go on to do so. The loop over the steps calls the same function.
void interrupt_when(std::function<bool()> asked);

/// Throws Interrupted on every process where one of them is asked to stop. Collective.
void check_interruption();

/// Makes an iterative solver end, as not converged, in the iteration in which the run is asked to stop;
/// check_interruption() behind it then throws. Its criterion of convergence stays PETSc's default.
void watch_for_interruption(KSP ksp);

}  // namespace solidus::linear
