/// Eigenvalues and eigenvectors of small symmetric matrices by Jacobi's rotations: each sets one entry off
/// the diagonal to zero, and sweeps over all of them converge quadratically (G. H. Golub and C. F. Van Loan,
/// Matrix Computations, 4th ed. 2013, section 8.5). Small eigenvalues are as exact as large ones.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace solidus {

/// @param matrix   n × n, of which the diagonal and what is above it are read; overwritten
/// @param values   n, rising
/// @param vectors  n × n, one orthonormal vector a row in the order of the values; empty: not asked for
/// An entry that is not finite makes all values NaN.
void find_symmetric_eigen(std::span<double> matrix, std::span<double> values, std::span<double> vectors);

struct SymmetricEigen {
  std::vector<double> values;   ///< rising
  std::vector<double> vectors;  ///< [value][component]
};
SymmetricEigen symmetric_eigen(std::vector<double> matrix, std::size_t n);

}  // namespace solidus
