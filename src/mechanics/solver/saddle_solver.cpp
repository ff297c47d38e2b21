/// Chooses between factors and iteration by the number of unknowns, keeps what either needs as long as it
/// serves, and changes to factors where an iteration fails.
#include "mechanics/solver/saddle_solver.hpp"

#include <algorithm>
#include <cmath>

#include "linear/factorisation.hpp"
#include "system/profile.hpp"
#include "system/stopwatch.hpp"

namespace solidus::mechanics {

namespace {

/// Unknowns up to which a factorisation is the default in the plane, and in three dimensions for any shape.
constexpr GlobalIndex k_direct_limit_2d = 60000, k_direct_limit_3d = 8000;
/// In three dimensions factors of a thin wall cost little and those of a lump fill up. Up to the second limit
/// factors are the default where they take so few multiplications and additions, half a second of a processor
/// (decision 0047).
constexpr GlobalIndex k_direct_limit_of_walls = 80000;
constexpr double k_cheap_factors = 4e9;
/// Up to so many it takes over where multigrid fails.
constexpr GlobalIndex k_rescue_limit = 200000;
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
      matrix_(displacement, pressure.fields()) {
  reset();
}

SaddleSolver::~SaddleSolver() = default;

void SaddleSolver::find_unknowns() {
  unknowns_.emplace(mesh_, matrix_, pressure_.absent(), ghosts_);
  right_.resize(unknowns_->size());
  solution_.resize(unknowns_->size());
  copy_.reset();
}

std::optional<bool> SaddleSolver::prefers_factors() const {
  if (!SaddlePreconditioner::serves(displacement_)) return true;
  if (options_.kind != linear::SolverKind::automatic) return options_.kind == linear::SolverKind::direct;
  const GlobalIndex n = unknowns_->n_global();
  if (mesh_.dimension == 2) return n < k_direct_limit_2d;
  if (n < k_direct_limit_3d) return true;
  if (n >= k_direct_limit_of_walls) return false;
  return {};
}

void SaddleSolver::choose() {
  if (!chosen_) {
    chosen_ = true;
    const std::optional<bool> preferred = prefers_factors();
    direct_ = preferred ? *preferred
                        : linear::foreseen_operations(copy_.copy(mesh_, matrix_, *unknowns_),
                                                      options_.symmetric) < k_cheap_factors;
  }
  if (!made_) make_solver();
}

void SaddleSolver::make_solver() {
  // Either a factorisation or an iterative solver with its preconditioner is kept, never both: each needs the
  // memory of the other.
  made_ = true;
  hierarchy_.renew();
  factors_.forget();
  copy_.reset();
  const auto product = [this](std::span<const double> x, std::span<double> y) { multiply(x, y); };
  // Small systems are factorised; with sub-scales the factors precondition, since the projection is
  // in the product alone.
  if (direct_) {
    preconditioner_.reset();  // the factors need its memory
    iterative_.reset();
    factorised_.emplace(linear::KrylovOptions{.prefix = "mechanics_mixed_", .symmetric = options_.symmetric});
    operator_ =
        std::make_unique<linear::FunctionMatrix>(static_cast<std::int64_t>(unknowns_->size()), product);
    return;
  }
  factorised_.reset();
  operator_.reset();
  // The preconditioner has a hierarchy for displacements and a Schur complement for pressures.
  preconditioner_.emplace(mesh_, matrix_, pressure_, ghosts_, options_.symmetric);
  iterative_.emplace();
  iterative_->set(product, [this](std::span<const double> r, std::span<double> z) { precondition(r, z); });
}

void SaddleSolver::assemble() {
  if (matrix_.set_zero()) {
    find_unknowns();
    made_ = false;
  }
  for (const MixedKernel* kernel : pressure_.kernels()) kernel->add_saddle(pressure_.unit(), matrix_);
}

void SaddleSolver::multiply(std::span<const double> x, std::span<double> y) {
  const auto n_u = static_cast<std::size_t>(mesh_.n_owned_nodes * matrix_.components()),
             n_p = static_cast<std::size_t>(mesh_.n_owned_nodes * matrix_.fields());
  // Scratch of the sizes of now; bodies may have come or gone.
  whole_.resize(n_u + n_p);
  product_.resize(n_u + n_p);
  local_u_.resize(mesh_.x.size() * static_cast<std::size_t>(matrix_.components()));
  local_p_.resize(mesh_.x.size() * static_cast<std::size_t>(matrix_.fields()));
  // Unknowns are the free entries only; held ones are zero in the product.
  unknowns_->expand(x, whole_);
  // Both parts with their ghosts, the product, and the projection of the stabilisation.
  std::copy_n(whole_.begin(), n_u, local_u_.begin());
  std::copy_n(whole_.begin() + static_cast<std::ptrdiff_t>(n_u), n_p, local_p_.begin());
  ghosts_.update(local_u_, matrix_.components());
  ghosts_.update(local_p_, matrix_.fields());
  const std::span<double> of_u = std::span(product_).first(n_u), of_p = std::span(product_).subspan(n_u);
  matrix_.multiply(local_u_, local_p_, of_u, of_p);
  pressure_.add_projection_to(std::span<const double>(whole_).subspan(n_u), 1.0, of_p);
  unknowns_->restrict_to(product_, y);
}

void SaddleSolver::precondition(std::span<const double> r, std::span<double> z) {
  whole_.resize(static_cast<std::size_t>(mesh_.n_owned_nodes * (matrix_.components() + matrix_.fields())));
  product_.resize(whole_.size());
  unknowns_->expand(r, whole_);
  preconditioner_->apply(whole_, product_);
  unknowns_->restrict_to(product_, z);
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
  // In the plane factors cost no more than the directions that would save them.
  if (!direct_ || !made_ || mesh_.dimension != 3) return report;
  double square = 0;
  for (const double value : b) square += value * value;
  if (!factors_.may_serve(std::sqrt(parallel::global_sum(square)))) return report;
  // The operator is the tangent of now, by its blocks, so that it need not be copied for PETSc.
  factors_.keep();
  factorised_->set_operator(operator_->matrix());
  restrict_right(b);
  const Stopwatch watch(seconds_solve_);
  return factorised_->solve(right_, solution_, std::max(forcing, options_.relative_tolerance), 0,
                            linear::FactorAge::k_patience);
}

void SaddleSolver::restrict_right(std::span<const double> b) {
  // From the monotone form to the symmetric one.
  std::vector<double> whole(b.begin(), b.end());
  const auto n_u = static_cast<std::size_t>(mesh_.n_owned_nodes * matrix_.components());
  for (std::size_t i = n_u; i < whole.size(); ++i) whole[i] = -whole[i];
  unknowns_->restrict_to(whole, right_);
}

void SaddleSolver::expand_solution(std::span<double> x) {
  unknowns_->expand(solution_, x);
}

void SaddleSolver::set_up() {
  const profile::Part part("solver set-up");
  const Stopwatch watch(seconds_setup_);
  choose();
  if (direct_) {
    // The assembled matrix holds displacements and pressures of the free entries.
    Mat assembled = copy_.copy(mesh_, matrix_, *unknowns_);
    factorised_->set(pressure_.orthogonal() ? operator_->matrix() : assembled, assembled);
    factors_.renew();
    return;
  }
  // Both factors go together: moduli that are not of now cost no iterations as long as the hierarchy serves.
  if (hierarchy_.stale_for(displacement_)) {
    preconditioner_->set_up_schur();
    preconditioner_->set_up_displacement();
    hierarchy_.made_for(displacement_);
  }
  iterative_->operator_changed();
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
    const double relative = direct_ && !factors_.old()
                                ? std::min(k_direct_tolerance, options_.relative_tolerance)
                                : std::max(forcing, options_.relative_tolerance);
    const int spent = report.iterations;
    {
      const Stopwatch watch(seconds_solve_);
      report = direct_ ? factorised_->solve(right_, solution_, relative)
                       : iterative_->solve(right_, solution_, relative);
    }
    if (!direct_) {
      const bool was_new = hierarchy_.stale();
      hierarchy_.judge(report, relative);
      if (!report.converged && !was_new) {
        set_up();
        again = true;
      } else if (!report.converged && unknowns_->n_global() < k_rescue_limit) {
        direct_ = true;
        made_ = false;
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
  chosen_ = made_ = false;
  factors_.forget();
}

void SaddleSolver::reset() {
  find_unknowns();
  chosen_ = made_ = false;
  if (prefers_factors()) choose();
}

std::size_t SaddleSolver::bytes() const {
  return matrix_.bytes() + (preconditioner_ ? preconditioner_->bytes() : 0) +
         (iterative_ ? iterative_->bytes() : 0) +
         (right_.capacity() + solution_.capacity() + whole_.capacity() + product_.capacity() +
          local_u_.capacity() + local_p_.capacity()) *
             sizeof(double);
}

}  // namespace solidus::mechanics
