/// The products, sums and updates of an iteration are joined into as few passes through memory as possible.
#include "linear/conjugate_gradients.hpp"

#include <algorithm>
#include <cmath>

#include "linear/interruption.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::linear {

namespace {

constexpr double k_divergence = 1e5;  ///< growth of the residual that ends the iteration, as in PETSc

double dot(std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (std::size_t i = 0; i < b.size(); ++i) sum += a[i] * b[i];
  return parallel::global_sum(sum);
}

}  // namespace

ConjugateGradients::ConjugateGradients(const mesh::Mesh& mesh, const BlockMatrix& a,
                                       IncompleteCholesky& factors)
    : a_(a),
      factors_(factors),
      ghosts_(mesh),
      residual_(as_size(mesh.n_owned_nodes)),
      product_(residual_.size()),
      direction_(mesh.x.size()) {}

/// Returns rᵀ M⁻¹ r.
double ConjugateGradients::precondition() {
  preconditioned_ = factors_.apply(residual_);
  double sum = 0;
  for (std::size_t i = 0; i < residual_.size(); ++i)
    sum += residual_[i] * static_cast<double>(preconditioned_[i]);
  return parallel::global_sum(sum);
}

LinearReport ConjugateGradients::solve(std::span<const double> b, std::span<double> x, double tolerance,
                                       int max_iterations) {
  // The start is x = 0, so that the first residual is the right-hand side itself.
  const std::size_t n = residual_.size();
  std::copy_n(b.begin(), n, residual_.begin());
  std::fill_n(x.begin(), n, 0.0);
  std::fill(direction_.begin(), direction_.end(), 0.0);
  LinearReport report;
  const auto failed = [&](const char* reason) {
    report.converged = false;
    report.reason = reason;
    return report;
  };
  const double start = std::sqrt(dot(residual_, residual_));
  if (!std::isfinite(start)) return failed("the right-hand side is not a number");
  if (start == 0) return report;
  // `square` is the product of the residual with the preconditioned one, r·z, and `share` the weight β of the
  // direction before (zero in the first iteration).
  double square = precondition(), share = 0;
  while (true) {
    check_interruption();
    // Factors in single precision may be indefinite. The method needs a positive preconditioner and a
    // positive matrix; what is neither is reported instead of iterated with.
    if (!(square > 0)) return failed("the preconditioner is not positive");
    if (report.iterations == max_iterations) return failed("too many iterations");
    ++report.iterations;
    // The new direction is p = z + β p, whose ghosts are needed by the product A p.
    for (std::size_t i = 0; i < n; ++i)
      direction_[i] = static_cast<double>(preconditioned_[i]) + share * direction_[i];
    ghosts_.update(direction_, 1);
    a_.multiply_free(direction_, product_);
    const double curvature = dot(direction_, product_);
    if (!(curvature > 0)) return failed("the matrix is not positive");
    // The step length is α = (r·z)/(p·A p). The norm of the new residual is summed in the same loop.
    const double length = square / curvature;
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) {
      x[i] += length * direction_[i];
      residual_[i] -= length * product_[i];
      sum += residual_[i] * residual_[i];
    }
    // The iteration ends by the norm of the residual over the right-hand side, and gives up where it has
    // grown far beyond it.
    const double norm = std::sqrt(parallel::global_sum(sum));
    if (norm <= tolerance * start) return report;
    if (!(norm < k_divergence * start)) return failed("the residual grows");
    const double before = square;
    square = precondition();
    share = square / before;
  }
}

}  // namespace solidus::linear
