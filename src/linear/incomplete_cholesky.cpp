/// Row by row in single precision; fill without a place is taken from what the diagonal can bear, and a
/// shift is tried where pivots become negative.
#include "linear/incomplete_cholesky.hpp"

#include <algorithm>
#include <array>
#include <cassert>

#include "numbers/index_casts.hpp"

namespace solidus::linear {

namespace {

/// A pivot below this share of the diagonal it came from has lost its digits.
constexpr float k_least_pivot = 1e-4F;
/// Fill without a place that a row bears before the rest goes to its diagonal, over the sum of the row.
constexpr float k_borne_fill = 0.3F;
/// Share of a row's entries with nodes of other processes that goes to its diagonal.
constexpr float k_across = 0.7F;
/// Shares of the diagonal that are added to it one after the other until no pivot is negative.
constexpr std::array k_shifts = {0.0F, 0.01F, 0.04F, 0.16F, 0.64F, 2.56F};

}  // namespace

/// Columns of other processes are last.
std::int64_t IncompleteCholesky::end_of_owned(std::size_t row) const {
  std::int64_t end = start_[row + 1];
  while (column_[as_size(end) - 1] >= as_index(work_.size())) --end;
  return end;
}

void IncompleteCholesky::set_up(BlockMatrix& a, Fill fill) {
  assert(a.block_size() == 1 && a.storage() == BlockMatrix::Storage::upper);
  start_ = a.row_start();
  column_ = a.columns();
  work_.resize(start_.size() - 1);
  factor_.resize(column_.size());
  a.constrained([&] {
    for (const float shift : k_shifts)
      if (factorise(a.block(0), shift, fill)) break;
  });
}

/// Returns whether no pivot was negative beyond rounding.
bool IncompleteCholesky::factorise(const double* values, float shift, Fill fill) {
  bool positive = true;
  // Single precision halves the memory; the factor only preconditions.
  std::transform(values, values + column_.size(), factor_.begin(),
                 [](double v) { return static_cast<float>(v); });
  std::vector<float>& bears = work_;
  // What of the fill that is dropped a row may bear without losing its positive diagonal.
  find_borne_fill(values, bears);
  for (std::size_t row = 0; row < work_.size(); ++row) {
    const std::int64_t diagonal = start_[row], end = end_of_owned(row);
    float& pivot = factor_[as_size(diagonal)];
    // The shift raises the diagonal where an attempt without it has met negative pivots.
    const float original = (1.0F + shift) * static_cast<float>(values[diagonal]);
    pivot += shift * static_cast<float>(values[diagonal]);
    // Couplings to other processes are left out; a part of them goes onto the diagonal.
    for (std::int64_t s = end; s < start_[row + 1]; ++s) pivot += k_across * factor_[as_size(s)];
    if (bears[row] < 0.0F) pivot += bears[row];
    if (pivot < -k_least_pivot * original) positive = false;
    // A pivot that is too small would dominate the factor: its row then counts with its own
    // diagonal.
    if (!(pivot > k_least_pivot * original)) pivot = original;
    // The row is taken out of those below, then divided by its pivot.
    if (fill == Fill::pattern)
      eliminate(as_index(row), end, bears);
    else
      eliminate_on_diagonal(as_index(row), end, bears);
    const float inverse = pivot != 0.0F ? 1.0F / pivot : 1.0F;
    for (std::int64_t s = diagonal + 1; s < end; ++s) factor_[as_size(s)] *= inverse;
    pivot = inverse;
  }
  return positive;
}

/// The fill that each row bears, from the sum of the row.
void IncompleteCholesky::find_borne_fill(const double* values, std::span<float> bears) const {
  std::fill(bears.begin(), bears.end(), 0.0F);
  for (std::size_t row = 0; row < bears.size(); ++row) {
    const std::int64_t diagonal = start_[row], end = end_of_owned(row);
    // The sum holds the entries that earlier rows share with this row; its own entries cancel most of them.
    double sum = static_cast<double>(bears[row]) + values[diagonal];
    for (std::int64_t s = diagonal + 1; s < end; ++s) {
      sum += values[s];
      bears[as_size(column_[as_size(s)])] += static_cast<float>(values[s]);
    }
    for (std::int64_t s = end; s < start_[row + 1]; ++s) sum += values[s];
    bears[row] = k_borne_fill * static_cast<float>(sum);
  }
}

/// Takes the row out of those below it that it couples with. Fill that has no place in the pattern is taken
/// from what its row and its column still bear.
void IncompleteCholesky::eliminate(Index row, std::int64_t end, std::span<float> bears) {
  const std::int64_t diagonal = start_[as_size(row)];
  const float pivot = factor_[as_size(diagonal)];
  if (pivot == 0.0F) return;
  for (std::int64_t s = diagonal + 1; s < end; ++s) {
    const float share = factor_[as_size(s)] / pivot;
    const std::size_t below = as_size(column_[as_size(s)]);
    // Both rows are sorted by column, so one pass along each finds the places.
    std::int64_t to = start_[below];
    const std::int64_t last = start_[below + 1];
    for (std::int64_t t = s; t < end; ++t) {
      const Index column = column_[as_size(t)];
      while (to < last && column_[as_size(to)] < column) ++to;
      const float change = share * factor_[as_size(t)];
      if (to < last && column_[as_size(to)] == column) {
        factor_[as_size(to)] -= change;
      } else {
        bears[below] -= change;
        bears[as_size(column)] -= change;
      }
    }
  }
}

/// The same where no entry off the diagonal changes: of row j's fill Σ_k u_j u_k / d over k ≠ j only the sum
/// is needed, so that one pass along the row does.
void IncompleteCholesky::eliminate_on_diagonal(Index row, std::int64_t end, std::span<float> bears) {
  const std::int64_t diagonal = start_[as_size(row)];
  const float pivot = factor_[as_size(diagonal)];
  if (pivot == 0.0F) return;
  float sum = 0.0F;
  for (std::int64_t s = diagonal + 1; s < end; ++s) sum += factor_[as_size(s)];
  const float inverse = 1.0F / pivot;
  for (std::int64_t s = diagonal + 1; s < end; ++s) {
    const float value = factor_[as_size(s)], share = value * inverse;
    const std::size_t below = as_size(column_[as_size(s)]);
    factor_[as_size(start_[below])] -= share * value;
    bears[below] -= share * (sum - value);
  }
}

void IncompleteCholesky::apply(std::span<const double> r, std::span<double> z) {
  const std::span<const float> found = apply(r);
  std::copy(found.begin(), found.end(), z.begin());
}

std::span<const float> IncompleteCholesky::apply(std::span<const double> r) {
  const std::size_t n = work_.size();
  std::transform(r.begin(), r.end(), work_.begin(), [](double v) { return static_cast<float>(v); });
  // Forward and backward substitution with the rows of this process; single precision suffices for a
  // preconditioner.
  for (std::size_t row = 0; row < n; ++row) {
    const std::int64_t diagonal = start_[row], end = end_of_owned(row);
    const float value = work_[row];
    for (std::int64_t s = diagonal + 1; s < end; ++s)
      work_[as_size(column_[as_size(s)])] -= factor_[as_size(s)] * value;
    work_[row] = factor_[as_size(diagonal)] * value;
  }
  for (std::size_t row = n; row-- > 0;) {
    float value = work_[row];
    for (std::int64_t s = start_[row] + 1, end = end_of_owned(row); s < end; ++s)
      value -= factor_[as_size(s)] * work_[as_size(column_[as_size(s)])];
    work_[row] = value;
  }
  return work_;
}

}  // namespace solidus::linear
