/// Chooses between factors and iteration by the number of unknowns, keeps what either needs as long as it
/// serves, and changes to factors where an iteration fails.
#include "mechanics/solver/saddle_solver.hpp"

#include <algorithm>
#include <cmath>

#include "linear/automatic_solver.hpp"
#include "linear/factorisation.hpp"
#include "numbers/index_casts.hpp"
#include "system/profile.hpp"
#include "system/stopwatch.hpp"

namespace solidus::mechanics {

namespace {

/// With a factorisation, whatever the forcing term: a step of flexible GMRES costs a hundredth of it.
constexpr double k_direct_tolerance = 1e-8;

}  // namespace

SaddleSolver::SaddleSolver(const mesh::Mesh& mesh, linear::BlockMatrix& displacement, NodalPressure& pressure,
                           const parallel::GhostExchange& ghosts, SaddleSolverOptions options)
    : mesh_(mesh),
      displacement_(displacement),
      pressure_(pressure),
      ghosts_(ghosts),
      options_(options),
      matrix_(displacement, pressure.fields().n_fields) {
  reset();
}

SaddleSolver::~SaddleSolver() = default;

void SaddleSolver::find_unknowns() {
  unknowns_.emplace(mesh_, matrix_, pressure_.absent(), ghosts_);
  work_.right.resize(unknowns_->size());
  work_.solution.resize(unknowns_->size());
  copy_.reset();
}

std::optional<bool> SaddleSolver::prefers_factors() const {
  if (!SaddlePreconditioner::serves(displacement_)) return true;
  return linear::factorises_saddle(options_.kind, {mesh_.dimension, unknowns_->n_global()});
}

void SaddleSolver::choose() {
  if (!choice_.settled) {
    choice_.settled = true;
    const std::optional<bool> preferred = prefers_factors();
    choice_.direct = preferred ? *preferred
                               : linear::foreseen_operations(copy_.copy(mesh_, matrix_, *unknowns_),
                                                             options_.symmetric) < linear::k_cheap_factors;
  }
  if (!choice_.made) make_solver();
}

void SaddleSolver::make_solver() {
  // Either a factorisation or an iterative solver with its preconditioner is kept, never both: each needs the
  // memory of the other.
  choice_.made = true;
  hierarchy_.renew();
  factors_.forget();
  copy_.reset();
  const auto product = [this](std::span<const double> x, std::span<double> y) { multiply(x, y); };
  // Small systems are factorised; with sub-scales the factors precondition, since the projection is
  // in the product alone.
  if (choice_.direct) {
    preconditioner_.reset();  // the factors need its memory
    outer_.iterative.reset();
    outer_.factorised.emplace(
        linear::KrylovOptions{.prefix = "mechanics_mixed_", .symmetric = options_.symmetric});
    outer_.matrix =
        std::make_unique<linear::FunctionMatrix>(static_cast<std::int64_t>(unknowns_->size()), product);
    return;
  }
  outer_.factorised.reset();
  outer_.matrix.reset();
  // The preconditioner has a hierarchy for displacements and a Schur complement for pressures.
  preconditioner_.emplace(mesh_, matrix_, pressure_, ghosts_, options_.symmetric);
  outer_.iterative.emplace();
  outer_.iterative->set(product,
                        [this](std::span<const double> r, std::span<double> z) { precondition(r, z); });
}

void SaddleSolver::assemble() {
  if (matrix_.set_zero()) {
    find_unknowns();
    choice_.made = false;
  }
  for (const MixedKernel* kernel : pressure_.kernels()) kernel->add_saddle(pressure_.unit(), matrix_);
}

void SaddleSolver::multiply(std::span<const double> x, std::span<double> y) {
  const auto n_u = as_size(mesh_.n_owned_nodes * matrix_.components()),
             n_p = as_size(mesh_.n_owned_nodes * matrix_.fields());
  // Scratch of the sizes of now; bodies may have come or gone.
  work_.whole.resize(n_u + n_p);
  work_.product.resize(n_u + n_p);
  work_.local_u.resize(mesh_.x.size() * as_size(matrix_.components()));
  work_.local_p.resize(mesh_.x.size() * as_size(matrix_.fields()));
  // Unknowns are the free entries only; held ones are zero in the product.
  unknowns_->expand(x, work_.whole);
  // Both parts with their ghosts, the product, and the projection of the stabilisation.
  std::copy_n(work_.whole.begin(), n_u, work_.local_u.begin());
  std::copy_n(work_.whole.begin() + static_cast<std::ptrdiff_t>(n_u), n_p, work_.local_p.begin());
  ghosts_.update(work_.local_u, matrix_.components());
  ghosts_.update(work_.local_p, matrix_.fields());
  const std::span<double> of_u = std::span(work_.product).first(n_u),
                          of_p = std::span(work_.product).subspan(n_u);
  matrix_.multiply(work_.local_u, work_.local_p, of_u, of_p);
  add_projection(pressure_, std::span<const double>(work_.whole).subspan(n_u), 1.0, of_p);
  unknowns_->restrict_to(work_.product, y);
}

void SaddleSolver::precondition(std::span<const double> r, std::span<double> z) {
  work_.whole.resize(as_size(mesh_.n_owned_nodes * (matrix_.components() + matrix_.fields())));
  work_.product.resize(work_.whole.size());
  unknowns_->expand(r, work_.whole);
  preconditioner_->apply(work_.whole, work_.product);
  unknowns_->restrict_to(work_.product, z);
}

linear::LinearReport SaddleSolver::solve(linear::BlockMatrix&, std::span<const double> b, std::span<double> x,
                                         double forcing) {
  linear::LinearReport report = solve_with_old_factors(b, forcing);
  if (report.converged) {
    expand_solution(x);
    return report;
  }
  const int spent = report.iterations;
  set_up();
  report = solve_again(b, x, forcing);
  report.iterations += spent;
  return report;
}

linear::LinearReport SaddleSolver::solve_with_old_factors(std::span<const double> b, double forcing) {
  linear::LinearReport report;
  report.converged = false;
  if (choice_.made && !choice_.direct) return report;
  // The size of the right-hand side is noted by every solve, the first after forget() too: what follows it
  // must not depend on what was before.
  double square = 0;
  for (const double value : b) square += value * value;
  const bool may_serve = factors_.may_serve(std::sqrt(parallel::global_sum(square)));
  if (!may_serve || !choice_.made || !choice_.direct) return report;
  // The operator is the tangent of now, by its blocks, so that it need not be copied for PETSc.
  factors_.keep();
  outer_.factorised->set_operator(outer_.matrix->matrix());
  restrict_right(b);
  const Stopwatch watch(seconds_.solve);
  return outer_.factorised->solve(work_.right, work_.solution, std::max(forcing, options_.relative_tolerance),
                                  0, linear::FactorAge::patience(mesh_.dimension));
}

void SaddleSolver::restrict_right(std::span<const double> b) {
  // From the monotone form to the symmetric one.
  std::vector<double> whole(b.begin(), b.end());
  const auto n_u = as_size(mesh_.n_owned_nodes * matrix_.components());
  for (std::size_t i = n_u; i < whole.size(); ++i) whole[i] = -whole[i];
  unknowns_->restrict_to(whole, work_.right);
}

void SaddleSolver::expand_solution(std::span<double> x) {
  unknowns_->expand(work_.solution, x);
}

void SaddleSolver::set_up() {
  const profile::Part part("solver set-up");
  const Stopwatch watch(seconds_.setup);
  choose();
  if (choice_.direct) {
    // The assembled matrix holds displacements and pressures of the free entries.
    Mat assembled = copy_.copy(mesh_, matrix_, *unknowns_);
    outer_.factorised->set(pressure_.projection() != nullptr ? outer_.matrix->matrix() : assembled,
                           assembled);
    factors_.renew();
    return;
  }
  // Both factors go together: moduli that are not of now cost no iterations as long as the hierarchy serves.
  if (hierarchy_.stale_for(displacement_)) {
    preconditioner_->set_up_schur();
    preconditioner_->set_up_displacement();
    hierarchy_.made_for(displacement_);
  }
  outer_.iterative->operator_changed();
}

linear::LinearReport SaddleSolver::solve_again(std::span<const double> b, std::span<double> x,
                                               double forcing) {
  restrict_right(b);
  linear::LinearReport report;
  // An old hierarchy that fails is renewed; a new one that fails gives way to a factorisation where the
  // system is small enough for one.
  for (bool again = true; again;) {
    again = false;
    // Factors of this matrix cost the same at any tolerance, an iteration does not.
    const double relative = choice_.direct && !factors_.old()
                                ? std::min(k_direct_tolerance, options_.relative_tolerance)
                                : std::max(forcing, options_.relative_tolerance);
    const int spent = report.iterations;
    {
      const Stopwatch watch(seconds_.solve);
      report = choice_.direct ? outer_.factorised->solve(work_.right, work_.solution, relative)
                              : outer_.iterative->solve(work_.right, work_.solution, relative);
    }
    if (!choice_.direct) {
      const bool was_new = hierarchy_.stale();
      hierarchy_.judge(report, relative);
      if (!report.converged && !was_new) {
        set_up();
        again = true;
      } else if (!report.converged && unknowns_->n_global() < linear::k_saddle_rescue_limit) {
        choice_.direct = true;
        choice_.made = false;
        set_up();
        again = true;
      }
    }
    report.iterations += spent;
  }
  expand_solution(x);
  return report;
}

void SaddleSolver::forget() {
  // The analysis of an indefinite matrix looks at its values too (MUMPS pairs pivots and orders the graph of
  // the pairs), so that the one of an earlier step would leave other bits than the one of a run that goes on.
  choice_.settled = choice_.made = false;
  factors_.forget();
}

void SaddleSolver::reset() {
  find_unknowns();
  choice_.settled = choice_.made = false;
  if (prefers_factors()) choose();
}

std::size_t SaddleSolver::bytes() const {
  return matrix_.bytes() + (preconditioner_ ? preconditioner_->bytes() : 0) +
         (outer_.iterative ? outer_.iterative->bytes() : 0) +
         (work_.right.capacity() + work_.solution.capacity() + work_.whole.capacity() +
          work_.product.capacity() + work_.local_u.capacity() + work_.local_p.capacity()) *
             sizeof(double);
}

}  // namespace solidus::mechanics
