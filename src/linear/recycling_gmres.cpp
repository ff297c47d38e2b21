/// Directions that converge slowly are kept and deflated; they are renewed for each new operator and chosen
/// again after each cycle.
#include "linear/recycling_gmres.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "linear/dense.hpp"
#include "linear/interruption.hpp"
#include "system/processes.hpp"
#include "system/profile.hpp"

namespace solidus::linear {

namespace {

using dense::Columns, dense::Matrix;
using Size = std::size_t;
using Vector = std::vector<double>;

/// A direction is kept if its harmonic Ritz value is smaller than this. The eigenvalues of the preconditioned
/// operator lie about 1, and GMRES converges fast for those that are larger.
constexpr double k_slow = 0.3;
/// A direction whose product is this small a part of what it was before the others were taken out of it
/// depends on them.
constexpr double k_dependent = 1e-10;

/// Aᵀ B over all processes.
Matrix products(const Columns& a, const Columns& b) {
  Matrix result = dense::transposed_product(a, b);
  processes::sum(result.numbers());
  return result;
}

double norm(std::span<const double> v) {
  double square = dense::square(v);
  processes::sum(std::span(&square, 1));
  return std::sqrt(square);
}

/// Takes the components along the orthonormal columns of q out of w, a second time where the first has
/// cancelled digits (classical Gram-Schmidt, selective reorthogonalisation). Returns them, and behind them
/// the norm of the remainder.
Vector orthogonalise(const Columns& q, std::span<double> w) {
  constexpr double k_cancelled = 0.5;
  const Size n = q.count;
  Vector h(n + 1), total(n + 1, 0.0);
  const std::span<double> along = std::span(h).first(n);
  for (int pass = 0; pass < 2; ++pass) {
    dense::multiply_transposed(q, w, along);
    h[n] = dense::square(w);
    processes::sum(h);
    dense::add_product(-1, q, along, w);
    for (Size i = 0; i < n; ++i) total[i] += h[i];
    const double before = h[n], left = before - dense::square(along);
    total[n] = std::sqrt(std::max(0.0, left));
    if (left > k_cancelled * k_cancelled * before) return total;
  }
  total[n] = norm(w);
  return total;
}

/// Plane rotations that bring the Hessenberg matrix of a cycle to triangular form column by column.
class LeastSquares {
 public:
  LeastSquares(Size directions, double beta) : r_(directions + 1, directions), g_(directions + 1, 0.0) {
    g_[0] = beta;
  }
  /// Adds a column of `column.size()` entries; returns the norm of the residual.
  double add(std::span<const double> given) {
    Vector column(given.begin(), given.end());
    const Size j = n_++;
    for (Size i = 0; i < j; ++i) rotations_[i](column[i], column[i + 1]);
    Rotation turn;
    const double length = std::hypot(column[j], column[j + 1]);
    if (length > 0) turn = {column[j] / length, column[j + 1] / length};
    turn(column[j], column[j + 1]);
    turn(g_[j], g_[j + 1]);
    rotations_.push_back(turn);
    std::copy_n(column.begin(), j + 1, r_.all()[j].begin());
    return std::abs(g_[j + 1]);
  }
  Vector solution() const {
    Vector y(g_.begin(), g_.begin() + static_cast<std::ptrdiff_t>(n_));
    for (Size j = n_; j-- > 0;) {
      y[j] /= r_(j, j);
      for (Size i = 0; i < j; ++i) y[i] -= r_(i, j) * y[j];
    }
    return y;
  }

 private:
  struct Rotation {
    double c = 1, s = 0;
    void operator()(double& a, double& b) const {
      const double turned = c * a + s * b;
      b = c * b - s * a;
      a = turned;
    }
  };
  Matrix r_;
  Vector g_;
  Size n_ = 0;
  std::vector<Rotation> rotations_;
};

/// The harmonic Ritz vectors of smallest absolute value, GᵀG p = θ GᵀF p, as columns; real and imaginary
/// parts of complex ones.
Matrix slow_vectors(const Columns& g, const Columns& f, Size most) {
  const Size n = g.count;
  // From G = Q R the problem becomes an ordinary one: R⁻¹ Qᵀ F p = (1/θ) p.
  const dense::OrthogonalFactors qr = dense::orthogonal_factors(g);
  const Matrix inverse =
      dense::transposed_product(qr.q.all(), f);  // R⁻¹ Qᵀ F, of which 1/θ are the eigenvalues
  dense::solve_upper(qr.r, inverse.all());
  for (Size j = 0; j < n; ++j)
    for (const double value : inverse.all()[j])
      if (!std::isfinite(value)) return Matrix(n, 0);
  const dense::Eigensystem eigen = dense::eigensystem(inverse.all());
  if (eigen.values.empty()) return Matrix(n, 0);
  const auto size = [&](Size i) { return std::abs(eigen.values[i]); };
  // The largest 1/θ are the slowest directions.
  std::vector<Size> order(n);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Size a, Size b) { return size(a) > size(b); });
  std::vector<Size> chosen;
  for (const Size i : order) {
    // Only those that are slow enough are worth their memory.
    if (size(i) < 1 / k_slow || chosen.size() == most) break;
    const double imaginary = eigen.values[i].imag();
    if (imaginary < 0) continue;  // comes with its conjugate
    chosen.push_back(i);
    if (imaginary > 0 && chosen.size() < most) chosen.push_back(i + 1);
  }
  Matrix vectors(n, chosen.size());
  for (Size k = 0; k < chosen.size(); ++k) {
    const std::span<double> from = eigen.vectors.all()[chosen[k]];
    std::copy(from.begin(), from.end(), vectors.all()[k].begin());
  }
  return vectors;
}

}  // namespace

