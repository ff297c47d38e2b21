#include "multigrid/aggregation.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "multigrid/aggregates.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "system/processes.hpp"

namespace solidus::multigrid {

namespace {

constexpr double k_smoothing = 4.0 / 3.0;  ///< ω times the largest eigenvalue of D⁻¹ A
constexpr Index k_none = k_no_aggregate;
constexpr double k_dependent = 1e-8;      ///< a mode that keeps less of its length depends on those before
constexpr double k_no_stiffness = 1e-12;  ///< a coarse diagonal below this share of the mean is no mode

/// Modified Gram-Schmidt, twice, on the rows of one aggregate: Q over the modes, R to the coarse level.
/// Columns that depend on others become zero.
void orthonormalise(std::vector<double>& q, std::size_t n_rows, int modes, double* r) {
  const auto n = as_size(modes);
  const auto dot = [&](std::size_t a, std::size_t b) {
    double sum = 0;
    for (std::size_t i = 0; i < n_rows; ++i) sum += q[i * n + a] * q[i * n + b];
    return sum;
  };
  std::fill_n(r, n * n, 0.0);
  for (std::size_t k = 0; k < n; ++k) {
    const double length = std::sqrt(dot(k, k));
    for (int pass = 0; pass < 2; ++pass)
      for (std::size_t j = 0; j < k; ++j) {
        const double share = dot(j, k);
        r[j * n + k] += share;
        for (std::size_t i = 0; i < n_rows; ++i) q[i * n + k] -= share * q[i * n + j];
      }
    const double left = std::sqrt(dot(k, k));
    const bool depends = !(left > k_dependent * length);
    r[k * n + k] = depends ? 0.0 : left;
    for (std::size_t i = 0; i < n_rows; ++i) q[i * n + k] = depends ? 0.0 : q[i * n + k] / left;
  }
}

/// P₀ as one block a row, [owned row × size][modes], and the near-null space of the coarse level.
std::vector<float> tentative(const std::vector<Index>& of_row, Index n_aggregates, int size,
                             std::span<const double> near_null, int modes, std::span<const char> fixed,
                             std::vector<double>& coarse_modes) {
  const auto n = as_size(modes), bs = as_size(size);
  std::vector<std::int64_t> start(as_size(n_aggregates) + 1, 0);
  for (const Index aggregate : of_row)
    if (aggregate != k_none) ++start[as_size(aggregate) + 1];
  for (std::size_t i = 1; i < start.size(); ++i) start[i] += start[i - 1];
  std::vector<Index> rows(as_size(start.back()));
  std::vector<std::int64_t> next(start.begin(), start.end() - 1);
  for (std::size_t row = 0; row < of_row.size(); ++row)
    if (of_row[row] != k_none) rows[as_size(next[as_size(of_row[row])]++)] = as_index(row);

  // Each aggregate's rows of the modes become orthonormal; what was divided off is the mode of the
  // coarse level.
  std::vector<float> p(of_row.size() * bs * n);
  coarse_modes.assign(as_size(n_aggregates) * n * n, 0.0);
  std::vector<double> q;
  for (std::size_t aggregate = 0; aggregate < as_size(n_aggregates); ++aggregate) {
    const std::span<const Index> members(rows.data() + start[aggregate],
                                         as_size(start[aggregate + 1] - start[aggregate]));
    q.clear();
    for (const Index row : members)
      q.insert(q.end(), near_null.begin() + row * size * modes, near_null.begin() + (row + 1) * size * modes);
    orthonormalise(q, members.size() * bs, modes, coarse_modes.data() + aggregate * n * n);
    for (std::size_t i = 0; i < members.size(); ++i)
      for (std::size_t k = 0; k < bs; ++k) {
        const std::size_t row = as_size(members[i]) * bs + k;
        if (!fixed.empty() && fixed[row] != 0) continue;
        for (std::size_t m = 0; m < n; ++m) p[row * n + m] = static_cast<float>(q[(i * bs + k) * n + m]);
      }
  }
  return p;
}

/// Blocks gathered by column: a row of a product while it is made.
class RowSum {
 public:
  RowSum(Index n_columns, int entries) : entries_(entries), place_(as_size(n_columns), k_none) {}
  void clear() {
    for (const Index column : columns_) place_[as_size(column)] = k_none;
    columns_.clear();
    values_.clear();
  }
  double* block(Index column) {
    Index& place = place_[as_size(column)];
    if (place == k_none) {
      place = as_index(columns_.size());
      columns_.push_back(column);
      values_.resize(values_.size() + as_size(entries_), 0.0);
    }
    return values_.data() + std::int64_t{place} * entries_;
  }
  const std::vector<Index>& columns() const { return columns_; }

