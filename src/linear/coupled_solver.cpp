/// Small systems are factorised as a whole; larger ones are split by fields, with multigrid on the
/// displacements.
#include "linear/coupled_solver.hpp"

#include <petscmat.h>

#include <algorithm>

#include "linear/automatic_solver.hpp"
#include "parallel/petsc_handles.hpp"

namespace solidus::linear {

struct CoupledSolver::Petsc {
  petsc::MatHandle assembled;  ///< the nest as one matrix, for the direct solver
};

CoupledSolver::CoupledSolver(const mesh::Mesh& mesh, int components, CoupledSolverKind kind,
                             double relative_tolerance)
    : direct_(factorises_coupled(kind, {mesh.dimension, mesh.n_global_nodes * (components + 1)}, false)),
      solver_(mesh, {.prefix = "coupled_",
                     .kind = direct_ ? SolverKind::direct : SolverKind::field_split,
                     .symmetric = false,
                     .relative_tolerance = relative_tolerance}),
      petsc_(std::make_unique<Petsc>()) {
  if (!direct_) solver_.use_rigid_body_modes(components);
}

CoupledSolver::~CoupledSolver() = default;

LinearReport CoupledSolver::solve(CoupledMatrix& a, std::span<const double> force,
                                  std::span<const double> heat, FieldWeights weights, std::span<double> u,
                                  std::span<double> temperature, double forcing) {
  // Both fields are scaled by their weights, so that one tolerance holds for the whole residual.
  weights_ = in_use(weights);
  Mat matrix = a.matrix(weights_.force, weights_.heat);
  // A direct solver needs one assembled matrix, whose pattern is kept from call to call; an iterative one
  // works on the blocks as they are.
  if (direct_) {
    const MatReuse reuse = petsc_->assembled ? MAT_REUSE_MATRIX : MAT_INITIAL_MATRIX;
    Mat assembled = petsc_->assembled;
    petsc::check(
        MatConvert(matrix, MATAIJ, reuse, reuse == MAT_REUSE_MATRIX ? &assembled : petsc_->assembled.out()),
        "MatConvert");
    matrix = petsc_->assembled;
  } else {
    solver_.use_blocks_of_first_field(a.displacement(), weights_.force);
  }
  right_.resize(force.size() + heat.size());
  solution_.resize(right_.size());
  const auto middle = static_cast<std::ptrdiff_t>(force.size());
  // The right-hand side is scaled in the same way; the solution needs no scaling back, because columns are
  // not scaled.
  std::transform(force.begin(), force.end(), right_.begin(), [&](double r) { return weights_.force * r; });
  std::transform(heat.begin(), heat.end(), right_.begin() + middle,
                 [&](double r) { return weights_.heat * r; });
  LinearReport report = solver_.solve(matrix, right_, solution_, forcing);
  std::copy(solution_.begin(), solution_.begin() + middle, u.begin());
  std::copy(solution_.begin() + middle, solution_.end(), temperature.begin());
  return report;
}

FieldWeights CoupledSolver::in_use(FieldWeights weights) const {
  // A preconditioner that stays must not see the rows change their scale.
  return direct_ || solver_.stale() ? weights : weights_;
}

void CoupledSolver::forget() {
  solver_.forget();
}

void CoupledSolver::reset() {
  solver_.reset();
  petsc_->assembled.reset();
}

double CoupledSolver::seconds() const {
  return solver_.seconds().sum();
}

}  // namespace solidus::linear
