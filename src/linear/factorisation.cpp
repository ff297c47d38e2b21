/// Set-up and repair of a factorisation by MUMPS: a larger work space where it runs out, and the text of
/// its failures.
#include "linear/factorisation.hpp"

#include <petsc/private/petscimpl.h>
#include <petscksp.h>

#include <algorithm>
#include <cmath>

#include "parallel/parallel.hpp"
#include "parallel/petsc_handles.hpp"
#include "parallel/petsc_options.hpp"

namespace solidus::linear {

namespace {

/// Up to here every process keeps the whole: some 100 MB of factors.
constexpr GlobalIndex k_redundant_limit = 40000;
constexpr int k_attempts = 3;              ///< with three times the workspace each time
constexpr int k_largest_workspace = 5000;  ///< per cent: a failure with it is not for lack of workspace

bool is_redundant(PC pc) {
  PetscBool redundant = PETSC_FALSE;
  petsc::check(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(pc), PCREDUNDANT, &redundant),
               "PetscObjectTypeCompare");
  return redundant == PETSC_TRUE;
}

/// The factorisation itself, of all processes or of this one.
PC innermost(PC pc) {
  if (!is_redundant(pc)) return pc;
  KSP of_process = nullptr;
  PC inner = nullptr;
  petsc::check(PCRedundantGetKSP(pc, &of_process), "PCRedundantGetKSP");
  petsc::check(KSPGetPC(of_process, &inner), "KSPGetPC");
  return inner;
}

bool has_numbers(Mat matrix) {
  PetscReal size = 0;
  petsc::check(MatNorm(matrix, NORM_FROBENIUS, &size), "MatNorm");
  return std::isfinite(size);
}

}  // namespace

void Factorisation::set_type(PC pc, const std::string& prefix, bool symmetric, GlobalIndex n_unknowns) {
  int n_processes = 1;
  MPI_Comm_size(PETSC_COMM_WORLD, &n_processes);
  const bool redundant = n_processes > 1 && n_unknowns < k_redundant_limit;
  if (redundant) petsc::check(PCSetType(pc, PCREDUNDANT), "PCSetType");
  PC inner = innermost(pc);
  petsc::check(PCSetType(inner, symmetric ? PCCHOLESKY : PCLU), "PCSetType");
  petsc::check(PCFactorSetMatSolverType(inner, MATSOLVERMUMPS), "PCFactorSetMatSolverType");
  const std::string mumps = prefix + (redundant ? "redundant_" : "") + "mat_mumps_";
  option_ = mumps + "icntl_14";
  petsc::set_default_option(option_, std::to_string(workspace_));
  // Rows and columns are scaled by the diagonal: the iterations by which MUMPS would make all of them equal in
  // size cost more than they save in pivots (decision 0097).
  if (symmetric) petsc::set_default_option(mumps + "icntl_8", "1");
}

bool Factorisation::try_again(KSP ksp, Mat matrix) {
  PC pc = nullptr;
  petsc::check(KSPGetPC(ksp, &pc), "KSPGetPC");
  PC inner = innermost(pc);
  PCFailedReason why = PC_NOERROR;
  petsc::check(PCGetFailedReason(inner, &why), "PCGetFailedReason");
  // If every process factorises for itself, one may lack memory that another has.
  lacks_workspace_ = parallel::any_process(why == PC_FACTOR_OUTMEMORY || why == PC_FACTOR_OTHER);
  // MUMPS reports a random error for a matrix with entries that are not numbers, lack of workspace among
  // them.
  if (!lacks_workspace_ || !has_numbers(matrix) || ++attempts_ == k_attempts) return false;
  Mat factor = nullptr;
  petsc::check(PCFactorGetMatrix(inner, &factor), "PCFactorGetMatrix");
  PetscInt present = 0;  // the user may have asked for more
  petsc::check(MatMumpsGetIcntl(factor, 14, &present), "MatMumpsGetIcntl");
  if (present >= k_largest_workspace) return false;
  workspace_ = 3 * std::max(workspace_, static_cast<int>(present));
  // PETSc never hands a failed factor to MUMPS again: the next attempt needs a new one.
  petsc::check(PetscOptionsSetValue(nullptr, ("-" + option_).c_str(), std::to_string(workspace_).c_str()),
               "PetscOptionsSetValue");
  Mat a = nullptr, p = nullptr;
  petsc::check(PCGetOperators(inner, &a, &p), "PCGetOperators");
  petsc::check(PetscObjectReference(reinterpret_cast<PetscObject>(a)), "PetscObjectReference");
  petsc::check(PetscObjectReference(reinterpret_cast<PetscObject>(p)), "PetscObjectReference");
  petsc::check(PCReset(inner), "PCReset");
  petsc::check(PCSetOperators(inner, a, p), "PCSetOperators");
  petsc::check(MatDestroy(&a), "MatDestroy");
  petsc::check(MatDestroy(&p), "MatDestroy");
  petsc::check(PetscObjectStateIncrease(reinterpret_cast<PetscObject>(matrix)), "PetscObjectStateIncrease");
  // A solver that has seen its matrices sets nothing up and hands on the failure of before.
  petsc::check(KSPGetOperators(ksp, &a, &p), "KSPGetOperators");
  petsc::check(KSPSetOperators(ksp, a, p), "KSPSetOperators");
  return true;
}

std::string Factorisation::failure(Mat matrix) const {
  if (!has_numbers(matrix)) return "the matrix has entries that are not numbers";
  if (lacks_workspace_)
    return "MUMPS lacks memory for the factors with a workspace of " + std::to_string(workspace_) +
           " per cent beyond its estimate (ICNTL(14))";
  return "the matrix is singular";
}

double foreseen_operations(Mat matrix, bool symmetric) {
  // MUMPS foresees the number of operations from the pattern alone. Matching by values is switched off,
  // because values change and the answer must not.
  petsc::check(MatSetOption(matrix, MAT_SYMMETRIC, symmetric ? PETSC_TRUE : PETSC_FALSE), "MatSetOption");
  petsc::MatHandle factor;
  petsc::check(
      MatGetFactor(matrix, MATSOLVERMUMPS, symmetric ? MAT_FACTOR_CHOLESKY : MAT_FACTOR_LU, factor.out()),
      "MatGetFactor");
  constexpr PetscInt k_matching = 6, k_compression = 12, k_none = 0, k_usual = 1;
  petsc::check(MatMumpsSetIcntl(factor, k_matching, k_none), "MatMumpsSetIcntl");
  petsc::check(MatMumpsSetIcntl(factor, k_compression, k_usual), "MatMumpsSetIcntl");
  MatFactorInfo info;
  petsc::check(MatFactorInfoInitialize(&info), "MatFactorInfoInitialize");
  petsc::check(symmetric ? MatCholeskyFactorSymbolic(factor, matrix, nullptr, &info)
                         : MatLUFactorSymbolic(factor, matrix, nullptr, nullptr, &info),
               "symbolic factorisation");
  double operations = 0;
  petsc::check(MatMumpsGetRinfog(factor, 1, &operations), "MatMumpsGetRinfog");
  return operations;
}

}  // namespace solidus::linear
