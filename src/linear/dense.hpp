/// Dense matrices by columns, with the products, factors and eigenvalues of BLAS and LAPACK, which PETSc
/// brings along.
#pragma once

#include <complex>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace solidus::linear::dense {

/// Columns of a matrix that its owner keeps: `rows` numbers each, `stride` apart.
struct Columns {
  double* values = nullptr;
  std::size_t rows = 0, count = 0, stride = 0;

  std::span<double> operator[](std::size_t j) const { return {values + j * stride, rows}; }
  Columns first(std::size_t n) const { return {values, rows, n, stride}; }
  Columns from(std::size_t j, std::size_t n) const { return {values + j * stride, rows, n, stride}; }
  Columns rows_from(std::size_t i, std::size_t n) const { return {values + i, n, count, stride}; }
};

/// A matrix that owns its numbers.
class Matrix {
 public:
  Matrix() = default;
  /// All zero.
  Matrix(std::size_t rows, std::size_t columns);
  /// Makes a matrix whose values are undefined until its columns are written.
  static Matrix undefined(std::size_t rows, std::size_t columns);

  std::size_t rows() const { return all_.rows; }
  std::size_t columns() const { return all_.count; }
  double& operator()(std::size_t i, std::size_t j) { return all_.values[j * all_.rows + i]; }
  double operator()(std::size_t i, std::size_t j) const { return all_.values[j * all_.rows + i]; }
  /// The numbers, one column behind the other.
  std::span<double> numbers() { return {all_.values, all_.rows * all_.count}; }
  const Columns& all() const { return all_; }

 private:
  std::unique_ptr<double[]> values_;
  Columns all_;
};

/// y = Aᵀ x.
void multiply_transposed(const Columns& a, std::span<const double> x, std::span<double> y);
/// y += factor A x.
void add_product(double factor, const Columns& a, std::span<const double> x, std::span<double> y);
double square(std::span<const double> x);
/// A B and Aᵀ B.
Matrix product(const Columns& a, const Columns& b);
Matrix transposed_product(const Columns& a, const Columns& b);

/// A = Q R, with orthonormal columns of Q and R upper triangular; A has at least as many rows as columns.
struct OrthogonalFactors {
  Matrix q, r;
};
OrthogonalFactors orthogonal_factors(const Columns& a);
/// B = R⁻¹ B, and B = B R⁻¹, with R upper triangular.
void solve_upper(const Matrix& r, const Columns& b);
void solve_upper_from_right(const Matrix& r, const Columns& b);

/// Eigenvalues of a general matrix. Vectors are real columns; of a conjugate pair, whose value of positive
/// imaginary part comes first, its two columns are the real and the imaginary part.
struct Eigensystem {
  std::vector<std::complex<double>> values;
  Matrix vectors;
};
/// Without values where the iteration has not converged.
Eigensystem eigensystem(const Columns& a);

}  // namespace solidus::linear::dense
