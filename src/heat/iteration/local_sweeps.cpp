/// The rows of the chosen nodes are copied into a compact matrix of their own, on which sweeps run without
/// touching the rest.
#include "heat/iteration/local_sweeps.hpp"

#include <algorithm>
#include <limits>

#include "numbers/index_casts.hpp"

namespace solidus::heat {

LocalSweeps::LocalSweeps(const linear::BlockMatrix& matrix, std::span<const double> residual,
                         std::span<const char> fixed, const parallel::GhostExchange& ghosts)
    : ghosts_(ghosts) {
  // The nodes that are swept are those whose residual is above the mean: the front.
  const std::size_t n = residual.size();
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i)
    if (fixed[i] == 0) sum += std::abs(residual[i]);
  sum_ = parallel::global_sum(sum);
  mean_ = sum_ / parallel::global_sum(static_cast<double>(n));
  for (std::size_t i = 0; i < n; ++i) {
    if (fixed[i] != 0 || !(std::abs(residual[i]) >= mean_)) continue;
    nodes_.push_back(static_cast<std::uint32_t>(i));
    residual_.push_back(residual[i]);
  }
  // Their rows are copied in single precision. Rows of other processes are reached by couplings of their own,
  // and changes are exchanged.
  copy_rows(matrix, n);
  if (parallel::any_process(n < fixed.size())) {
    copy_couplings(matrix, n);
    change_.resize(fixed.size());
  }
}

/// Copies the entries between chosen nodes, mirror images included where the matrix keeps half of them.
void LocalSweeps::copy_rows(const linear::BlockMatrix& matrix, std::size_t n_owned) {
  constexpr auto k_none = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> position(n_owned, k_none);
  // The place of each chosen node among the chosen ones.
  for (std::size_t k = 0; k < nodes_.size(); ++k) position[nodes_[k]] = static_cast<std::uint32_t>(k);
  const std::span<const std::int64_t> row_start = matrix.row_start();
  const std::span<const Index> columns = matrix.columns();
  const double* values = matrix.block(0);
  const bool half = matrix.storage() == linear::BlockMatrix::Storage::upper;
  // Each entry between two chosen nodes once, and its mirror image where only half is stored.
  const auto for_entries = [&](const auto& take) {
    for (std::size_t k = 0; k < nodes_.size(); ++k)
      for (std::int64_t s = row_start[nodes_[k]]; s < row_start[nodes_[k] + 1]; ++s) {
        const auto column = as_size(columns[as_size(s)]);
        const std::uint32_t other = column < n_owned ? position[column] : k_none;
        if (other == k_none) continue;
        take(k, other, values[s]);
        if (half && other != k) take(other, static_cast<std::uint32_t>(k), values[s]);
      }
  };
  // First how many each row has, then where it starts, then the entries: float is enough for sweeps
  // that only improve a guess.
  start_.assign(nodes_.size() + 1, 0);
  for_entries([&](std::size_t row, std::uint32_t, double) { ++start_[row + 1]; });
  for (std::size_t k = 0; k < nodes_.size(); ++k) start_[k + 1] += start_[k];
  neighbours_.resize(start_.back());
  std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
  for_entries([&](std::size_t row, std::uint32_t other, double entry) {
    neighbours_[next[row]++] = {other, static_cast<float>(entry)};
  });
}

/// Notes the entries with nodes of other processes; their magnitudes go onto the diagonals.
void LocalSweeps::copy_couplings(const linear::BlockMatrix& matrix, std::size_t n_owned) {
  const std::span<const std::int64_t> row_start = matrix.row_start();
  const std::span<const Index> columns = matrix.columns();
  const double* values = matrix.block(0);
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    // The magnitudes on the diagonal keep a sweep stable although the values of the other process
    // are old.
    float magnitudes = 0;
    for (std::int64_t s = row_start[nodes_[k]]; s < row_start[nodes_[k] + 1]; ++s) {
      const Index column = columns[as_size(s)];
      if (as_size(column) < n_owned) continue;
      const auto entry = static_cast<float>(values[s]);
      couplings_.push_back({static_cast<std::uint32_t>(k), column, entry});
      magnitudes += std::abs(entry);
    }
    if (magnitudes == 0.0F) continue;
    for (std::uint32_t s = start_[k]; s < start_[k + 1]; ++s)
      if (neighbours_[s].position == k) neighbours_[s].entry += magnitudes;
  }
}

/// Puts the changes of other processes' nodes in place of the magnitudes that stood on the diagonals for
/// them.
void LocalSweeps::follow_other_processes() {
  ghosts_.update(change_, 1);
  for (const Coupling& c : couplings_)
    residual_[c.position] += static_cast<double>(c.entry) * change_[as_size(c.ghost)] -
                             static_cast<double>(std::abs(c.entry)) * change_[nodes_[c.position]];
  std::fill(change_.begin(), change_.end(), 0.0);
}

}  // namespace solidus::heat
