/// Greedy aggregation in three sweeps over the rows: whole neighbourhoods, rows that join one, and what is
/// left over.
#include "multigrid/aggregates.hpp"

#include <cmath>
#include <cstdint>
#include <span>

#include "numbers/index_casts.hpp"

namespace solidus::multigrid {

namespace {

/// A coupling below this share of the geometric mean of the two diagonals is weak. Jumps of a hundred in the
/// stiffness leave none that is, those of ten thousand, from solid to melt, do.
constexpr double k_weak = 0.01;
constexpr Index k_none = k_no_aggregate;

bool is_diagonal(const double* block, int size) {
  for (int r = 0; r < size; ++r)
    for (int c = 0; c < size; ++c)
      if (r != c && block[r * size + c] != 0) return false;
  return true;
}

double squared_norm(const double* block, int size) {
  double sum = 0;
  for (int i = 0; i < size * size; ++i) sum += block[i] * block[i];
  return sum;
}

/// The rows of this process that each row is strongly coupled with, itself included.
struct StrongCouplings {
  std::vector<std::int64_t> start{0};
  std::vector<Index> column;

  explicit StrongCouplings(const MatrixView& a);
  std::span<const Index> of(Index row) const {
    return std::span(column).subspan(as_size(start[as_size(row)]),
                                     as_size(start[as_size(row) + 1] - start[as_size(row)]));
  }
};

StrongCouplings::StrongCouplings(const MatrixView& a) {
  const Index n = a.n_rows();
  std::vector<double> diagonal(as_size(n), 0.0);  // norms
  // The norm of each diagonal block, by which a coupling is strong or weak.
  for (Index row = 0; row < n; ++row)
    a.each(row, [&](Index j, std::int64_t s, bool) {
      if (j == row) diagonal[as_size(row)] = std::sqrt(squared_norm(a.block(s), a.size));
    });
  // A coupling is strong if its norm is a share of the geometric mean of both diagonals.
  for (Index row = 0; row < n; ++row) {
    a.each(row, [&](Index j, std::int64_t s, bool) {
      if (j >= n) return;
      if (j == row ||
          squared_norm(a.block(s), a.size) > k_weak * k_weak * diagonal[as_size(row)] * diagonal[as_size(j)])
        column.push_back(j);
    });
    start.push_back(static_cast<std::int64_t>(column.size()));
  }
}

}  // namespace

Index aggregate(const MatrixView& a, std::vector<Index>& of_row) {
  const Index n = a.n_rows();
  of_row.assign(as_size(n), k_none);
  Index n_aggregates = 0;
  const StrongCouplings strong(a);
  // Rows without strong neighbours in this process join no aggregate, unless they are bodies by
  // themselves.
  const auto each_neighbour = [&](Index row, const auto& f) {
    for (const Index j : strong.of(row)) f(j);
  };
  std::vector<char> alone(as_size(n), 1);
  for (Index row = 0; row < n; ++row) {
    if (strong.of(row).size() > 1) alone[as_size(row)] = 0;
    // A row without neighbours that is a body of its own, or couples with other processes alone.
    bool coupled = false, own = false;
    a.each(row, [&](Index j, std::int64_t s, bool) {
      if (j == row)
        own = !is_diagonal(a.block(s), a.size);
      else
        coupled = coupled || j < n;
    });
    if (own && !coupled) alone[as_size(row)] = 0;
  }
  // First: a row all of whose neighbours are free makes an aggregate of all of them.
  for (Index row = 0; row < n; ++row) {
    bool free = alone[as_size(row)] == 0;
    if (free) each_neighbour(row, [&](Index j) { free = free && of_row[as_size(j)] == k_none; });
    if (!free) continue;
    each_neighbour(row, [&](Index j) { of_row[as_size(j)] = n_aggregates; });
    ++n_aggregates;
  }
  // To the smallest aggregate in reach, as it was before: a row that joins does not draw its neighbours
  // along.
  const std::vector<Index> first = of_row;
  std::vector<Index> members(as_size(n_aggregates), 0);
  for (const Index aggregate : first)
    if (aggregate != k_none) ++members[as_size(aggregate)];
  for (Index row = 0; row < n; ++row) {
    if (first[as_size(row)] != k_none || alone[as_size(row)] != 0) continue;
    Index best = k_none;
    // Of the aggregates around it the one with the fewest members, so that all stay of one size.
    each_neighbour(row, [&](Index j) {
      const Index candidate = first[as_size(j)];
      if (candidate != k_none && (best == k_none || members[as_size(candidate)] < members[as_size(best)]))
        best = candidate;
    });
    if (best == k_none) continue;
    of_row[as_size(row)] = best;
    ++members[as_size(best)];
  }
  // At last rows that no aggregate touches make new ones with what is still free around them.
  for (Index row = 0; row < n; ++row) {
    if (of_row[as_size(row)] != k_none || alone[as_size(row)] != 0) continue;
    each_neighbour(row, [&](Index j) {
      if (of_row[as_size(j)] == k_none) of_row[as_size(j)] = n_aggregates;
    });
    ++n_aggregates;
  }
  return n_aggregates;
}

}  // namespace solidus::multigrid