struct RecyclingGmres::Implementation {
  RecyclingOptions options;
  Map op, preconditioner;
  bool sized = false;
  Size n = 0;         ///< unknowns of this process
  Size n_kept = 0;    ///< number of recycled columns
  bool stale = true;  ///< the recycled products belong to an earlier operator
  Matrix v;           ///< columns of C in front, then the directions of the cycle, orthonormal
  Matrix z;  ///< the directions of which they are products: Z in front, then the preconditioned directions
  Matrix u;  ///< Z before it was preconditioned, which gives the Ritz vectors their measure

  void set_size(Size size);
  void renew_products();
  struct Cycle {
    int iterations = 0;
    bool converged = false;
    bool exhausted = false;  ///< no direction is left
  };
  Cycle cycle(std::span<double> r, std::span<double> x, double limit, int most);
  void choose(Size steps, const Columns& g);
};

void RecyclingGmres::Implementation::set_size(Size size) {
  if (sized && size == n) return;
  sized = true;
  n = size;
  n_kept = 0;
  const Size kept = static_cast<Size>(options.kept), columns = kept + static_cast<Size>(options.directions);
  v = Matrix::undefined(n, columns + 1);
  z = Matrix::undefined(n, columns);
  u = Matrix::undefined(n, kept);
}

/// C = A Z for the operator as it is now, orthonormal; Z and U follow. Directions that depend on others go.
void RecyclingGmres::Implementation::renew_products() {
  Size kept = 0;
  for (Size i = 0; i < n_kept; ++i) {
    // Products of the operator, orthogonalised against those before.
    const std::span<double> product = v.all()[kept];
    op(z.all()[i], product);
    const double before = norm(product);
    const Vector h = orthogonalise(v.all().first(kept), product);
    const double left = h[kept];
    // What depends on others brings nothing and is left out.
    if (!(left > k_dependent * before)) continue;
    for (double& value : product) value /= left;
    // Z and U get the same combination as their products.
    for (const Matrix* directions : {&z, &u}) {
      const std::span<double> from = directions->all()[i], to = directions->all()[kept];
      if (kept != i) std::copy(from.begin(), from.end(), to.begin());
      dense::add_product(-1, directions->all().first(kept), std::span(h).first(kept), to);
      for (double& value : to) value /= left;
    }
    ++kept;
  }
  n_kept = kept;
  stale = false;
}

RecyclingGmres::Implementation::Cycle RecyclingGmres::Implementation::cycle(std::span<double> r,
                                                                            std::span<double> x, double limit,
                                                                            int most) {
  Cycle report;
  // The basis v has k kept directions in front, which span C with A Z = C, and behind them the Arnoldi
  // vectors of this cycle. v[k] is the residual, of norm β.
  const Size k = n_kept, m = static_cast<Size>(std::min(options.directions, most));
  const double beta = norm(r);
  std::transform(r.begin(), r.end(), v.all()[k].begin(), [beta](double value) { return value / beta; });
  // G holds A Z = V G: the identity for the kept directions, and one column of coefficients for each new one.
  Matrix g(k + m + 1, k + m);
  for (Size i = 0; i < k; ++i) g(i, i) = 1;
  LeastSquares problem(m, beta);
  Size j = 0;
  while (j < m && !report.converged && !report.exhausted) {
    check_interruption();
    const std::span<double> next = v.all()[k + j + 1];
    // One step of flexible Arnoldi: z = M⁻¹ v, A z is orthogonalised against all directions so far, kept ones
    // included, and becomes the next v. If next to nothing is left of it, the space is invariant and the
    // cycle ends.
    preconditioner(v.all()[k + j], z.all()[k + j]);
    op(z.all()[k + j], next);
    const double before = norm(next);
    const Vector h = orthogonalise(v.all().first(k + j + 1), next);
    std::copy(h.begin(), h.end(), g.all()[k + j].begin());
    report.exhausted = !(h[k + j + 1] > k_dependent * before);
    if (!report.exhausted)
      for (double& value : next) value /= h[k + j + 1];
    // The least squares problem min |β e₁ − H y| is brought up to date by one rotation, which also gives the
    // norm of the residual.
    report.converged = problem.add(std::span(h).last(j + 2)) <= limit;
    ++j;
  }
  report.iterations = static_cast<int>(j);
  // The solution adds Z y. What A has carried into the kept directions (the rows of G above k) is taken back
  // by them.
  const Vector y = problem.solution();
  Vector of_directions(k + j, 0.0);
  dense::add_product(-1, g.all().from(k, j).rows_from(0, k), y, std::span(of_directions).first(k));
  std::copy(y.begin(), y.end(), of_directions.begin() + static_cast<std::ptrdiff_t>(k));
  dense::add_product(1, z.all().first(k + j), of_directions, x);
  // A cycle that was worth it offers its slow directions to be kept: the harmonic Ritz vectors of its matrix
  // G.
  if (static_cast<int>(j) >= options.worthwhile && !report.exhausted)
    choose(j, g.all().first(k + j).rows_from(0, k + j + 1));
  return report;
}

