/// The functions of BLAS that stand before those of the library give what their definition says, for one
/// vector and for several.
#include <dlfcn.h>
#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

extern "C" {
void dgemm_(const char*, const char*, const int*, const int*, const int*, const double*, const double*,
            const int*, const double*, const int*, const double*, double*, const int*);
void dtrsm_(const char*, const char*, const char*, const char*, const int*, const int*, const double*,
            const double*, const int*, double*, const int*);
}

namespace solidus {
namespace {

/// Numbers without a pattern, the same in every run.
std::vector<double> numbers(int n, double phase) {
  std::vector<double> values;
  for (int i = 0; i < n; ++i) values.push_back(std::sin(1.7 * i + phase));
  return values;
}

constexpr int k_leading = 9;  // columns lie further apart than they are long

double at(const std::vector<double>& a, bool transposed, int row, int column) {
  return a[static_cast<std::size_t>(transposed ? column + row * k_leading : row + column * k_leading)];
}

void expect_product(bool of_a, bool of_b, int m, int n, int k, double beta) {
  const std::vector<double> a = numbers(81, 0.3), b = numbers(81, 0.9), old = numbers(81, 2.0);
  std::vector<double> c = old;
  const double alpha = -1.5;
  dgemm_(of_a ? "T" : "n", of_b ? "t" : "N", &m, &n, &k, &alpha, a.data(), &k_leading, b.data(), &k_leading,
         &beta, c.data(), &k_leading);
  for (int row = 0; row < m; ++row)
    for (int column = 0; column < n; ++column) {
      double expected = beta * at(old, false, row, column);
      for (int i = 0; i < k; ++i) expected += alpha * at(a, of_a, row, i) * at(b, of_b, i, column);
      EXPECT_NEAR(at(c, false, row, column), expected, 1e-14)
          << m << ' ' << n << ' ' << k << ' ' << of_a << of_b;
    }
}

TEST(ProductsWithVectors, ProductsAreThoseOfTheDefinition) {
  for (const bool of_a : {false, true})
    for (const bool of_b : {false, true})
      for (const int n : {1, 4})
        for (const int k : {0, 1, 5})
          for (const double beta : {0.0, 1.0, -0.5}) expect_product(of_a, of_b, 6, n, k, beta);
}

TEST(ProductsWithVectors, WhatIsOverwrittenIsNotRead) {
  const std::vector<double> a = numbers(81, 0.3), b = numbers(81, 0.9);
  const int m = 6, n = 1, k = 5;
  const double alpha = 1, beta = 0;
  std::vector<double> c(9, std::numeric_limits<double>::quiet_NaN());
  dgemm_("N", "N", &m, &n, &k, &alpha, a.data(), &k_leading, b.data(), &k_leading, &beta, c.data(),
         &k_leading);
  for (int i = 0; i < m; ++i) EXPECT_TRUE(std::isfinite(c[static_cast<std::size_t>(i)]));
}

void expect_solution(const std::string& options, int n, double alpha) {
  std::vector<double> a = numbers(81, 0.3);
  for (int i = 0; i < k_leading; ++i) a[static_cast<std::size_t>(i + i * k_leading)] += 3;
  const std::vector<double> b = numbers(81, 0.9);
  const bool upper = options[0] == 'U', transposed = options[1] == 'T', unit = options[2] == 'U';
  const int m = 6;
  std::vector<double> x = b;
  dtrsm_("L", &options[0], &options[1], &options[2], &m, &n, &alpha, a.data(), &k_leading, x.data(),
         &k_leading);
  // The triangle times what was found is what was given.
  for (int column = 0; column < n; ++column)
    for (int row = 0; row < m; ++row) {
      double product = 0;
      for (int i = 0; i < m; ++i) {
        const int r = transposed ? i : row, c = transposed ? row : i;
        if (upper ? c < r : c > r) continue;
        product += (r == c && unit ? 1.0 : at(a, false, r, c)) * at(x, false, i, column);
      }
      EXPECT_NEAR(product, alpha * at(b, false, row, column), 1e-13) << options << ' ' << n;
    }
}

TEST(ProductsWithVectors, TriangularSolutionsAreThoseOfTheDefinition) {
  for (const std::string options : {"UNN", "UTN", "LNN", "LTN", "UNU", "LTU"})
    for (const int n : {1, 3})
      for (const double alpha : {1.0, -2.0}) expect_solution(options, n, alpha);
}

TEST(ProductsWithVectors, LibrariesCallThisProgramsFunctions) {
  // What MUMPS finds by its name is the function of the program, before the one of the library of BLAS.
  for (const char* name : {"dgemm_", "dtrsm_"}) {
    Dl_info info;
    ASSERT_NE(dladdr(dlsym(RTLD_DEFAULT, name), &info), 0);
    EXPECT_THAT(std::string(info.dli_fname), testing::Not(testing::HasSubstr("blas"))) << name;
  }
}

}  // namespace
}  // namespace solidus
