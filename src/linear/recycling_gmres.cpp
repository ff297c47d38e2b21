#include "linear/recycling_gmres.hpp"

#include <mpi.h>
#include <petscsys.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "linear/interruption.hpp"
#include "system/profile.hpp"

namespace solidus::linear {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A direction is kept if its harmonic Ritz value is smaller than this. The eigenvalues of the preconditioned
/// operator lie about 1, and GMRES converges fast for those that are larger.
constexpr double k_slow = 0.3;
/// A direction whose product is this small a part of what it was before the others were taken out of it
/// depends on them.
constexpr double k_dependent = 1e-10;

std::span<const double> input(const Eigen::Ref<const VectorXd>& v) {
  return {v.data(), static_cast<std::size_t>(v.size())};
}

std::span<double> output(Eigen::Ref<VectorXd> v) {
  return {v.data(), static_cast<std::size_t>(v.size())};
}

/// Sums a matrix over all processes, in place.
void sum(MatrixXd& a) {
  MPI_Allreduce(MPI_IN_PLACE, a.data(), static_cast<int>(a.size()), MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
}

void sum(VectorXd& a) {
  MPI_Allreduce(MPI_IN_PLACE, a.data(), static_cast<int>(a.size()), MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
}

/// aᵀ b over all processes.
template <class A, class B>
MatrixXd products(const A& a, const B& b) {
  MatrixXd result = a.transpose() * b;
  sum(result);
  return result;
}

double norm(const Eigen::Ref<const VectorXd>& v) {
  double square = v.squaredNorm();
  MPI_Allreduce(MPI_IN_PLACE, &square, 1, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
  return std::sqrt(square);
}

/// Takes the components along the orthonormal columns of q out of w, a second time where the first has
/// cancelled digits (classical Gram-Schmidt, selective reorthogonalisation). Returns them, and behind them
/// the norm of the remainder.
template <class Columns>
VectorXd orthogonalise(const Columns& q, Eigen::Ref<VectorXd> w) {
  constexpr double k_cancelled = 0.5;
  const Index n = q.cols();
  VectorXd h(n + 1), total = VectorXd::Zero(n + 1);
  for (int pass = 0; pass < 2; ++pass) {
    h.head(n).noalias() = q.transpose() * w;
    h[n] = w.squaredNorm();
    sum(h);
    w.noalias() -= q * h.head(n);
    total.head(n) += h.head(n);
    const double before = h[n], left = before - h.head(n).squaredNorm();
    total[n] = std::sqrt(std::max(0.0, left));
    if (left > k_cancelled * k_cancelled * before) return total;
  }
  total[n] = norm(w);
  return total;
}

/// Plane rotations that bring the Hessenberg matrix of a cycle to triangular form column by column.
class LeastSquares {
 public:
  LeastSquares(Index directions, double beta)
      : r_(MatrixXd::Zero(directions + 1, directions)), g_(VectorXd::Zero(directions + 1)) {
    g_[0] = beta;
  }
  /// Adds a column of `column.size()` entries; returns the norm of the residual.
  double add(VectorXd column) {
    const Index j = n_++;
    for (Index i = 0; i < j; ++i) rotations_[static_cast<std::size_t>(i)](column[i], column[i + 1]);
    Rotation turn;
    const double length = std::hypot(column[j], column[j + 1]);
    if (length > 0) turn = {column[j] / length, column[j + 1] / length};
    turn(column[j], column[j + 1]);
    turn(g_[j], g_[j + 1]);
    rotations_.push_back(turn);
    r_.col(j).head(j + 1) = column.head(j + 1);
    return std::abs(g_[j + 1]);
  }
  VectorXd solution() const {
    VectorXd y = g_.head(n_);
    r_.topLeftCorner(n_, n_).triangularView<Eigen::Upper>().solveInPlace(y);
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
  MatrixXd r_;
  VectorXd g_;
  Index n_ = 0;
  std::vector<Rotation> rotations_;
};

/// The harmonic Ritz vectors of smallest absolute value, GᵀG p = θ GᵀF p, as columns; real and imaginary
/// parts of complex ones.
MatrixXd slow_vectors(const MatrixXd& g, const MatrixXd& f, Index most) {
  const Index n = g.cols();
  const Eigen::HouseholderQR<MatrixXd> qr(g);
  const MatrixXd q = qr.householderQ() * MatrixXd::Identity(g.rows(), n);
  MatrixXd inverse = q.transpose() * f;
  qr.matrixQR().topRows(n).triangularView<Eigen::Upper>().solveInPlace(inverse);
  if (!inverse.allFinite()) return MatrixXd(n, 0);
  const Eigen::EigenSolver<MatrixXd> eigen(inverse);  // of 1/θ
  if (eigen.info() != Eigen::Success) return MatrixXd(n, 0);
  const auto size = [&](Index i) { return std::abs(eigen.eigenvalues()[i]); };
  std::vector<Index> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return size(a) > size(b); });
  MatrixXd chosen(n, most);
  Index count = 0;
  for (const Index i : order) {
    if (size(i) < 1 / k_slow || count == most) break;
    const double imaginary = eigen.eigenvalues()[i].imag();
    if (imaginary < 0) continue;  // comes with its conjugate
    chosen.col(count++) = eigen.eigenvectors().col(i).real();
    if (imaginary > 0 && count < most) chosen.col(count++) = eigen.eigenvectors().col(i).imag();
  }
  return chosen.leftCols(count);
}

}  // namespace

struct RecyclingGmres::Implementation {
  RecyclingOptions options;
  Map op, preconditioner;
  Index n = 0;        ///< unknowns of this process
  Index n_kept = 0;   ///< number of recycled columns
  bool stale = true;  ///< the recycled products belong to an earlier operator
  MatrixXd v;         ///< columns of C in front, then the directions of the cycle, orthonormal
  MatrixXd z;  ///< the directions of which they are products: Z in front, then the preconditioned directions
  MatrixXd u;  ///< Z before it was preconditioned, which gives the Ritz vectors their measure

  void set_size(Index size);
  void renew_products();
  Index orthonormal_prefix();
  struct Cycle {
    int iterations = 0;
    bool converged = false;
    bool exhausted = false;  ///< no direction is left
  };
  Cycle cycle(VectorXd& r, Eigen::Ref<VectorXd> x, double limit, int most);
  void choose(Index steps, const MatrixXd& g);
};

void RecyclingGmres::Implementation::set_size(Index size) {
  if (v.cols() > 0 && size == n) return;
  n = size;
  n_kept = 0;
  const Index columns = options.kept + options.directions;
  v.resize(n, columns + 1);  // pages are taken as columns are written
  z.resize(n, columns);
  u.resize(n, options.kept);
}

/// C = A Z for the operator as it is now, orthonormal; Z and U follow. Directions that depend on others go.
void RecyclingGmres::Implementation::renew_products() {
  Index kept = 0;
  for (Index i = 0; i < n_kept; ++i) {
    op(input(z.col(i)), output(v.col(kept)));
    const double before = norm(v.col(kept));
    const VectorXd h = orthogonalise(v.leftCols(kept), v.col(kept));
    const double left = h[kept];
    if (!(left > k_dependent * before)) continue;
    v.col(kept) /= left;
    z.col(kept) = (z.col(i) - z.leftCols(kept) * h.head(kept)) / left;
    u.col(kept) = (u.col(i) - u.leftCols(kept) * h.head(kept)) / left;
    ++kept;
  }
  n_kept = kept;
  stale = false;
}

RecyclingGmres::Implementation::Cycle RecyclingGmres::Implementation::cycle(VectorXd& r,
                                                                            Eigen::Ref<VectorXd> x,
                                                                            double limit, int most) {
  Cycle report;
  const Index k = n_kept, m = std::min<Index>(options.directions, most);
  const double beta = norm(r);
  v.col(k) = r / beta;
  MatrixXd g = MatrixXd::Zero(k + m + 1, k + m);
  g.topLeftCorner(k, k).setIdentity();
  LeastSquares problem(m, beta);
  Index j = 0;
  while (j < m && !report.converged && !report.exhausted) {
    check_interruption();
    preconditioner(input(v.col(k + j)), output(z.col(k + j)));
    op(input(z.col(k + j)), output(v.col(k + j + 1)));
    const double before = norm(v.col(k + j + 1));
    const VectorXd h = orthogonalise(v.leftCols(k + j + 1), v.col(k + j + 1));
    g.col(k + j).head(k + j + 2) = h;
    report.exhausted = !(h[k + j + 1] > k_dependent * before);
    if (!report.exhausted) v.col(k + j + 1) /= h[k + j + 1];
    report.converged = problem.add(h.tail(j + 2)) <= limit;
    ++j;
  }
  report.iterations = static_cast<int>(j);
  const VectorXd y = problem.solution();
  VectorXd of_directions(k + j);
  of_directions << -g.topRows(k).middleCols(k, j) * y, y;
  x.noalias() += z.leftCols(k + j) * of_directions;
  if (j >= options.worthwhile && !report.exhausted) choose(j, g.topLeftCorner(k + j + 1, k + j));
  return report;
}

/// The next Z from the space of this cycle, A [Z Z_m] = [C V] G.
void RecyclingGmres::Implementation::choose(Index steps, const MatrixXd& g) {
  const Index k = n_kept, all = k + steps;
  MatrixXd f = MatrixXd::Zero(all + 1, all);
  f.bottomRightCorner(steps + 1, steps).setIdentity();
  if (k > 0) f.leftCols(k) = products(v.leftCols(all + 1), u.leftCols(k));
  const MatrixXd p = slow_vectors(g, f, options.kept);
  n_kept = p.cols();
  if (n_kept == 0) return;
  const Eigen::HouseholderQR<MatrixXd> qr(g * p);
  const MatrixXd q = qr.householderQ() * MatrixXd::Identity(all + 1, n_kept);
  const MatrixXd combination =
      qr.matrixQR().topRows(n_kept).triangularView<Eigen::Upper>().solve<Eigen::OnTheRight>(p);
  const MatrixXd before =
      u.leftCols(k) * combination.topRows(k) + v.middleCols(k, steps) * combination.bottomRows(steps);
  u.leftCols(n_kept) = before;
  const MatrixXd made = z.leftCols(all) * combination;
  z.leftCols(n_kept) = made;
  const MatrixXd product = v.leftCols(all + 1) * q;
  v.leftCols(n_kept) = product;
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
  Implementation& my = *implementation_;
  my.set_size(static_cast<Index>(b.size()));
  if (my.stale) my.renew_products();
  const Eigen::Map<const VectorXd> right(b.data(), my.n);
  Eigen::Map<VectorXd> solution(x.data(), my.n);
  VectorXd r = right;
  solution.setZero();
  // The norm of a cycle and that of the true residual differ by rounding.
  const double limit = relative * norm(r), accepted = 1.01 * limit;
  const auto project = [&] {
    if (my.n_kept == 0) return;
    const VectorXd c = products(my.v.leftCols(my.n_kept), r);
    solution.noalias() += my.z.leftCols(my.n_kept) * c;
    r.noalias() -= my.v.leftCols(my.n_kept) * c;
  };
  project();
  LinearReport report;
  while (!(norm(r) <= accepted)) {  // not a number is no solution
    const int left = my.options.max_iterations - report.iterations;
    if (left <= 0 || !std::isfinite(norm(r))) {
      report.converged = false;
      report.reason = left <= 0 ? "DIVERGED_ITS" : "DIVERGED_NANORINF";
      break;
    }
    const Implementation::Cycle cycle = my.cycle(r, solution, limit, left);
    report.iterations += cycle.iterations;
    VectorXd product(my.n);
    my.op(input(solution), output(product));
    r = right - product;
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
  return static_cast<std::size_t>(my.v.size() + my.z.size() + my.u.size()) * sizeof(double);
}

}  // namespace solidus::linear
