#include "heat/local_sweeps.hpp"

#include <cmath>

#include "algebra/parallel.hpp"

namespace solidus::heat {

LocalSweeps::LocalSweeps(const algebra::BlockMatrix& matrix, std::span<const double> residual,
                         std::span<const char> fixed, double share)
    : matrix_(matrix) {
  const std::size_t n = residual.size();
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i)
    if (fixed[i] == 0) sum += std::abs(residual[i]);
  sum_ = algebra::global_sum(sum);
  threshold_ = share * sum_ / algebra::global_sum(static_cast<double>(n));
  const std::span<const std::int64_t> start = matrix.row_start();
  const std::span<const Index> columns = matrix.columns();
  const auto beside_others = [&](std::size_t i) {
    for (std::int64_t s = start[i]; s < start[i + 1]; ++s)
      if (static_cast<std::size_t>(columns[static_cast<std::size_t>(s)]) >= n) return true;
    return false;
  };
  for (std::size_t i = 0; i < n; ++i)
    if (fixed[i] == 0 && std::abs(residual[i]) >= threshold_ && !beside_others(i)) nodes_.push_back(i);
  change_.resize(n);
  ahead_.resize(n);
}

/// Adds to F of later nodes what the change of this one makes of it. A row has its later columns in either
/// storage of the matrix.
void LocalSweeps::add_to_later(std::size_t node, std::span<double> residual) const {
  const std::span<const std::int64_t> start = matrix_.row_start();
  const std::span<const Index> columns = matrix_.columns();
  const double* values = matrix_.block(0);
  for (std::int64_t s = start[node]; s < start[node + 1]; ++s) {
    const auto j = static_cast<std::size_t>(columns[static_cast<std::size_t>(s)]);
    if (j > node) residual[j] += values[s] * change_[node].potential;
  }
}

/// What the changes of later nodes add to F of this one.
double LocalSweeps::of_later(std::size_t node) const {
  const std::span<const std::int64_t> start = matrix_.row_start();
  const std::span<const Index> columns = matrix_.columns();
  const double* values = matrix_.block(0);
  double sum = 0;
  for (std::int64_t s = start[node]; s < start[node + 1]; ++s) {
    const auto j = static_cast<std::size_t>(columns[static_cast<std::size_t>(s)]);
    if (j > node) sum += values[s] * change_[j].potential;
  }
  return sum;
}

/// Brings F up to date. The matrix is symmetric: the entries before the diagonal are those of earlier rows.
void LocalSweeps::follow(std::span<double> residual) {
  const std::span<const std::int64_t> start = matrix_.row_start();
  const std::span<const Index> columns = matrix_.columns();
  const double* values = matrix_.block(0);
  const bool half = matrix_.storage() == algebra::BlockMatrix::Storage::upper;
  for (const std::size_t i : nodes_) {
    const double change = change_[i].potential;
    residual[i] += change_[i].stored;
    for (std::int64_t s = start[i]; s < start[i + 1]; ++s) {
      const auto j = static_cast<std::size_t>(columns[static_cast<std::size_t>(s)]);
      if (j == i || half) residual[i] += values[s] * change_[j].potential;
      if (j != i) residual[j] += values[s] * change;
    }
  }
}

}  // namespace solidus::heat