 private:
  int entries_;
  std::vector<Index> place_, columns_;
  std::vector<double> values_;
};

/// c += a b of row-major blocks, or aᵀ b.
template <int size, int modes>
void add_product(const double* a, bool transposed, const float* b, double* c) {
  const int row = transposed ? 1 : size, column = transposed ? size : 1;
  for (int r = 0; r < size; ++r)
    for (int k = 0; k < size; ++k)
      for (int m = 0; m < modes; ++m)
        c[r * modes + m] += a[r * row + k * column] * static_cast<double>(b[k * modes + m]);
}

/// c += aᵀ b of row-major blocks.
template <int size, int modes>
void add_transposed_product(const float* a, const double* b, double* c) {
  for (int k = 0; k < modes; ++k)
    for (int r = 0; r < size; ++r)
      for (int m = 0; m < modes; ++m)
        c[k * modes + m] += static_cast<double>(a[r * modes + k]) * b[r * modes + m];
}

/// Reserves the memory that smooth() needs, and no more.
void reserve_smoothed(const MatrixView& a, const std::vector<Index>& of_row, Index n_coarse,
                      BlockRows<float>& p) {
  RowSum reached(n_coarse, 0);
  std::size_t n_slots = 0;
  for (Index row = 0; row < a.n_rows(); ++row) {
    reached.clear();
    a.each(row, [&](Index j, std::int64_t, bool) {
      if (of_row[as_size(j)] != k_none) reached.block(of_row[as_size(j)]);
    });
    n_slots += reached.columns().size();
  }
  p.start.reserve(as_size(a.n_rows()) + 1);
  p.column.reserve(n_slots);
  p.value.reserve(n_slots * as_size(p.block_entries()) + PackedRows::k_overhang);
}

template <int size, int modes>
void smooth(const MatrixView& a, const std::vector<Index>& of_row, Index n_coarse,
            const std::vector<float>& tentative, std::span<const char> fixed,
            std::span<const float> inverse_diagonal, double omega, BlockRows<float>& p) {
  // The prolongation is P = (I − ω D⁻¹ A) T, with T the tentative one, row by row of blocks.
  constexpr int k_entries = size * modes;
  reserve_smoothed(a, of_row, n_coarse, p);
  RowSum sum(n_coarse, k_entries);
  for (Index row = 0; row < a.n_rows(); ++row) {
    // First the row of A T is summed, one block for each aggregate that the row reaches. Ghosts bring their
    // aggregate and their tentative values along.
    sum.clear();
    const float* const own = tentative.data() + as_size(row) * k_entries;
    a.each(row, [&](Index j, std::int64_t s, bool mirrored) {
      if (of_row[as_size(j)] == k_none) return;
      add_product<size, modes>(a.block(s), mirrored, tentative.data() + as_size(j) * k_entries,
                               sum.block(of_row[as_size(j)]));
    });
    // Columns come in the order of their numbers, so that the sum is the same whatever the order in which
    // they were met.
    std::vector<Index> columns = sum.columns();
    std::sort(columns.begin(), columns.end());
    for (const Index column : columns) {
      // Then D⁻¹ is applied with ω and the tentative block of the own aggregate is added. Fixed rows are not
      // smoothed: their unknown does not follow the others.
      const double* const from = sum.block(column);
      p.column.push_back(column);
      for (int r = 0; r < size; ++r) {
        const std::size_t entry = as_size(row) * size + as_size(r);
        const bool zero = !fixed.empty() && fixed[entry] != 0;
        const double factor = zero ? 0.0 : omega * static_cast<double>(inverse_diagonal[entry]);
        for (int m = 0; m < modes; ++m) {
          const double start = column == of_row[as_size(row)] ? static_cast<double>(own[r * modes + m]) : 0.0;
          p.value.push_back(static_cast<float>(start - factor * from[r * modes + m]));
        }
      }
    }
    p.start.push_back(static_cast<std::int64_t>(p.column.size()));
  }
}

/// The columns of this process's part of Pᵀ A P, sorted; rows of other processes too.
void galerkin_pattern(const MatrixView& a, const BlockRows<float>& p, Index n_local,
                      BlockRows<double>& coarse) {
  // The coarse rows that every fine row reaches, and the fine rows of every coarse one: their union is its
  // pattern.
  std::vector<std::int64_t> start_of_reach{0}, start_of_rows(as_size(n_local) + 1, 0);
  std::vector<Index> reach;
  RowSum reached(n_local, 0);
  for (Index row = 0; row < a.n_rows(); ++row) {
    reached.clear();
    a.each(row, [&](Index j, std::int64_t, bool) {
      for (std::int64_t t = p.start[as_size(j)]; t < p.start[as_size(j) + 1]; ++t)
        reached.block(p.column[as_size(t)]);
    });
    reach.insert(reach.end(), reached.columns().begin(), reached.columns().end());
    start_of_reach.push_back(static_cast<std::int64_t>(reach.size()));
    for (std::int64_t t = p.start[as_size(row)]; t < p.start[as_size(row) + 1]; ++t)
      ++start_of_rows[as_size(p.column[as_size(t)]) + 1];
  }
  std::partial_sum(start_of_rows.begin(), start_of_rows.end(), start_of_rows.begin());
  std::vector<Index> rows(as_size(start_of_rows.back()));
  std::vector<std::int64_t> next(start_of_rows.begin(), start_of_rows.end() - 1);
  for (Index row = 0; row < a.n_rows(); ++row)
    for (std::int64_t t = p.start[as_size(row)]; t < p.start[as_size(row) + 1]; ++t)
      rows[as_size(next[as_size(p.column[as_size(t)])]++)] = row;
  for (std::size_t to = 0; to < as_size(n_local); ++to) {
    reached.clear();
    for (std::int64_t k = start_of_rows[to]; k < start_of_rows[to + 1]; ++k) {
      const std::size_t row = as_size(rows[as_size(k)]);
      for (std::int64_t t = start_of_reach[row]; t < start_of_reach[row + 1]; ++t)
        reached.block(reach[as_size(t)]);
    }
    const std::size_t begin = coarse.column.size();
    coarse.column.insert(coarse.column.end(), reached.columns().begin(), reached.columns().end());
    std::sort(coarse.column.begin() + static_cast<std::ptrdiff_t>(begin), coarse.column.end());
    coarse.start.push_back(static_cast<std::int64_t>(coarse.column.size()));
  }
  coarse.value.assign(coarse.column.size() * as_size(coarse.block_entries()), 0.0);
}

template <int size, int modes>
void galerkin(const MatrixView& a, const BlockRows<float>& p, Index n_local, BlockRows<double>& coarse) {
  // Row by row of A the product A P is formed, and with the transposed row of P its share of the coarse
  // matrix, whose pattern has been made before.
  RowSum product(n_local, size * modes);
  for (Index row = 0; row < a.n_rows(); ++row) {
    product.clear();
    a.each(row, [&](Index j, std::int64_t s, bool mirrored) {
      for (std::int64_t t = p.start[as_size(j)]; t < p.start[as_size(j) + 1]; ++t)
        add_product<size, modes>(a.block(s), mirrored, p.block(t), product.block(p.column[as_size(t)]));
    });
    for (std::int64_t t = p.start[as_size(row)]; t < p.start[as_size(row) + 1]; ++t) {
      const std::size_t to = as_size(p.column[as_size(t)]);
      const auto begin = coarse.column.begin() + coarse.start[to],
                 end = coarse.column.begin() + coarse.start[to + 1];
      for (const Index column : product.columns()) {
        const auto slot = std::lower_bound(begin, end, column) - coarse.column.begin();
        add_transposed_product<size, modes>(p.block(t), product.block(column), coarse.block(slot));
      }
    }
  }
}

/// A mode without stiffness, or one that its aggregate does not have, gets a diagonal of its own.
void hold_empty_modes(BlockRows<double>& a) {
  const auto n = as_size(a.rows);
  std::vector<double*> diagonal;
  double sums[2] = {0, 0};
  for (Index row = 0; row < a.n_rows(); ++row) {
    const auto begin = a.column.begin() + a.start[as_size(row)],
               end = a.column.begin() + a.start[as_size(row) + 1];
    double* const block = a.block(std::lower_bound(begin, end, row) - a.column.begin());
    for (std::size_t m = 0; m < n; ++m) {
      diagonal.push_back(block + m * n + m);
      sums[0] += std::abs(*diagonal.back());
      sums[1] += 1;
    }
  }
  const double mean = sums[1] > 0 && sums[0] > 0 ? sums[0] / sums[1] : 1.0;
  for (double* const d : diagonal)
    if (std::abs(*d) <= k_no_stiffness * mean) *d = mean;
}

/// Local numbers of coarse rows: this process's own, then ghosts as they turn up; k_none stays that.
class CoarseNumbers {
 public:
  explicit CoarseNumbers(Numbering& numbering) : numbering_(numbering) {}
  Index local(double global) {
    const auto g = static_cast<GlobalIndex>(global);
    if (g == k_none) return k_none;
    if (g >= numbering_.first && g < numbering_.first + numbering_.n_owned)
      return as_index(g - numbering_.first);
    const auto [place, is_new] = places_.emplace(g, numbering_.n_local());
    if (is_new) numbering_.ghosts.push_back(g);
    return place->second;
  }
  double global(Index local) const {
    if (local == k_none) return k_none;
    return static_cast<double>(local < numbering_.n_owned
                                   ? numbering_.first + local
                                   : numbering_.ghosts[as_size(local - numbering_.n_owned)]);
  }

