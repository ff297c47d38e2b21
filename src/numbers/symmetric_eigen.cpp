/// Sweeps of Jacobi's rotations until all entries off the diagonal are rounding.
#include "numbers/symmetric_eigen.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numbers/index_casts.hpp"

namespace solidus {

namespace {

constexpr int k_most_sweeps = 60;  // five or six do

/// A symmetric matrix of which both halves are kept.
struct Rotated {
  std::span<double> a, v;
  std::size_t n;

  double& at(std::size_t i, std::size_t j) { return a[i * n + j]; }

  /// Turns the axes p and q so that the entry between them is zero.
  void rotate(std::size_t p, std::size_t q) {
    const double between = at(p, q);
    if (between == 0) return;
    // Jacobi's rotation: the tangent of the smaller angle, which is the stable one.
    const double half = 0.5 * (at(q, q) - at(p, p)) / between;
    const double tangent = std::copysign(1 / (std::abs(half) + std::sqrt(half * half + 1)), half);
    const double c = 1 / std::sqrt(tangent * tangent + 1), s = tangent * c;
    at(p, p) -= tangent * between;
    at(q, q) += tangent * between;
    at(p, q) = at(q, p) = 0;
    // Rows and columns p and q of the matrix, then the vectors.
    for (std::size_t k = 0; k < n; ++k) {
      if (k == p || k == q) continue;
      const double of_p = at(k, p), of_q = at(k, q);
      at(k, p) = at(p, k) = c * of_p - s * of_q;
      at(k, q) = at(q, k) = s * of_p + c * of_q;
    }
    for (std::size_t k = 0; k < n && !v.empty(); ++k) {
      const double of_p = v[p * n + k], of_q = v[q * n + k];
      v[p * n + k] = c * of_p - s * of_q;
      v[q * n + k] = s * of_p + c * of_q;
    }
  }
};

}  // namespace

void find_symmetric_eigen(std::span<double> matrix, std::span<double> values, std::span<double> vectors) {
  const std::size_t n = values.size();
  // The upper triangle is mirrored, and the sum of squares gives a size to measure rounding with.
  Rotated m{matrix, vectors, n};
  double size = 0;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i; j < n; ++j) {
      m.at(j, i) = m.at(i, j);
      size += m.at(i, j) * m.at(i, j);
    }
  // Values that are no numbers would never come to rest.
  if (!std::isfinite(size)) {
    std::fill(values.begin(), values.end(), std::numeric_limits<double>::quiet_NaN());
    return;
  }
  std::fill(vectors.begin(), vectors.end(), 0.0);
  for (std::size_t i = 0; i < n && !vectors.empty(); ++i) vectors[i * n + i] = 1;
  // Jacobi's method: each rotation makes one pair of entries off the diagonal zero and lowers the sum of
  // their squares. After a few sweeps over all pairs that sum is rounding.
  const double rounding = std::numeric_limits<double>::epsilon() * std::numeric_limits<double>::epsilon();
  for (int sweep = 0; sweep < k_most_sweeps; ++sweep) {
    double beside = 0;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i + 1; j < n; ++j) beside += m.at(i, j) * m.at(i, j);
    if (!(beside > 1e-4 * rounding * size)) break;
    for (std::size_t p = 0; p < n; ++p)
      for (std::size_t q = p + 1; q < n; ++q) m.rotate(p, q);
  }
  // What is left on the diagonal are the eigenvalues. They are sorted in ascending order, and the columns of
  // the vectors with them.
  for (std::size_t i = 0; i < n; ++i) values[i] = m.at(i, i);
  for (std::size_t i = 0; i < n; ++i) {
    const auto least = as_size(
        std::min_element(values.begin() + static_cast<std::ptrdiff_t>(i), values.end()) - values.begin());
    if (least == i) continue;
    std::swap(values[i], values[least]);
    for (std::size_t k = 0; k < n && !vectors.empty(); ++k)
      std::swap(vectors[i * n + k], vectors[least * n + k]);
  }
}

SymmetricEigen symmetric_eigen(std::vector<double> matrix, std::size_t n) {
  SymmetricEigen result{std::vector<double>(n), std::vector<double>(n * n)};
  find_symmetric_eigen(matrix, result.values, result.vectors);
  return result;
}

}  // namespace solidus
