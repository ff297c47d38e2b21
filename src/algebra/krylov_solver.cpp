#include "algebra/krylov_solver.hpp"

#include <petsc/private/petscimpl.h>

#include <algorithm>
#include <utility>

#include "algebra/petsc_handles.hpp"

namespace solidus::algebra {

namespace {

constexpr int k_restart = 60;            ///< directions that FGMRES keeps
constexpr int k_workspace_attempts = 3;  ///< MUMPS runs with more workspace each time
constexpr int k_first_workspace = 60;    ///< MUMPS ICNTL(14), per cent: pivots of a saddle point move

void set_default_option(const std::string& name, const char* value) {
  const std::string key = "-" + name;
  PetscBool given = PETSC_FALSE;
  check(PetscOptionsHasName(nullptr, nullptr, key.c_str(), &given), "PetscOptionsHasName");
  if (!given) check(PetscOptionsSetValue(nullptr, key.c_str(), value), "PetscOptionsSetValue");
}

void put(std::span<const double> from, Vec to) {
  double* values = nullptr;
  check(VecGetArrayWrite(to, &values), "VecGetArrayWrite");
  std::copy(from.begin(), from.end(), values);
  check(VecRestoreArrayWrite(to, &values), "VecRestoreArrayWrite");
}

void get(Vec from, std::span<double> to) {
  const double* values = nullptr;
  check(VecGetArrayRead(from, &values), "VecGetArrayRead");
  std::copy_n(values, to.size(), to.data());
  check(VecRestoreArrayRead(from, &values), "VecRestoreArrayRead");
}

}  // namespace

struct KrylovSolver::Implementation {
  KrylovOptions options;
  KspHandle ksp;
  VecHandle b, x;
  NullSpaceHandle near_null_space;
  Mat op = nullptr, preconditioner = nullptr, schur = nullptr;
  bool stale = true;  ///< the preconditioner is set up at the next solve
  int workspace = k_first_workspace;
  double seconds_setup = 0, seconds_solve = 0;

  void create();
  void split(PC pc);
  KSPConvergedReason run(int& iterations);
  bool grow_workspace();
};

/// Block triangular: the Schur complement is −(C + B' A⁻¹ B), and `schur` stands for it.
void KrylovSolver::Implementation::split(PC pc) {
  IS rows[2] = {nullptr, nullptr};
  check(MatNestGetISs(preconditioner, rows, nullptr), "MatNestGetISs");
  check(PCSetType(pc, PCFIELDSPLIT), "PCSetType");
  check(PCFieldSplitSetIS(pc, "u", rows[0]), "PCFieldSplitSetIS");
  check(PCFieldSplitSetIS(pc, "p", rows[1]), "PCFieldSplitSetIS");
  check(PCFieldSplitSetType(pc, PC_COMPOSITE_SCHUR), "PCFieldSplitSetType");
  check(PCFieldSplitSetSchurFactType(pc, PC_FIELDSPLIT_SCHUR_FACT_UPPER), "PCFieldSplitSetSchurFactType");
  check(PCFieldSplitSetSchurPre(pc, PC_FIELDSPLIT_SCHUR_PRE_USER, schur), "PCFieldSplitSetSchurPre");
  set_default_option(options.prefix + "fieldsplit_u_ksp_type", KSPPREONLY);
  set_default_option(options.prefix + "fieldsplit_u_pc_type", PCGAMG);
  set_default_option(options.prefix + "fieldsplit_p_ksp_type", KSPPREONLY);
  set_default_option(options.prefix + "fieldsplit_p_pc_type", PCBJACOBI);
  set_default_option(options.prefix + "fieldsplit_p_sub_pc_type", PCILU);
  if (!near_null_space) return;
  Mat first = nullptr;
  check(MatNestGetSubMat(preconditioner, 0, 0, &first), "MatNestGetSubMat");
  check(MatSetNearNullSpace(first, near_null_space), "MatSetNearNullSpace");
}

void KrylovSolver::Implementation::create() {
  check(KSPCreate(PETSC_COMM_WORLD, ksp.out()), "KSPCreate");
  check(KSPSetOptionsPrefix(ksp, options.prefix.c_str()), "KSPSetOptionsPrefix");
  check(KSPSetErrorIfNotConverged(ksp, PETSC_FALSE), "KSPSetErrorIfNotConverged");
  check(KSPSetType(ksp, options.definite ? KSPCG : KSPFGMRES), "KSPSetType");
  if (!options.definite) {
    check(KSPGMRESSetRestart(ksp, k_restart), "KSPGMRESSetRestart");
    check(KSPSetPCSide(ksp, PC_RIGHT), "KSPSetPCSide");
  }
  check(KSPSetNormType(ksp, KSP_NORM_UNPRECONDITIONED), "KSPSetNormType");
  PC pc = nullptr;
  check(KSPGetPC(ksp, &pc), "KSPGetPC");
  switch (options.preconditioner) {
    case Preconditioner::factorisation:
      check(PCSetType(pc, options.symmetric ? PCCHOLESKY : PCLU), "PCSetType");
      check(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS), "PCFactorSetMatSolverType");
      set_default_option(options.prefix + "mat_mumps_icntl_14", std::to_string(k_first_workspace).c_str());
      break;
    case Preconditioner::multigrid:
      check(PCSetType(pc, PCGAMG), "PCSetType");
      break;
    case Preconditioner::saddle:
      split(pc);
      break;
  }
  check(KSPSetFromOptions(ksp), "KSPSetFromOptions");
  check(MatCreateVecs(preconditioner, x.out(), b.out()), "MatCreateVecs");
}

