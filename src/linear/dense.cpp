/// Thin wrappers around BLAS and LAPACK, which check sizes and the routines' answers.
#include "linear/dense.hpp"

#include <petscsys.h>  // petscblaslapack.h needs it before it

#include <petscblaslapack.h>

#include <algorithm>
#include <stdexcept>

#include "numbers/index_casts.hpp"

namespace solidus::linear::dense {

namespace {

int length(std::size_t n) {
  return static_cast<int>(n);
}
/// The distance of columns, which LAPACK wants to be positive.
int distance(const Columns& a) {
  return std::max(1, length(a.stride));
}

void require(int info, const char* routine) {
  if (info != 0) throw std::logic_error(std::string("LAPACK: an argument of ") + routine);
}

Matrix multiplied(const char* transposed, std::size_t rows, std::size_t inner, const Columns& a,
                  const Columns& b) {
  Matrix result(rows, b.count);
  const int m = length(rows), n = length(b.count), k = length(inner), lda = distance(a), ldb = distance(b),
            ldc = distance(result.all());
  const double one = 1, zero = 0;
  if (m > 0 && n > 0 && k > 0)
    BLASgemm_(transposed, "N", &m, &n, &k, &one, a.values, &lda, b.values, &ldb, &zero, result.all().values,
              &ldc);
  return result;
}

/// @param side  "L": R⁻¹ B, "R": B R⁻¹
void solve_triangular(const char* side, const Matrix& r, const Columns& b) {
  const int m = length(b.rows), n = length(b.count), ldr = distance(r.all()), ldb = distance(b);
  const double one = 1;
  BLAStrsm_(side, "U", "N", "N", &m, &n, &one, r.all().values, &ldr, b.values, &ldb);
}

Matrix copy(const Columns& a) {
  Matrix result(a.rows, a.count);
  for (std::size_t j = 0; j < a.count; ++j) std::copy(a[j].begin(), a[j].end(), result.all()[j].begin());
  return result;
}

}  // namespace

Matrix::Matrix(std::size_t rows, std::size_t columns) : Matrix(undefined(rows, columns)) {
  std::fill_n(all_.values, rows * columns, 0.0);
}

Matrix Matrix::undefined(std::size_t rows, std::size_t columns) {
  Matrix result;
  result.values_ = std::make_unique_for_overwrite<double[]>(rows * columns);
  result.all_ = {result.values_.get(), rows, columns, rows};
  return result;
}

void multiply_transposed(const Columns& a, std::span<const double> x, std::span<double> y) {
  std::fill(y.begin(), y.end(), 0.0);
  const int m = length(a.rows), n = length(a.count), lda = distance(a), step = 1;
  const double one = 1, zero = 0;
  if (m > 0 && n > 0) BLASgemv_("T", &m, &n, &one, a.values, &lda, x.data(), &step, &zero, y.data(), &step);
}

void add_product(double factor, const Columns& a, std::span<const double> x, std::span<double> y) {
  const int m = length(a.rows), n = length(a.count), lda = distance(a), step = 1;
  const double one = 1;
  if (m > 0 && n > 0) BLASgemv_("N", &m, &n, &factor, a.values, &lda, x.data(), &step, &one, y.data(), &step);
}

double square(std::span<const double> x) {
  const int n = length(x.size()), step = 1;
  return BLASdot_(&n, x.data(), &step, x.data(), &step);
}

Matrix product(const Columns& a, const Columns& b) {
  return multiplied("N", a.rows, a.count, a, b);
}
Matrix transposed_product(const Columns& a, const Columns& b) {
  return multiplied("T", a.count, a.rows, a, b);
}

OrthogonalFactors orthogonal_factors(const Columns& a) {
  OrthogonalFactors f{copy(a), Matrix(a.count, a.count)};
  const int m = length(a.rows), n = length(a.count), lda = distance(f.q.all());
  // LAPACK's block size is 32 at most for these routines.
  const int n_work = 32 * std::max(1, n);
  std::vector<double> reflectors(a.count), work(as_size(n_work));
  int info = 0;
  // Householder's factorisation, then its orthogonal factor explicitly.
  LAPACKgeqrf_(&m, &n, f.q.all().values, &lda, reflectors.data(), work.data(), &n_work, &info);
  require(info, "geqrf");
  // R lies above the diagonal of what geqrf returns; the reflectors below are used up by orgqr.
  for (std::size_t j = 0; j < a.count; ++j)
    for (std::size_t i = 0; i <= j; ++i) f.r(i, j) = f.q(i, j);
  LAPACKorgqr_(&m, &n, &n, f.q.all().values, &lda, reflectors.data(), work.data(), &n_work, &info);
  require(info, "orgqr");
  return f;
}

void solve_upper(const Matrix& r, const Columns& b) {
  solve_triangular("L", r, b);
}
void solve_upper_from_right(const Matrix& r, const Columns& b) {
  solve_triangular("R", r, b);
}

Eigensystem eigensystem(const Columns& a) {
  const std::size_t size = a.count;
  const int n = length(size), lda = std::max(1, n), one = 1, n_work = 34 * std::max(1, n);
  Matrix work_on = copy(a);
  std::vector<double> real(size), imaginary(size), work(as_size(n_work));
  Eigensystem result{{}, Matrix(size, size)};
  int info = 0;
  double none = 0;
  LAPACKgeev_("N", "V", &n, work_on.all().values, &lda, real.data(), imaginary.data(), &none, &one,
              result.vectors.all().values, &lda, work.data(), &n_work, &info);
  // A negative value is a wrong argument, our fault; a positive one says that the iteration did not
  // converge.
  if (info < 0) require(info, "geev");
  if (info == 0)
    for (std::size_t i = 0; i < size; ++i) result.values.emplace_back(real[i], imaginary[i]);
  return result;
}

}  // namespace solidus::linear::dense