/// The next Z from the space of this cycle, A [Z Z_m] = [C V] G.
void RecyclingGmres::Implementation::choose(Size steps, const Columns& g) {
  const Size k = n_kept, all = k + steps;
  // F holds the products [U V]ᵀ [C V] of kept and new directions.
  Matrix f(all + 1, all);
  for (Size i = 0; i < steps; ++i) f(k + i, k + i) = 1;
  if (k > 0) {
    const Matrix of_kept = products(v.all().first(all + 1), u.all().first(k));
    std::copy_n(of_kept.all().values, (all + 1) * k, f.all().values);
  }
  const Matrix p = slow_vectors(g, f.all(), static_cast<Size>(options.kept));
  n_kept = p.columns();
  if (n_kept == 0) return;
  // The kept space becomes orthonormal again: G P = Q R, and the combination P R⁻¹.
  const Matrix of_ritz = dense::product(g, p.all());
  const dense::OrthogonalFactors qr = dense::orthogonal_factors(of_ritz.all());
  const Columns combination = p.all();
  dense::solve_upper_from_right(qr.r, combination);
  // Both sides of the space are combined from the old ones and those of this cycle.
  Matrix before = dense::product(v.all().from(k, steps), combination.rows_from(k, steps));
  for (Size i = 0; i < n_kept; ++i)
    dense::add_product(1, u.all().first(k), combination[i].first(k), before.all()[i]);
  const auto take = [&](const Matrix& from, const Matrix& to) {
    for (Size i = 0; i < n_kept; ++i) std::copy_n(from.all()[i].begin(), n, to.all()[i].begin());
  };
  take(before, u);
  take(dense::product(z.all().first(all), combination), z);
  take(dense::product(v.all().first(all + 1), qr.q.all()), v);
}

RecyclingGmres::RecyclingGmres(RecyclingOptions options)
    : implementation_(std::make_unique<Implementation>()) {
  implementation_->options = options;
}

RecyclingGmres::~RecyclingGmres() = default;

void RecyclingGmres::set(Map op, Map preconditioner) {
  implementation_->op = std::move(op);
  implementation_->preconditioner = std::move(preconditioner);
  operator_changed();
}

void RecyclingGmres::operator_changed() {
  implementation_->stale = true;
}

void RecyclingGmres::forget() {
  implementation_->n_kept = 0;
}

LinearReport RecyclingGmres::solve(std::span<const double> b, std::span<double> x, double relative) {
  const profile::Part part("solve");
  // Kept directions of an older operator are brought up to date first.
  Implementation& my = *implementation_;
  my.set_size(b.size());
  if (my.stale) my.renew_products();
  Vector r(b.begin(), b.end());
  std::fill(x.begin(), x.end(), 0.0);
  // The norm of a cycle and that of the true residual differ by rounding.
  const double limit = relative * norm(r), accepted = 1.01 * limit;
  // What the kept directions can say of the solution is taken first.
  const auto project = [&] {
    if (my.n_kept == 0) return;
    Vector c(my.n_kept);
    dense::multiply_transposed(my.v.all().first(my.n_kept), r, c);
    processes::sum(c);
    dense::add_product(1, my.z.all().first(my.n_kept), c, x);
    dense::add_product(-1, my.v.all().first(my.n_kept), c, r);
  };
  project();
  LinearReport report;
  // Cycles until the true residual is small enough, which is computed after each of them.
  while (!(norm(r) <= accepted)) {  // not a number is no solution
    const int left = my.options.max_iterations - report.iterations;
    if (left <= 0 || !std::isfinite(norm(r))) {
      report.converged = false;
      report.reason = left <= 0 ? "DIVERGED_ITS" : "DIVERGED_NANORINF";
      break;
    }
    const Implementation::Cycle cycle = my.cycle(r, x, limit, left);
    report.iterations += cycle.iterations;
    // The true residual, since that of the cycle drifts by rounding.
    Vector product(my.n);
    my.op(x, product);
    for (Size i = 0; i < my.n; ++i) r[i] = b[i] - product[i];
    // A cycle that has spanned all that it can reach would only repeat itself.
    if (cycle.exhausted && norm(r) > accepted) {
      report.converged = false;
      report.reason = "DIVERGED_BREAKDOWN";
      break;
    }
    project();
  }
  return report;
}

std::size_t RecyclingGmres::bytes() const {
  const Implementation& my = *implementation_;
  return my.n * (my.v.columns() + my.z.columns() + my.u.columns()) * sizeof(double);
}

}  // namespace solidus::linear