 private:
  Numbering& numbering_;
  std::unordered_map<GlobalIndex, Index> places_;
};

/// A row as messages hold it: of every block its column's number over all processes, then its entries.
template <class Number>
void pack_row(const BlockRows<Number>& rows, Index row, const CoarseNumbers& numbers,
              std::vector<double>& to) {
  for (std::int64_t t = rows.start[as_size(row)]; t < rows.start[as_size(row) + 1]; ++t) {
    to.push_back(numbers.global(rows.column[as_size(t)]));
    to.insert(to.end(), rows.block(t), rows.block(t) + rows.block_entries());
  }
}

/// Appends the rows of P that other processes made for ghosts.
void append_ghost_rows(const parallel::RowExchange& ghosts, Index n_local, CoarseNumbers& numbers,
                       BlockRows<float>& p) {
  const Index n_rows = p.n_rows();
  const auto stride = as_size(p.block_entries()) + 1;
  std::vector<std::vector<double>> rows(as_size(n_local - n_rows));
  ghosts.update([&](Index row, std::vector<double>& to) { pack_row(p, row, numbers, to); },
                [&](Index ghost, std::span<const double> row) {
                  rows[as_size(ghost - n_rows)].assign(row.begin(), row.end());
                });
  for (const std::vector<double>& row : rows) {
    for (std::size_t i = 0; i < row.size(); i += stride) {
      p.column.push_back(numbers.local(row[i]));
      for (std::size_t k = 1; k < stride; ++k) p.value.push_back(static_cast<float>(row[i + k]));
    }
    p.start.push_back(static_cast<std::int64_t>(p.column.size()));
  }
}

/// Adds up the contributions of the processes to each other's coarse rows; own rows stay.
void sum_over_processes(CoarseNumbers& numbers, const Numbering& numbering, BlockRows<double>& coarse) {
  if (!parallel::any_process(!numbering.ghosts.empty())) return;
  struct CoarseBlock {
    Index column;
    const double* values;
  };
  const auto entries = as_size(coarse.block_entries());
  std::vector<std::vector<CoarseBlock>> rows(as_size(numbering.n_owned));
  for (Index row = 0; row < numbering.n_owned; ++row)
    for (std::int64_t t = coarse.start[as_size(row)]; t < coarse.start[as_size(row) + 1]; ++t)
      rows[as_size(row)].push_back({coarse.column[as_size(t)], coarse.block(t)});
  std::vector<std::pair<Index, std::vector<double>>> from_others;
  const parallel::RowExchange exchange(numbering.n_owned, numbering.first, numbering.ghosts);
  exchange.give_back([&](Index row, std::vector<double>& to) { pack_row(coarse, row, numbers, to); },
                     [&](Index row, std::span<const double> values) {
                       from_others.emplace_back(row, std::vector<double>(values.begin(), values.end()));
                     });
  for (const auto& [row, values] : from_others)
    for (std::size_t i = 0; i < values.size(); i += entries + 1)
      rows[as_size(row)].push_back({numbers.local(values[i]), values.data() + i + 1});

  BlockRows<double> sum;
  sum.rows = coarse.rows;
  sum.columns = coarse.columns;
  for (std::vector<CoarseBlock>& blocks : rows) {
    // Stable: blocks of one place are added in the order of the processes.
    std::stable_sort(blocks.begin(), blocks.end(),
                     [](const CoarseBlock& l, const CoarseBlock& r) { return l.column < r.column; });
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      if (b == 0 || blocks[b].column != blocks[b - 1].column) {
        sum.column.push_back(blocks[b].column);
        sum.value.insert(sum.value.end(), blocks[b].values, blocks[b].values + entries);
        continue;
      }
      double* const to = sum.value.data() + sum.value.size() - entries;
      for (std::size_t k = 0; k < entries; ++k) to[k] += blocks[b].values[k];
    }
    sum.start.push_back(static_cast<std::int64_t>(sum.column.size()));
  }
  coarse = std::move(sum);
}

/// Tentative interpolation: for each local row of the fine level, ghosts too, its aggregate, if any, and its
/// block of P₀.
struct Tentative {
  std::vector<Index> of_row;
  std::vector<float> values;
};

template <int size, int modes>
void make_level(const MatrixView& a, const parallel::RowExchange& ghosts, Tentative start,
                std::span<const char> fixed, std::span<const float> inverse_diagonal, double omega,
                CoarseNumbers& numbers, Coarsening& next) {
  BlockRows<float>& p = next.interpolation;
  smooth<size, modes>(a, start.of_row, next.numbering.n_local(), start.values, fixed, inverse_diagonal, omega,
                      p);
  std::vector<float>().swap(start.values);
  append_ghost_rows(ghosts, as_index(start.of_row.size()), numbers, p);
  galerkin_pattern(a, p, next.numbering.n_local(), next.matrix);
  galerkin<size, modes>(a, p, next.numbering.n_local(), next.matrix);
  sum_over_processes(numbers, next.numbering, next.matrix);
}

}  // namespace

