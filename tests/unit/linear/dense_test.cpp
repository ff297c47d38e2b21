/// Products, factors and eigenvalues of dense matrices (dense.hpp).
#include "linear/dense.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace solidus::linear::dense {
namespace {

Matrix random_matrix(std::size_t rows, std::size_t columns, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> entry(-1, 1);
  Matrix a(rows, columns);
  for (double& value : a.numbers()) value = entry(random);
  return a;
}

double largest_difference(const Matrix& a, const Matrix& b) {
  EXPECT_EQ(a.rows(), b.rows());
  EXPECT_EQ(a.columns(), b.columns());
  double largest = 0;
  for (std::size_t j = 0; j < a.columns(); ++j)
    for (std::size_t i = 0; i < a.rows(); ++i) largest = std::max(largest, std::abs(a(i, j) - b(i, j)));
  return largest;
}

TEST(Dense, ProductsAreThoseOfTheirDefinitionAlsoOfPartsOfAMatrix) {
  const Matrix a = random_matrix(7, 5, 1), b = random_matrix(6, 4, 2);
  const Columns part = a.all().from(1, 3).rows_from(2, 4), other = b.all().from(2, 2).rows_from(1, 3);
  const Matrix product = dense::product(part, other);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 2; ++j) {
      double sum = 0;
      for (std::size_t k = 0; k < 3; ++k) sum += a(2 + i, 1 + k) * b(1 + k, 2 + j);
      EXPECT_NEAR(product(i, j), sum, 1e-15);
    }
  const std::vector<double> x{1, -2, 3, 0.5};
  std::vector<double> y(3, 99.0), z{1, 1, 1, 1};
  multiply_transposed(part, x, y);
  add_product(-2, part, y, z);
  for (std::size_t j = 0; j < 3; ++j) {
    double sum = 0;
    for (std::size_t i = 0; i < 4; ++i) sum += a(2 + i, 1 + j) * x[i];
    EXPECT_NEAR(y[j], sum, 1e-15);
  }
  for (std::size_t i = 0; i < 4; ++i) {
    double sum = 1;
    for (std::size_t j = 0; j < 3; ++j) sum -= 2 * a(2 + i, 1 + j) * y[j];
    EXPECT_NEAR(z[i], sum, 2e-15);
  }
}

TEST(Dense, OrthogonalFactorsMultiplyToTheMatrixAndSolveWithIt) {
  const Matrix a = random_matrix(9, 4, 3);
  const OrthogonalFactors f = orthogonal_factors(a.all());
  EXPECT_LT(largest_difference(product(f.q.all(), f.r.all()), a), 1e-14);
  Matrix unit(4, 4);
  for (std::size_t i = 0; i < 4; ++i) unit(i, i) = 1;
  EXPECT_LT(largest_difference(transposed_product(f.q.all(), f.q.all()), unit), 1e-14);
  for (std::size_t j = 0; j < 4; ++j)
    for (std::size_t i = j + 1; i < 4; ++i) EXPECT_EQ(f.r(i, j), 0);
  const Matrix given = random_matrix(4, 3, 4), beside = random_matrix(3, 4, 5);
  const Matrix left = product(f.r.all(), given.all()), right = product(beside.all(), f.r.all());
  solve_upper(f.r, left.all());
  solve_upper_from_right(f.r, right.all());
  EXPECT_LT(largest_difference(left, given), 1e-13);
  EXPECT_LT(largest_difference(right, beside), 1e-13);
}

// A rotation by 60 degrees along with the number 3: a conjugate pair and a real value.
TEST(Dense, EigenvectorsOfAConjugatePairAreItsRealAndImaginaryParts) {
  const double c = 0.5, s = std::sqrt(0.75);
  Matrix a(3, 3);
  a(0, 0) = a(1, 1) = c;
  a(0, 1) = -s;
  a(1, 0) = s;
  a(2, 2) = 3;
  a(0, 2) = 1;
  const Eigensystem e = eigensystem(a.all());
  ASSERT_EQ(e.values.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    const double real = e.values[k].real(), imaginary = e.values[k].imag();
    if (imaginary < 0) continue;
    const std::size_t other = imaginary > 0 ? k + 1 : k;
    for (std::size_t i = 0; i < 3; ++i) {
      double of_real = 0, of_imaginary = 0;
      for (std::size_t j = 0; j < 3; ++j) {
        of_real += a(i, j) * e.vectors(j, k);
        of_imaginary += a(i, j) * e.vectors(j, other);
      }
      const double second = imaginary > 0 ? imaginary : 0;
      EXPECT_NEAR(of_real, real * e.vectors(i, k) - second * e.vectors(i, other), 1e-14);
      if (imaginary > 0) {
        EXPECT_NEAR(of_imaginary, imaginary * e.vectors(i, k) + real * e.vectors(i, other), 1e-14);
      }
    }
  }
}

// A process may have no unknowns.
TEST(Dense, MatricesWithoutRowsMultiply) {
  const Matrix a(0, 3), b(0, 2);
  const Matrix product = transposed_product(a.all(), b.all());
  EXPECT_EQ(product.rows(), 3u);
  EXPECT_EQ(product(2, 1), 0);
  std::vector<double> y(3, 1.0);
  multiply_transposed(a.all(), {}, y);
  EXPECT_EQ(y, std::vector<double>(3, 0.0));
  EXPECT_EQ(square({}), 0);
}

}  // namespace
}  // namespace solidus::linear::dense