KSPConvergedReason KrylovSolver::Implementation::run(int& iterations) {
  PetscLogDouble t0 = 0, t1 = 0, t2 = 0;
  PetscTime(&t0);
  check(KSPSetReusePreconditioner(ksp, stale ? PETSC_FALSE : PETSC_TRUE), "KSPSetReusePreconditioner");
  check(KSPSetUp(ksp), "KSPSetUp");
  PetscTime(&t1);
  check(KSPSolve(ksp, b, x), "KSPSolve");
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

/// MUMPS may need more workspace than its analysis foresaw: pivoting is not known beforehand.
bool KrylovSolver::Implementation::grow_workspace() {
  PC pc = nullptr;
  PCFailedReason why = PC_NOERROR;
  check(KSPGetPC(ksp, &pc), "KSPGetPC");
  check(PCGetFailedReason(pc, &why), "PCGetFailedReason");
  if (why != PC_FACTOR_OUTMEMORY && why != PC_FACTOR_OTHER) return false;
  Mat factor = nullptr;
  check(PCFactorGetMatrix(pc, &factor), "PCFactorGetMatrix");
  workspace *= 3;
  check(MatMumpsSetIcntl(factor, 14, workspace), "MatMumpsSetIcntl");
  check(PetscObjectStateIncrease(reinterpret_cast<PetscObject>(preconditioner)), "PetscObjectStateIncrease");
  return true;
}

KrylovSolver::KrylovSolver(KrylovOptions options) : implementation_(std::make_unique<Implementation>()) {
  implementation_->options = std::move(options);
}

KrylovSolver::~KrylovSolver() = default;

void KrylovSolver::use_rigid_body_modes(const mesh::Mesh& mesh, int components) {
  VecHandle coordinates;
  check(VecCreate(PETSC_COMM_WORLD, coordinates.out()), "VecCreate");
  check(VecSetBlockSize(coordinates, components), "VecSetBlockSize");
  check(VecSetSizes(coordinates, static_cast<PetscInt>(mesh.n_owned_nodes * components), PETSC_DETERMINE),
        "VecSetSizes");
  check(VecSetType(coordinates, VECSTANDARD), "VecSetType");
  double* values = nullptr;
  check(VecGetArray(coordinates, &values), "VecGetArray");
  for (Index node = 0; node < mesh.n_owned_nodes; ++node)
    for (int i = 0; i < components; ++i)
      values[node * components + i] = mesh.x[static_cast<std::size_t>(node)][static_cast<std::size_t>(i)];
  check(VecRestoreArray(coordinates, &values), "VecRestoreArray");
  check(MatNullSpaceCreateRigidBody(coordinates, implementation_->near_null_space.out()),
        "MatNullSpaceCreateRigidBody");
}

void KrylovSolver::set(Mat op, Mat preconditioner, Mat schur) {
  Implementation& my = *implementation_;
  if (my.preconditioner != preconditioner) {
    check(MatSetOption(preconditioner, MAT_SYMMETRIC, my.options.symmetric ? PETSC_TRUE : PETSC_FALSE),
          "MatSetOption");
    check(MatSetOption(preconditioner, MAT_SYMMETRY_ETERNAL, PETSC_TRUE), "MatSetOption");
  }
  my.op = op;
  my.preconditioner = preconditioner;
  my.schur = schur;
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
  for (int attempt = 1; reason == KSP_DIVERGED_PC_FAILED && attempt < k_workspace_attempts; ++attempt) {
    if (my.options.preconditioner != Preconditioner::factorisation || !my.grow_workspace()) break;
    reason = my.run(report.iterations);
  }
  my.stale = false;
  report.converged = reason > 0;
  if (!report.converged) report.reason = KSPConvergedReasons[reason];
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
  my.op = my.preconditioner = my.schur = nullptr;
  my.stale = true;
}

double KrylovSolver::seconds_setup() const {
  return implementation_->seconds_setup;
}
double KrylovSolver::seconds_solve() const {
  return implementation_->seconds_solve;
}

}  // namespace solidus::algebra
