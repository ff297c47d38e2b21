#include "linear/linear_solver_implementation.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "linear/automatic_solver.hpp"
#include "linear/interruption.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/petsc_options.hpp"
#include "system/free_memory.hpp"
#include "system/processes.hpp"
#include "system/profile.hpp"

namespace solidus::linear {

namespace {

/// Iterations after which a factorisation takes over where it may (factors_rescue_field).
constexpr int k_patience = 400;
constexpr double k_refine_above =
    1e-8;  ///< residual of a direct solve relative to b: above it one step of refinement
constexpr double k_refuse_above = 1e-2;     ///< after refinement: Newton cannot work with such a direction
constexpr int k_field_split_restart = 100;  ///< directions that FGMRES keeps
/// A hierarchy is made again, which costs as much as twenty iterations or more, where a solve takes half as
/// many again as the first one with it and more than a few.
constexpr double k_slower = 0.5, k_more_iterations = 5;

SolverKind kind_for(const LinearSolverOptions& options, const mesh::Mesh& mesh, int components,
                    bool of_blocks) {
  return solver_of_field(options.kind, {mesh.dimension, mesh.n_global_nodes * components},
                         options.transient_heat, of_blocks);
}

/// z = ours.apply(r)
template <class Ours>
void set_preconditioner(PC pc, Ours& ours) {
  petsc::check(PCSetType(pc, PCSHELL), "PCSetType");
  petsc::check(PCShellSetContext(pc, &ours), "PCShellSetContext");
  const auto apply = [](PC of, Vec in, Vec out) -> PetscErrorCode {
    Ours* preconditioner = nullptr;
    petsc::check(PCShellGetContext(of, static_cast<void*>(&preconditioner)), "PCShellGetContext");
    const ReadArray from(in);
    const WriteArray to(out);
    preconditioner->apply(from.values(), to.values());
    return 0;
  };
  petsc::check(PCShellSetApply(pc, apply), "PCShellSetApply");
}

/// The coarse matrices of GAMG. By default PETSc adds up what other processes have for them in the order in
/// which their messages arrive, so that no two runs on three processes have the same bits; this product of
/// three matrices takes them in a fixed order, and several times as long. Of one other process there is but
/// one message.
void make_gamg_reproducible() {
  int n_processes = 1;
  MPI_Comm_size(PETSC_COMM_WORLD, &n_processes);
  if (n_processes > 2) petsc::set_default_option("matptap_via", "allatonce");
}

/// Rigid-body modes for PETSc's own multigrid.
petsc::NullSpaceHandle petsc_rigid_body_modes(const mesh::Mesh& mesh, int components) {
  petsc::make_scalar_products_reproducible();
  petsc::VecHandle coordinates;
  petsc::check(VecCreate(PETSC_COMM_WORLD, coordinates.out()), "VecCreate");
  petsc::check(VecSetBlockSize(coordinates, components), "VecSetBlockSize");
  petsc::check(
      VecSetSizes(coordinates, static_cast<PetscInt>(mesh.n_owned_nodes * components), PETSC_DETERMINE),
      "VecSetSizes");
  petsc::check(VecSetType(coordinates, VECSTANDARD), "VecSetType");
  double* values = nullptr;
  petsc::check(VecGetArray(coordinates, &values), "VecGetArray");
  for (Index node = 0; node < mesh.n_owned_nodes; ++node)
    for (int i = 0; i < components; ++i) values[node * components + i] = mesh.x[as_size(node)][as_size(i)];
  petsc::check(VecRestoreArray(coordinates, &values), "VecRestoreArray");
  petsc::NullSpaceHandle modes;
  petsc::check(MatNullSpaceCreateRigidBody(coordinates, modes.out()), "MatNullSpaceCreateRigidBody");
  return modes;
}

}  // namespace

/// Whether the preconditioner is ours: not where the user asks PETSc for one, and not for tied unknowns.
bool is_ours(const LinearSolverOptions& options, const mesh::Mesh& mesh, int block_size, int modes) {
  return kind_for(options, mesh, block_size, true) == SolverKind::multigrid &&
         BlockMultigrid::supports(block_size, modes) && !petsc::user_gave_option(options.prefix + "pc_type");
}

/// The same of incomplete factors.
bool is_our_factor(const LinearSolverOptions& options, const mesh::Mesh& mesh, int block_size) {
  return kind_for(options, mesh, block_size, true) == SolverKind::incomplete && options.symmetric &&
         block_size == 1 && !petsc::user_gave_option(options.prefix + "pc_") &&
         !petsc::user_gave_option(options.prefix + "sub_");
}

bool LinearSolver::Implementation::multigrid_of_blocks(const BlockMatrix& a) const {
  const int n_modes = rigid_components > 0 ? rigid_body_mode_count(rigid_components) : a.block_size();
  return a.constraints().empty() && !petsc_multigrid && is_ours(options, mesh, a.block_size(), n_modes);
}

bool LinearSolver::Implementation::factor_of_blocks(const BlockMatrix& a) const {
  return a.constraints().empty() && a.storage() == BlockMatrix::Storage::upper &&
         is_our_factor(options, mesh, a.block_size());
}

/// Whether conjugate gradients are ours, too: not where the user asks PETSc for something of a Krylov solver.
bool LinearSolver::Implementation::gradients_of_blocks() const {
  return !petsc::user_gave_option(options.prefix + "ksp_");
}

LinearReport LinearSolver::Implementation::solve_by_gradients(std::span<const double> right,
                                                              std::span<double> solution, double forcing) {
  check_interruption();
  const double start = processes::wall_time();
  if (stale) {
    const profile::Part set_up("solver set-up");
    incomplete->set_up(*blocks, fill);
    stale = false;
  }
  const double ready = processes::wall_time();
  const profile::Part solving("solve");
  LinearReport report = gradients->solve(right, solution, std::max(forcing, options.relative_tolerance),
                                         options.max_iterations);
  seconds_setup += ready - start;
  seconds_solve += processes::wall_time() - ready;
  return report;
}

bool LinearSolver::Implementation::factorisation_serves(const BlockMatrix& a) const {
  return factors_rescue_field(options.kind, mesh.n_global_nodes * a.block_size());
}

void LinearSolver::Implementation::create_shell(BlockMatrix& a) {
  // The matrix is given to PETSc as a shell: it only multiplies, by our own product on the blocks, and keeps
  // no copy.
  if (blocks == &a && shell) return;
  blocks = &a;
  if (!ghosts) ghosts.emplace(mesh);
  const auto n = static_cast<PetscInt>(mesh.n_owned_nodes * a.block_size());
  local.resize(as_size(mesh.n_nodes() * a.block_size()));
  petsc::check(MatCreateShell(PETSC_COMM_WORLD, n, n, PETSC_DETERMINE, PETSC_DETERMINE, this, shell.out()),
               "MatCreateShell");
  petsc::check(MatSetBlockSize(shell, a.block_size()), "MatSetBlockSize");
  const auto product = [](Mat of, Vec in, Vec out) -> PetscErrorCode {
    Implementation* my = nullptr;
    petsc::check(MatShellGetContext(of, static_cast<void*>(&my)), "MatShellGetContext");
    my->multiply(in, out);
    return 0;
  };
  PetscErrorCode (*const function)(Mat, Vec, Vec) = product;
  petsc::check(MatShellSetOperation(shell, MATOP_MULT, reinterpret_cast<void (*)()>(function)),
               "MatShellSetOperation");
}

void LinearSolver::Implementation::multiply(Vec in, Vec out) {
  const ReadArray from(in);
  const WriteArray to(out);
  std::copy(from.values().begin(), from.values().end(), local.begin());
  ghosts->update(local, blocks->block_size());
  blocks->multiply_free(local, to.values());
}

void LinearSolver::Implementation::attach_modes(Mat a) const {
  if (rigid_components == 0 || multigrid) return;
  const petsc::NullSpaceHandle near_null_space = petsc_rigid_body_modes(mesh, rigid_components);
  Mat of_modes = a;
  if (kind == SolverKind::field_split) petsc::check(MatNestGetSubMat(a, 0, 0, &of_modes), "MatNestGetSubMat");
  petsc::check(MatSetNearNullSpace(of_modes, near_null_space), "MatSetNearNullSpace");
}

void LinearSolver::Implementation::set_method(Mat a, PC pc) {
  PetscInt n_unknowns = 0;
  const KSPType krylov = options.symmetric ? KSPCG : KSPGMRES;
  // The solver within a block of Jacobi's preconditioner does not exist before its set-up, but its options
  // do.
  const auto set_sub_default = [&](const char* key, const char* value) {
    petsc::set_default_option(options.prefix + key, value);
  };
  switch (kind) {
    case SolverKind::automatic:
    case SolverKind::direct:
      petsc::check(KSPSetType(ksp, KSPPREONLY), "KSPSetType");
      petsc::check(MatGetSize(a, &n_unknowns, nullptr), "MatGetSize");
      factorisation.set_type(pc, options.prefix, options.symmetric, n_unknowns);
      break;
    case SolverKind::multigrid:
      // The cycle rounds to single precision, so it is not exactly linear.
      petsc::check(KSPSetType(ksp, !options.symmetric && a == shell ? KSPFGMRES : krylov), "KSPSetType");
      reuse_hierarchy = true;
      if (a == shell)
        create_multigrid(pc);
      else
        petsc::check(PCSetType(pc, PCGAMG), "PCSetType");
      make_gamg_reproducible();
      break;
    case SolverKind::jacobi:
      petsc::check(KSPSetType(ksp, krylov), "KSPSetType");
      petsc::check(PCSetType(pc, PCJACOBI), "PCSetType");
      break;
    case SolverKind::incomplete:
      petsc::check(KSPSetType(ksp, krylov), "KSPSetType");
      if (a == shell) {
        create_factor(pc);
        break;
      }
      petsc::check(PCSetType(pc, PCBJACOBI), "PCSetType");
      set_sub_default("sub_pc_type", options.symmetric ? PCICC : PCILU);
      break;
    case SolverKind::field_split:
      petsc::check(KSPSetType(ksp, KSPFGMRES), "KSPSetType");
      petsc::check(KSPGMRESSetRestart(ksp, k_field_split_restart), "KSPGMRESSetRestart");
      create_split(a, pc);
      set_sub_default("fieldsplit_u_ksp_type", KSPPREONLY);
      set_sub_default("fieldsplit_temperature_ksp_type", KSPPREONLY);
      set_sub_default("fieldsplit_temperature_pc_type", PCBJACOBI);
      set_sub_default("fieldsplit_temperature_sub_pc_type", PCILU);
      reuse_hierarchy = true;
      break;
  }
}

void LinearSolver::Implementation::create(Mat a) {
  petsc::make_scalar_products_reproducible();
  PetscInt components = 0;
  petsc::check(MatGetBlockSize(a, &components), "MatGetBlockSize");
  kind = kind_for(options, mesh, static_cast<int>(components), a == shell);
  petsc::check(KSPCreate(PETSC_COMM_WORLD, ksp.out()), "KSPCreate");
  petsc::check(KSPSetOptionsPrefix(ksp, options.prefix.c_str()), "KSPSetOptionsPrefix");
  petsc::check(KSPSetErrorIfNotConverged(ksp, PETSC_FALSE), "KSPSetErrorIfNotConverged");
  petsc::check(
      KSPSetTolerances(ksp, options.relative_tolerance, PETSC_DEFAULT, PETSC_DEFAULT, options.max_iterations),
      "KSPSetTolerances");
  if (kind != SolverKind::direct) {
    petsc::check(KSPSetNormType(ksp, KSP_NORM_UNPRECONDITIONED), "KSPSetNormType");
    watch_for_interruption(ksp);
  }
  PC pc = nullptr;
  petsc::check(KSPGetPC(ksp, &pc), "KSPGetPC");
  set_method(a, pc);
  if (!options.symmetric && kind != SolverKind::direct)
    petsc::check(KSPSetPCSide(ksp, PC_RIGHT), "KSPSetPCSide");
  if (multigrid && kind == SolverKind::multigrid)
    petsc::check(KSPSetTolerances(ksp, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT,
                                  std::min(k_patience, options.max_iterations)),
                 "KSPSetTolerances");
  petsc::check(KSPSetFromOptions(ksp), "KSPSetFromOptions");
  petsc::check(KSPGetTolerances(ksp, &tightest, nullptr, nullptr, nullptr), "KSPGetTolerances");
  create_vectors(a);
  residual.reset();
}

/// Those of the shell are the caller's arrays, placed in them for each solve: 16 bytes an unknown and two
/// copies less.
void LinearSolver::Implementation::create_vectors(Mat a) {
  if (a != shell) {
    petsc::check(MatCreateVecs(a, x.out(), b.out()), "MatCreateVecs");
    return;
  }
  PetscInt block_size = 1, n = 0;
  PetscMPIInt n_processes = 1;
  MPI_Comm_size(PETSC_COMM_WORLD, &n_processes);
  petsc::check(MatGetBlockSize(a, &block_size), "MatGetBlockSize");
  petsc::check(MatGetLocalSize(a, &n, nullptr), "MatGetLocalSize");
  for (petsc::VecHandle* v : {&b, &x})
    petsc::check(n_processes == 1 ? VecCreateSeqWithArray(PETSC_COMM_WORLD, block_size, n, nullptr, v->out())
                                  : VecCreateMPIWithArray(PETSC_COMM_WORLD, block_size, n, PETSC_DETERMINE,
                                                          nullptr, v->out()),
                 "VecCreateWithArray");
}

void LinearSolver::Implementation::create_multigrid(PC pc) {
  multigrid = std::make_unique<BlockMultigrid>(
      mesh, blocks->block_size(), rigid_components > 0 ? rigid_body_modes : constants, options.symmetric);
  set_preconditioner(pc, *multigrid);
}

/// Whether multigrid of the first field is ours.
bool LinearSolver::Implementation::splits_blocks() const {
  return blocks != nullptr && !split_failed && blocks->constraints().empty() && rigid_components > 0 &&
         BlockMultigrid::supports(blocks->block_size(), rigid_body_mode_count(rigid_components)) &&
         !petsc::user_gave_option(options.prefix + "fieldsplit_u_pc_type");
}

void LinearSolver::Implementation::create_split(Mat a, PC pc) {
  IS rows[2] = {nullptr, nullptr};
  petsc::check(MatNestGetISs(a, rows, nullptr), "MatNestGetISs");
  petsc::check(PCSetType(pc, PCFIELDSPLIT), "PCSetType");
  // Temperatures first: what they do to the forces is then balanced at once, while the heat of the small
  // displacement that follows is a share δ of what they started from. The other way round the forces of
  // an unbalanced temperature, ten orders above their criterion, drown the directions in rounding.
  petsc::check(PCFieldSplitSetIS(pc, "temperature", rows[1]), "PCFieldSplitSetIS");
  petsc::check(PCFieldSplitSetIS(pc, "u", rows[0]), "PCFieldSplitSetIS");
  petsc::check(PCFieldSplitSetType(pc, PC_COMPOSITE_MULTIPLICATIVE), "PCFieldSplitSetType");
  PetscInt n_fields = 0;
  KSP* of_fields = nullptr;
  petsc::check(PCFieldSplitGetSubKSP(pc, &n_fields, &of_fields), "PCFieldSplitGetSubKSP");
  PC of_first = nullptr;
  petsc::check(KSPGetPC(of_fields[1], &of_first), "KSPGetPC");
  petsc::check(PetscFree(of_fields), "PetscFree");
  if (!splits_blocks()) {
    petsc::check(PCSetType(of_first, PCGAMG), "PCSetType");
    make_gamg_reproducible();
    return;
  }
  multigrid =
      std::make_unique<BlockMultigrid>(mesh, blocks->block_size(), rigid_body_modes, options.symmetric);
  of_first_field.multigrid = multigrid.get();
  set_preconditioner(of_first, of_first_field);
}

void LinearSolver::Implementation::create_factor(PC pc) {
  incomplete = std::make_unique<IncompleteCholesky>();
  set_preconditioner(pc, *incomplete);
}

bool LinearSolver::Implementation::is_direct() const {
  PetscBool preonly = PETSC_FALSE;
  petsc::check(
      PetscObjectTypeCompare(reinterpret_cast<PetscObject>(static_cast<KSP>(ksp)), KSPPREONLY, &preonly),
      "PetscObjectTypeCompare");
  return preonly == PETSC_TRUE;
}

void LinearSolver::Implementation::set_tolerance(double forcing) {
  petsc::check(
      KSPSetTolerances(ksp, std::max(forcing, tightest), PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT),
      "KSPSetTolerances");
}

KSPConvergedReason LinearSolver::Implementation::run(Vec rhs, Vec solution, int& iterations) {
  // A signal is looked for before and after each call that may take long; the times of set-up and solve are
  // kept apart.
  check_interruption();
  PetscLogDouble t0 = 0, t1 = 0, t2 = 0;
  PetscTime(&t0);
  {
    // First the preconditioner is set up, unless a hierarchy of earlier values serves once more. While a
    // factorisation works, what it frees stays with the program, since it takes the same arrays again.
    const profile::Part set_up("solver set-up");
    std::optional<FreedArraysStay> for_the_next_factors;
    if (is_direct()) for_the_next_factors.emplace();
    petsc::check(KSPSetReusePreconditioner(ksp, reuse_hierarchy && !stale ? PETSC_TRUE : PETSC_FALSE),
                 "KSPSetReusePreconditioner");
    petsc::check(KSPSetUp(ksp), "KSPSetUp");
    if (multigrid && stale) multigrid->set_up(*blocks);
    if (incomplete && stale) incomplete->set_up(*blocks, fill);
    if (incomplete) stale = false;
  }
  PetscTime(&t1);
  {
    // Then the Krylov method runs, in which PETSc calls the preconditioner.
    const profile::Part solving("solve");
    petsc::check(KSPSolve(ksp, rhs, solution), "KSPSolve");
  }
  check_interruption();
  PetscTime(&t2);
  seconds_setup += t1 - t0;
  seconds_solve += t2 - t1;
  // At last iterations are counted, and the hierarchy is judged by how many of them it took: one that takes
  // many more than when it was made is made again for the next system.
  PetscInt n = 0;
  petsc::check(KSPGetIterationNumber(ksp, &n), "KSPGetIterationNumber");
  iterations += static_cast<int>(n);
  KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
  petsc::check(KSPGetConvergedReason(ksp, &reason), "KSPGetConvergedReason");
  if (reuse_hierarchy) judge_hierarchy(rhs, static_cast<int>(n), reason < 0);
  return reason;
}

/// Decides whether the hierarchy serves again. Tolerances differ from solve to solve: what counts are
/// iterations per digit.
void LinearSolver::Implementation::judge_hierarchy(Vec rhs, int n, bool failed) {
  double start = 0, end = 0;
  petsc::check(VecNorm(rhs, NORM_2, &start), "VecNorm");
  petsc::check(KSPGetResidualNorm(ksp, &end), "KSPGetResidualNorm");
  const double digits = end > 0 && end < start ? std::log10(start / end) : 0;
  if (stale) first_rate = digits > 0 ? n / digits : 0;
  const double expected = first_rate * digits;
  stale = failed || n > expected + std::max(k_slower * expected, k_more_iterations);
}

/// Checks a direct solution against its residual, improves it once if needed, refuses it if that does not
/// help. Where a right-hand side is small against the products that cancel in A x, rounding leaves a residual
/// in the best of solutions; the correction is then small, while that of a singular matrix is as large as its
/// solution.
bool LinearSolver::Implementation::refine(LinearReport& report) {
  if (!residual) {
    petsc::check(VecDuplicate(b, residual.out()), "VecDuplicate");
    petsc::check(VecDuplicate(x, correction.out()), "VecDuplicate");
  }
  double size = 0, defect = 0;
  petsc::check(VecNorm(b, NORM_2, &size), "VecNorm");
  for (int pass = 0; pass < 2; ++pass) {
    petsc::check(MatMult(matrix, x, residual), "MatMult");
    petsc::check(VecAYPX(residual, -1.0, b), "VecAYPX");
    petsc::check(VecNorm(residual, NORM_2, &defect), "VecNorm");
    if (defect <= (pass == 0 ? k_refine_above : k_refuse_above) * size) return true;
    if (pass == 1 || !std::isfinite(defect)) break;
    if (run(residual, correction, report.iterations) < 0) break;
    double length = 0, change = 0;
    petsc::check(VecNorm(x, NORM_2, &length), "VecNorm");
    petsc::check(VecNorm(correction, NORM_2, &change), "VecNorm");
    petsc::check(VecAXPY(x, 1.0, correction), "VecAXPY");
    if (change <= k_refuse_above * length) return true;
  }
  report.reason = "the factorisation left a residual of " + std::to_string(defect / size) +
                  " of the right-hand side, as a singular matrix does";
  return false;
}

bool LinearSolver::Implementation::try_again() {
  return factorisation.try_again(ksp, matrix);
}

}  // namespace solidus::linear
