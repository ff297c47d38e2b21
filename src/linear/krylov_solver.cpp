/// Set-up and solve of PETSc's FGMRES with factors that may belong to an older matrix.
#include "linear/krylov_solver.hpp"

#include <petscksp.h>

#include <algorithm>
#include <utility>

#include "linear/factorisation.hpp"
#include "linear/interruption.hpp"
#include "parallel/petsc_options.hpp"
#include "parallel/petsc_vectors.hpp"
#include "system/free_memory.hpp"
#include "system/profile.hpp"

namespace solidus::linear {

namespace {

constexpr int k_restart = 200;          ///< directions that FGMRES keeps; memory is taken as they come
constexpr int k_saddle_workspace = 60;  ///< MUMPS ICNTL(14), per cent: pivots of a saddle point move

}  // namespace

struct KrylovSolver::Implementation {
  KrylovOptions options;
  petsc::KspHandle ksp;
  petsc::VecHandle b, x;
  Mat op = nullptr, preconditioner = nullptr;
  bool stale = true;  ///< the preconditioner is set up at the next solve
  Factorisation factorisation{k_saddle_workspace};
  double seconds_setup = 0, seconds_solve = 0;

  void create();
  KSPConvergedReason run(int& iterations);
  bool try_again();
};

void KrylovSolver::Implementation::create() {
  // Flexible GMRES, preconditioned from the right, so that its norm is that of the true residual; directions
  // are orthogonalised a second time where rounding asks for it.
  petsc::make_scalar_products_reproducible();
  petsc::check(KSPCreate(PETSC_COMM_WORLD, ksp.out()), "KSPCreate");
  petsc::check(KSPSetOptionsPrefix(ksp, options.prefix.c_str()), "KSPSetOptionsPrefix");
  petsc::check(KSPSetErrorIfNotConverged(ksp, PETSC_FALSE), "KSPSetErrorIfNotConverged");
  petsc::check(KSPSetType(ksp, KSPFGMRES), "KSPSetType");
  petsc::check(KSPGMRESSetRestart(ksp, k_restart), "KSPGMRESSetRestart");
  petsc::check(KSPSetPCSide(ksp, PC_RIGHT), "KSPSetPCSide");
  petsc::check(KSPGMRESSetCGSRefinementType(ksp, KSP_GMRES_CGS_REFINE_IFNEEDED),
               "KSPGMRESSetCGSRefinementType");
  petsc::check(KSPSetNormType(ksp, KSP_NORM_UNPRECONDITIONED), "KSPSetNormType");
  watch_for_interruption(ksp);
  // The preconditioner is a factorisation of the given matrix, of the kind that its symmetry allows.
  PC pc = nullptr;
  petsc::check(KSPGetPC(ksp, &pc), "KSPGetPC");
  PetscInt n_unknowns = 0;
  petsc::check(MatGetSize(preconditioner, &n_unknowns, nullptr), "MatGetSize");
  factorisation.set_type(pc, options.prefix, options.symmetric, n_unknowns);
  petsc::check(KSPSetFromOptions(ksp), "KSPSetFromOptions");
  petsc::check(MatCreateVecs(preconditioner, x.out(), b.out()), "MatCreateVecs");
}

KSPConvergedReason KrylovSolver::Implementation::run(int& iterations) {
  // Set-up and solve are timed apart, and a signal is looked for around them. What the factorisation frees
  // stays with the program, since the next one takes it again.
  check_interruption();
  PetscLogDouble t0 = 0, t1 = 0, t2 = 0;
  PetscTime(&t0);
  {
    const profile::Part set_up("solver set-up");
    const FreedArraysStay for_the_next_factors;
    petsc::check(KSPSetReusePreconditioner(ksp, stale ? PETSC_FALSE : PETSC_TRUE),
                 "KSPSetReusePreconditioner");
    petsc::check(KSPSetUp(ksp), "KSPSetUp");
  }
  PetscTime(&t1);
  {
    const profile::Part solving("solve");
    petsc::check(KSPSolve(ksp, b, x), "KSPSolve");
  }
  check_interruption();
  PetscTime(&t2);
  seconds_setup += t1 - t0;
  seconds_solve += t2 - t1;
  PetscInt n = 0;
  petsc::check(KSPGetIterationNumber(ksp, &n), "KSPGetIterationNumber");
  iterations += static_cast<int>(n);
  KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
  petsc::check(KSPGetConvergedReason(ksp, &reason), "KSPGetConvergedReason");
  return reason;
}

bool KrylovSolver::Implementation::try_again() {
  stale = true;
  return factorisation.try_again(ksp, preconditioner);
}

KrylovSolver::KrylovSolver(KrylovOptions options) : implementation_(std::make_unique<Implementation>()) {
  implementation_->options = std::move(options);
}

KrylovSolver::~KrylovSolver() = default;

void KrylovSolver::set(Mat op, Mat preconditioner) {
  Implementation& my = *implementation_;
  if (my.preconditioner != preconditioner) {
    petsc::check(MatSetOption(preconditioner, MAT_SYMMETRIC, my.options.symmetric ? PETSC_TRUE : PETSC_FALSE),
                 "MatSetOption");
    petsc::check(MatSetOption(preconditioner, MAT_SYMMETRY_ETERNAL, PETSC_TRUE), "MatSetOption");
  }
  my.op = op;
  my.preconditioner = preconditioner;
  if (!my.ksp) my.create();
  petsc::check(KSPSetOperators(my.ksp, op, preconditioner), "KSPSetOperators");
  my.stale = true;
}

void KrylovSolver::set_operator(Mat op) {
  Implementation& my = *implementation_;
  my.op = op;
  petsc::check(KSPSetOperators(my.ksp, op, my.preconditioner), "KSPSetOperators");
}

LinearReport KrylovSolver::solve(std::span<const double> b, std::span<double> x, double relative,
                                 double absolute, int at_most) {
  Implementation& my = *implementation_;
  if (!my.ksp) return {0, false, "no factorisation"};
  // Tolerances change from call to call, as Newton's iteration asks for them.
  petsc::check(KSPSetTolerances(my.ksp, relative, absolute, PETSC_DEFAULT,
                                at_most > 0 ? at_most : my.options.max_iterations),
               "KSPSetTolerances");
  petsc::put(b, my.b);

  LinearReport report;
  // A factorisation that runs out of its work space is tried again with more.
  KSPConvergedReason reason = my.run(report.iterations);
  my.factorisation.begin();
  while (reason == KSP_DIVERGED_PC_FAILED && my.try_again()) reason = my.run(report.iterations);
  my.stale = false;
  report.converged = reason > 0;
  if (!report.converged) report.reason = KSPConvergedReasons[reason];
  // MUMPS's own message says more than PETSc's.
  if (reason == KSP_DIVERGED_PC_FAILED) report.reason = my.factorisation.failure(my.preconditioner);
  petsc::get(my.x, x);
  // MUMPS refuses the next factorisation once one has met a singular matrix.
  if (reason == KSP_DIVERGED_PC_FAILED) reset();
  return report;
}

void KrylovSolver::multiply(std::span<const double> x, std::span<double> y) {
  Implementation& my = *implementation_;
  petsc::put(x, my.x);
  petsc::check(MatMult(my.op, my.x, my.b), "MatMult");
  petsc::get(my.b, y);
}

void KrylovSolver::reset() {
  Implementation& my = *implementation_;
  my.ksp.reset();
  my.op = my.preconditioner = nullptr;
  my.stale = true;
}

double KrylovSolver::seconds_setup() const {
  return implementation_->seconds_setup;
}
double KrylovSolver::seconds_solve() const {
  return implementation_->seconds_solve;
}

}  // namespace solidus::linear
