/// Eigenvalues and eigenvectors of small symmetric matrices (symmetric_eigen.hpp).
#include "numbers/symmetric_eigen.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace solidus {
namespace {

/// Largest entry of A v − λ v over all pairs, and of VᵀV − 1.
double defect(const std::vector<double>& a, std::size_t n, const SymmetricEigen& e) {
  double largest = 0;
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t i = 0; i < n; ++i) {
      double product = -e.values[k] * e.vectors[k * n + i], scalar = i == k ? -1 : 0;
      for (std::size_t j = 0; j < n; ++j) {
        product += a[i * n + j] * e.vectors[k * n + j];
        scalar += e.vectors[k * n + j] * e.vectors[i * n + j];
      }
      largest = std::max({largest, std::abs(product), std::abs(scalar)});
    }
  return largest;
}

TEST(SymmetricEigen, FindsValuesInOrderAndOrthonormalVectorsOfRandomMatrices) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> entry(-1, 1);
  for (const std::size_t n : {1u, 2u, 3u, 6u, 15u})
    for (int sample = 0; sample < 50; ++sample) {
      std::vector<double> a(n * n);
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = i; j < n; ++j) a[i * n + j] = a[j * n + i] = entry(random);
      const SymmetricEigen e = symmetric_eigen(a, n);
      EXPECT_TRUE(std::is_sorted(e.values.begin(), e.values.end()));
      EXPECT_LT(defect(a, n, e), 1e-14 * static_cast<double>(n) + 1e-15);
    }
}

TEST(SymmetricEigen, ADiagonalMatrixIsSortedAndKeepsItsBits) {
  const SymmetricEigen e = symmetric_eigen({3, 0, 0, 0, -1e-30, 0, 0, 0, 1e100}, 3);
  EXPECT_EQ(e.values, (std::vector<double>{-1e-30, 3, 1e100}));
  EXPECT_EQ(e.vectors, (std::vector<double>{0, 1, 0, 1, 0, 0, 0, 0, 1}));
}

TEST(SymmetricEigen, OfAStateOfStressThePrincipalOnesInPascal) {
  // Pure shear of 100 MPa along with a pressure of 1 Pa.
  const SymmetricEigen e = symmetric_eigen({0, 1e8, 0, 1e8, 0, 0, 0, 0, -1}, 3);
  EXPECT_DOUBLE_EQ(e.values[0], -1e8);
  EXPECT_DOUBLE_EQ(e.values[1], -1);
  EXPECT_DOUBLE_EQ(e.values[2], 1e8);
}

TEST(SymmetricEigen, AnEntryThatIsNoNumberMakesValuesThatAreNone) {
  const SymmetricEigen e = symmetric_eigen({1, std::nan(""), std::nan(""), 1}, 2);
  EXPECT_TRUE(std::isnan(e.values[0]) && std::isnan(e.values[1]));
}

}  // namespace
}  // namespace solidus
