/// The face of the linear solvers: it keeps a hierarchy as long as it serves, renews it once it does not,
/// and falls back to factors.
#include "linear/linear_solver.hpp"

#include <petscksp.h>

#include <algorithm>
#include <cassert>
#include <optional>

#include "linear/linear_solver_implementation.hpp"

namespace solidus::linear {

BlockMatrix::Storage storage_for(const LinearSolverOptions& options, const mesh::Mesh& mesh, int block_size,
                                 int modes) {
  const bool half = options.symmetric &&
                    (is_ours(options, mesh, block_size, modes) || is_our_factor(options, mesh, block_size));
  return half ? BlockMatrix::Storage::upper : BlockMatrix::Storage::whole;
}

LinearSolver::LinearSolver(const mesh::Mesh& mesh, LinearSolverOptions options)
    : implementation_(std::make_unique<Implementation>(mesh, std::move(options))) {}

LinearSolver::~LinearSolver() = default;

void LinearSolver::use_rigid_body_modes(int components) {
  implementation_->rigid_components = components;
}

void LinearSolver::keep_fill(bool keep) {
  using Fill = IncompleteCholesky::Fill;
  implementation_->fill = keep ? Fill::pattern : Fill::diagonal;
}

void LinearSolver::use_blocks_of_first_field(BlockMatrix& blocks, double scale) {
  implementation_->blocks = &blocks;
  implementation_->of_first_field.scale = scale;
}

LinearReport LinearSolver::solve(BlockMatrix& a, std::span<const double> b, std::span<double> x,
                                 double forcing) {
  Implementation& my = *implementation_;
  // Blocks stored by their upper half have incomplete factors; conjugate gradients are our own unless options
  // ask PETSc for another Krylov method.
  if (my.factor_of_blocks(a)) {
    my.stale = true;
    if (my.gradients_of_blocks()) {
      if (my.blocks != &a || !my.gradients) {
        my.blocks = &a;
        my.incomplete = std::make_unique<IncompleteCholesky>();
        my.gradients = std::make_unique<ConjugateGradients>(my.mesh, a, *my.incomplete);
      }
      return my.solve_by_gradients(b, x, forcing);
    }
    my.create_shell(a);
    return solve(my.shell, b, x, forcing);
  }
  // Else by the multigrid of blocks, in single precision; matrices that it does not serve go to PETSc.
  if (!my.multigrid_of_blocks(a)) return solve(a.matrix(), b, x, forcing);
  if (my.rescue) return my.rescue->solve(a, b, x, forcing);
  my.create_shell(a);
  LinearReport report = solve(my.shell, b, x, forcing);
  if (report.converged) return report;
  // Single precision does not see a body that next to nothing holds; double precision does.
  LinearSolverOptions other = my.options;
  const bool factorise = my.factorisation_serves(a);
  other.kind = factorise ? SolverKind::direct : SolverKind::multigrid;
  my.rescue = std::make_unique<LinearSolver>(my.mesh, std::move(other));
  if (!factorise) {
    my.rescue->implementation_->petsc_multigrid = true;
    if (my.rigid_components > 0) my.rescue->use_rigid_body_modes(a.block_size());
  }
  const int spent = report.iterations;
  report = my.rescue->solve(a, b, x, forcing);
  report.iterations += spent;
  return report;
}

LinearReport LinearSolver::solve(Mat matrix, std::span<const double> b, std::span<double> x, double forcing) {
  // A matrix seen for the first time is told about its symmetry and near null space, and makes what was set
  // up before useless.
  Implementation& my = *implementation_;
  my.gradients.reset();
  if (!my.ksp) my.create(matrix);
  if (my.matrix != matrix) {
    petsc::check(MatSetOption(matrix, MAT_SYMMETRIC, my.options.symmetric ? PETSC_TRUE : PETSC_FALSE),
                 "MatSetOption");
    petsc::check(MatSetOption(matrix, MAT_SYMMETRY_ETERNAL, PETSC_TRUE), "MatSetOption");
    my.attach_modes(matrix);
    my.matrix = matrix;
    my.stale = true;
  }
  petsc::check(KSPSetOperators(my.ksp, matrix, matrix), "KSPSetOperators");
  LinearReport report = solve_again(b, x, forcing);
  if (report.converged || my.kind != SolverKind::field_split || !my.multigrid) return report;
  // A field split with our own multigrid that has not converged is tried once more with PETSc's.
  const int spent = report.iterations;
  reset();
  my.split_failed = true;
  report = solve(matrix, b, x, forcing);
  report.iterations += spent;
  return report;
}

LinearReport LinearSolver::solve_again(std::span<const double> b, std::span<double> x, double forcing) {
  Implementation& my = *implementation_;
  if (my.rescue) return my.rescue->solve_again(b, x, forcing);
  if (my.gradients) return my.solve_by_gradients(b, x, forcing);
  my.set_tolerance(forcing);
  assert(my.matrix != nullptr);
  // The shell works on the arrays given; PETSc's own matrices need copies.
  std::optional<PlacedArrays> placed;
  if (my.matrix == my.shell) {
    assert(b.data() != x.data());
    placed.emplace(my.b, b, my.x, x);
  } else {
    const WriteArray to(my.b);
    std::copy_n(b.data(), to.values().size(), to.values().data());
  }

  LinearReport report;
  const bool was_fresh = my.stale;
  // A hierarchy of an earlier matrix that fails is made again, once; a factorisation that fails is tried
  // again as long as that may help.
  KSPConvergedReason reason = my.run(my.b, my.x, report.iterations);
  if (reason < 0 && my.reuse_hierarchy && !was_fresh) reason = my.run(my.b, my.x, report.iterations);
  const bool direct = my.is_direct();
  my.factorisation.begin();
  while (direct && reason == KSP_DIVERGED_PC_FAILED && my.try_again())
    reason = my.run(my.b, my.x, report.iterations);
  report.converged = reason > 0 || (direct && reason == KSP_CONVERGED_ITERATING);
  // An exact solver refines its answer; others report why they ended.
  if (!report.converged) {
    report.reason = direct && reason == KSP_DIVERGED_PC_FAILED ? my.factorisation.failure(my.matrix)
                                                               : KSPConvergedReasons[reason];
  } else if (direct) {
    report.converged = my.refine(report);
  }
  if (!placed) {
    const ReadArray from(my.x);
    std::copy_n(from.values().data(), from.values().size(), x.data());
  }
  placed.reset();
  // MUMPS refuses the next factorisation once one has met a singular matrix: the next step gets a new one.
  if (direct && reason == KSP_DIVERGED_PC_FAILED) reset();
  return report;
}

void LinearSolver::forget() {
  // MUMPS chooses the order of elimination by the values of the first matrix that it analyses, for LU and,
  // where the diagonal is small against the rest, for LDLᵀ too. A hierarchy that is only set up again keeps
  // its interpolation and goes on with its random numbers. All of them are made again.
  if (implementation_->ksp) reset();
}

void LinearSolver::reset() {
  Implementation& my = *implementation_;
  my.ksp.reset();
  my.multigrid.reset();
  my.gradients.reset();
  my.incomplete.reset();
  my.shell.reset();
  my.rescue.reset();
  my.split_failed = false;
  my.matrix = nullptr;
  my.stale = true;
}

bool LinearSolver::stale() const {
  return implementation_->stale;
}

SolverSeconds LinearSolver::seconds() const {
  const Implementation& my = *implementation_;
  const SolverSeconds of_rescue = my.rescue ? my.rescue->seconds() : SolverSeconds{};
  return {my.seconds_setup + of_rescue.setup, my.seconds_solve + of_rescue.solve};
}

}  // namespace solidus::linear
