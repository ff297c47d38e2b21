/// A quick solver (incomplete factors) first; once it takes too many iterations for a digit, the strong one
/// takes over until the next begin().
#include "heat/iteration/heat_solver.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace solidus::heat {

namespace {
/// Iterations of the quick solver for one digit above which the strong solver takes over.
constexpr double k_slow = 20;
constexpr int k_quick_limit = 400;  ///< iterations after which the quick solver gives up
/// Iterations of a solve from which on factors with fill save more than they cost, some eight iterations.
constexpr int k_worth_fill = 24;
}  // namespace

HeatSolver::HeatSolver(const mesh::Mesh& mesh, linear::SolverKind kind, bool symmetric,
                       double relative_tolerance)
    : mesh_(mesh),
      options_{
          .prefix = "heat_", .kind = kind, .symmetric = symmetric, .relative_tolerance = relative_tolerance} {
}

linear::BlockMatrix::Storage HeatSolver::storage_for(const mesh::Mesh& mesh, linear::SolverKind kind,
                                                     bool symmetric) {
  return linear::storage_for(
      {.prefix = "heat_", .kind = kind, .symmetric = symmetric, .transient_heat = true}, mesh, 1, 1);
}

linear::LinearSolver& HeatSolver::strong() {
  if (!strong_) strong_ = std::make_unique<linear::LinearSolver>(mesh_, options_);
  return *strong_;
}

void HeatSolver::begin(bool transient) {
  use_quick_ = transient && options_.kind == linear::SolverKind::automatic;
  fill_ = false;
  if (!use_quick_ || quick_) return;
  linear::LinearSolverOptions quick = options_;
  quick.transient_heat = true;
  quick.max_iterations = k_quick_limit;
  quick_ = std::make_unique<linear::LinearSolver>(mesh_, quick);
}

linear::LinearReport HeatSolver::solve(linear::BlockMatrix& a, std::span<const double> b, std::span<double> x,
                                       double forcing) {
  // The quick solver (incomplete factors) serves until it is slow: then a stronger one takes over for the
  // rest.
  if (!use_quick_) {
    last_ = &strong();
    return last_->solve(a, b, x, forcing);
  }
  last_ = quick_.get();
  keeps_nothing_ = a.storage() == linear::BlockMatrix::Storage::upper;  // PETSc's factors keep their pattern
  // How many iterations a digit takes decides whether it is asked again.
  quick_->keep_fill(fill_);
  linear::LinearReport report = quick_->solve(a, b, x, forcing);
  fill_ = fill_ || report.iterations > k_worth_fill;
  const double digits = -std::log10(std::max(forcing, options_.relative_tolerance));
  use_quick_ = report.converged && report.iterations <= k_slow * digits;
  if (report.converged) return report;
  // A failure costs what was spent, and the stronger solver repeats the solve.
  const int spent = report.iterations;
  last_ = &strong();
  report = last_->solve(a, b, x, forcing);
  report.iterations += spent;
  return report;
}

linear::LinearReport HeatSolver::solve_again(std::span<const double> b, std::span<double> x, double forcing) {
  assert(last_ != nullptr);
  return last_->solve_again(b, x, forcing);
}

void HeatSolver::release() {
  if (quick_ && keeps_nothing_) quick_->reset();
}

void HeatSolver::forget() {
  for (auto* solver : {quick_.get(), strong_.get()})
    if (solver) solver->forget();
}

void HeatSolver::reset() {
  for (auto* solver : {quick_.get(), strong_.get()})
    if (solver) solver->reset();
}

double HeatSolver::seconds() const {
  double total = 0;
  for (const auto* solver : {quick_.get(), strong_.get()})
    if (solver) total += solver->seconds().sum();
  return total;
}

}  // namespace solidus::heat
