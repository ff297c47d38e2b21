/// Whether to stop is asked of a function that the program sets, between iterations of the linear solvers,
/// and all processes get the same answer.
#include "linear/interruption.hpp"

#include <petscksp.h>

#include <utility>

#include "parallel/parallel.hpp"
#include "parallel/petsc_handles.hpp"

namespace solidus::linear {

namespace {

std::function<bool()>& question() {
  static std::function<bool()> asked;
  return asked;
}

bool interrupted() {
  return question() && parallel::any_process(question()());
}

// PETSc's own criterion, unless the run is asked to stop. No exception may pass through PETSc.
extern "C" PetscErrorCode converged_or_interrupted(KSP ksp, PetscInt n, PetscReal norm,
                                                   KSPConvergedReason* reason, void* context) {
  const PetscErrorCode error = KSPConvergedDefault(ksp, n, norm, reason, context);
  if (error == 0 && *reason == KSP_CONVERGED_ITERATING && interrupted()) *reason = KSP_DIVERGED_BREAKDOWN;
  return error;
}

}  // namespace

void interrupt_when(std::function<bool()> asked) {
  question() = std::move(asked);
}

void check_interruption() {
  if (interrupted()) throw Interrupted();
}

void watch_for_interruption(KSP ksp) {
  void* context = nullptr;
  petsc::check(KSPConvergedDefaultCreate(&context), "KSPConvergedDefaultCreate");
  petsc::check(KSPSetConvergenceTest(ksp, converged_or_interrupted, context, KSPConvergedDefaultDestroy),
               "KSPSetConvergenceTest");
}

}  // namespace solidus::linear