std::vector<float> inverse_diagonal(const MatrixView& a) {
  const auto n = as_size(a.size);
  std::vector<float> inverse(as_size(a.n_rows()) * n, 1.0F);
  for (Index row = 0; row < a.n_rows(); ++row)
    for (std::int64_t s = a.start[as_size(row)]; s < a.start[as_size(row) + 1]; ++s) {
      if (a.column[as_size(s)] != row) continue;
      for (std::size_t r = 0; r < n; ++r)
        if (const double d = a.block(s)[r * n + r]; d != 0)
          inverse[as_size(row) * n + r] = static_cast<float>(1.0 / d);
    }
  return inverse;
}

Coarsening coarsen(const MatrixView& a, const Numbering& numbering, const parallel::RowExchange& ghosts,
                   std::vector<double> near_null, int modes, std::span<const char> fixed,
                   std::span<const float> inverse_diagonal, double largest) {
  // The next level has one block row of `modes` unknowns for each aggregate. Everything that follows depends
  // on the aggregates of this process, which are numbered on from those of the processes before it.
  const int entries = a.size * modes;
  Coarsening next;
  next.modes = modes;
  next.interpolation.rows = a.size;
  next.interpolation.columns = next.matrix.rows = next.matrix.columns = modes;
  Tentative start;
  next.numbering.n_owned = aggregate(a, start.of_row);
  next.numbering.first = processes::sum_before(next.numbering.n_owned);
  // The tentative prolongation interpolates the near null space exactly: in each aggregate an orthonormal
  // basis of it, whose coefficients are the near null space of the next level.
  start.values =
      tentative(start.of_row, next.numbering.n_owned, a.size, near_null, modes, fixed, next.near_null);
  std::vector<double>().swap(near_null);
  CoarseNumbers numbers(next.numbering);
  // Ghost rows need the aggregate and the tentative values of their owners, because A reaches them.
  start.of_row.resize(as_size(numbering.n_local()));
  start.values.resize(as_size(numbering.n_local()) * as_size(entries));
  ghosts.update(
      [&](Index row, std::vector<double>& to) {
        const float* const block = start.values.data() + std::int64_t{row} * entries;
        to.push_back(numbers.global(start.of_row[as_size(row)]));
        to.insert(to.end(), block, block + entries);
      },
      [&](Index ghost, std::span<const double> row) {
        start.of_row[as_size(ghost)] = numbers.local(row[0]);
        std::transform(row.begin() + 1, row.end(), start.values.begin() + std::int64_t{ghost} * entries,
                       [](double v) { return static_cast<float>(v); });
      });

  // Smoothing with ω over the largest eigenvalue of D⁻¹ A lowers the energy of the basis functions; then the
  // Galerkin product Pᵀ A P makes the matrix. Modes that an aggregate of few nodes cannot have are held.
  const double omega = largest > 0 ? k_smoothing / largest : 0.0;
  const auto make = [&]<int size, int n>() {
    make_level<size, n>(a, ghosts, std::move(start), fixed, inverse_diagonal, omega, numbers, next);
  };
  with_block_sizes(a.size, modes, make);
  hold_empty_modes(next.matrix);
  return next;
}

}  // namespace solidus::multigrid
