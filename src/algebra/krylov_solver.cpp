#include "algebra/krylov_solver.hpp"

#include <algorithm>
#include <utility>

#include "algebra/factorisation.hpp"
#include "algebra/interruption.hpp"
#include "algebra/petsc_vectors.hpp"
#include "base/profile.hpp"

namespace solidus::algebra {

namespace {

constexpr int k_restart = 200;         ///< directions that FGMRES keeps; memory is taken as they come
constexpr int k_first_workspace = 60;  ///< MUMPS ICNTL(14), per cent: pivots of a saddle point move

}  // namespace

struct KrylovSolver::Implementation {
  KrylovOptions options;
  KspHandle ksp;
  VecHandle b, x;
  Mat op = nullptr, preconditioner = nullptr;
  bool stale = true;  ///< the preconditioner is set up at the next solve
  Factorisation factorisation{k_first_workspace};
  double seconds_setup = 0, seconds_solve = 0;

  void create();
  KSPConvergedReason run(int& iterations);
  bool try_again();
};

void KrylovSolver::Implementation::create() {
  check(KSPCreate(PETSC_COMM_WORLD, ksp.out()), "KSPCreate");
  check(KSPSetOptionsPrefix(ksp, options.prefix.c_str()), "KSPSetOptionsPrefix");
  check(KSPSetErrorIfNotConverged(ksp, PETSC_FALSE), "KSPSetErrorIfNotConverged");
  check(KSPSetType(ksp, KSPFGMRES), "KSPSetType");
  check(KSPGMRESSetRestart(ksp, k_restart), "KSPGMRESSetRestart");
  check(KSPSetPCSide(ksp, PC_RIGHT), "KSPSetPCSide");
  check(KSPGMRESSetCGSRefinementType(ksp, KSP_GMRES_CGS_REFINE_IFNEEDED), "KSPGMRESSetCGSRefinementType");
  check(KSPSetNormType(ksp, KSP_NORM_UNPRECONDITIONED), "KSPSetNormType");
  watch_for_interruption(ksp);
  PC pc = nullptr;
  check(KSPGetPC(ksp, &pc), "KSPGetPC");
  PetscInt n_unknowns = 0;
  check(MatGetSize(preconditioner, &n_unknowns, nullptr), "MatGetSize");
  factorisation.set_type(pc, options.prefix, options.symmetric, n_unknowns);
  check(KSPSetFromOptions(ksp), "KSPSetFromOptions");
  check(MatCreateVecs(preconditioner, x.out(), b.out()), "MatCreateVecs");
}

KSPConvergedReason KrylovSolver::Implementation::run(int& iterations) {
  check_interruption();
  PetscLogDouble t0 = 0, t1 = 0, t2 = 0;
  PetscTime(&t0);
  {
    const profile::Part set_up("solver set-up");
    check(KSPSetReusePreconditioner(ksp, stale ? PETSC_FALSE : PETSC_TRUE), "KSPSetReusePreconditioner");
    check(KSPSetUp(ksp), "KSPSetUp");
  }
  PetscTime(&t1);
  {
    const profile::Part solving("solve");
    check(KSPSolve(ksp, b, x), "KSPSolve");
  }
  check_interruption();
  PetscTime(&t2);
  seconds_setup += t1 - t0;
  seconds_solve += t2 - t1;
  PetscInt n = 0;
  check(KSPGetIterationNumber(ksp, &n), "KSPGetIterationNumber");
  iterations += static_cast<int>(n);
  KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
  check(KSPGetConvergedReason(ksp, &reason), "KSPGetConvergedReason");
  return reason;
}

bool KrylovSolver::Implementation::try_again() {
  PC pc = nullptr;
  check(KSPGetPC(ksp, &pc), "KSPGetPC");
  return factorisation.try_again(pc, preconditioner);
}

KrylovSolver::KrylovSolver(KrylovOptions options) : implementation_(std::make_unique<Implementation>()) {
  implementation_->options = std::move(options);
}

KrylovSolver::~KrylovSolver() = default;

void KrylovSolver::set(Mat op, Mat preconditioner) {
  Implementation& my = *implementation_;
  if (my.preconditioner != preconditioner) {
    check(MatSetOption(preconditioner, MAT_SYMMETRIC, my.options.symmetric ? PETSC_TRUE : PETSC_FALSE),
          "MatSetOption");
    check(MatSetOption(preconditioner, MAT_SYMMETRY_ETERNAL, PETSC_TRUE), "MatSetOption");
  }
  my.op = op;
  my.preconditioner = preconditioner;
  if (!my.ksp) my.create();
  check(KSPSetOperators(my.ksp, op, preconditioner), "KSPSetOperators");
  my.stale = true;
}

LinearReport KrylovSolver::solve(std::span<const double> b, std::span<double> x, double relative,
                                 double absolute) {
  Implementation& my = *implementation_;
  if (!my.ksp) return {0, false, "no factorisation"};
  check(KSPSetTolerances(my.ksp, relative, absolute, PETSC_DEFAULT, my.options.max_iterations),
        "KSPSetTolerances");
  put(b, my.b);

  LinearReport report;
  KSPConvergedReason reason = my.run(report.iterations);
  my.factorisation.begin();
  while (reason == KSP_DIVERGED_PC_FAILED && my.try_again()) reason = my.run(report.iterations);
  my.stale = false;
  report.converged = reason > 0;
  if (!report.converged) report.reason = KSPConvergedReasons[reason];
  if (reason == KSP_DIVERGED_PC_FAILED) report.reason = my.factorisation.failure(my.preconditioner);
  get(my.x, x);
  // MUMPS refuses the next factorisation once one has met a singular matrix.
  if (reason == KSP_DIVERGED_PC_FAILED) reset();
  return report;
}

void KrylovSolver::multiply(std::span<const double> x, std::span<double> y) {
  Implementation& my = *implementation_;
  put(x, my.x);
  check(MatMult(my.op, my.x, my.b), "MatMult");
  get(my.b, y);
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

}  // namespace solidus::algebra
