/// Rows with unknowns are renumbered, on their owners and as ghosts, and their blocks copied.
#include "multigrid/compact_rows.hpp"

#include <algorithm>

#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "system/processes.hpp"

namespace solidus::multigrid {

namespace {

/// Rows that are left, of all, below which a copy of them costs less than the cycles gain.
constexpr double k_worthwhile = 0.9;
constexpr Index k_absent = -1;

bool absent(Index row, int size, std::span<const char> fixed) {
  const auto of_row = fixed.subspan(as_size(row) * as_size(size), as_size(size));
  return std::ranges::all_of(of_row, [](char f) { return f != 0; });
}

/// The rows of this process that are left, and their new numbers, ghosts' too: [local row], k_absent where
/// there is none.
struct Renumbering {
  std::vector<Index> local;
  Numbering numbering;
};

Renumbering renumber(const Numbering& whole, const std::vector<Index>& rows) {
  Renumbering result{std::vector<Index>(as_size(whole.n_local()), k_absent), {}};
  Numbering& now = result.numbering;
  now.n_owned = as_index(rows.size());
  now.first = processes::sum_before(now.n_owned);
  // Numbers below 2^53 are exact in double precision.
  std::vector<double> number(result.local.size(), k_absent);
  for (Index i = 0; i < now.n_owned; ++i) {
    const auto row = as_size(rows[as_size(i)]);
    result.local[row] = i;
    number[row] = static_cast<double>(now.first + i);
  }
  parallel::GhostExchange(whole.n_owned, whole.first, whole.ghosts).update(std::span(number), 1);
  // A ghost whose owner keeps it gets the next local number here.
  for (auto i = as_size(whole.n_owned); i < number.size(); ++i) {
    if (number[i] < 0) continue;
    result.local[i] = now.n_local();
    now.ghosts.push_back(static_cast<GlobalIndex>(number[i]));
  }
  return result;
}

}  // namespace

bool worth_compacting(int size, std::span<const char> fixed) {
  const auto n = as_index(fixed.size() / as_size(size));
  double counts[2] = {0, static_cast<double>(n)};
  for (Index row = 0; row < n; ++row) counts[0] += absent(row, size, fixed) ? 0 : 1;
  processes::sum(counts);
  return counts[0] < k_worthwhile * counts[1];
}

CompactRows compact(const MatrixView& a, const Numbering& numbering, std::span<const char> fixed) {
  CompactRows result;
  const auto size = as_size(a.size);
  const std::size_t entries = size * size;
  // Rows without any unknown are told apart first. Of those only the inverse of the diagonal is kept, with
  // which a cycle answers for them.
  result.inverse_diagonal.assign(fixed.size(), 0.0);
  for (Index row = 0; row < a.n_rows(); ++row) {
    if (!absent(row, a.size, fixed)) {
      result.rows.push_back(row);
      continue;
    }
    a.each(row, [&](Index column, std::int64_t slot, bool) {
      for (std::size_t c = 0; column == row && c < size; ++c) {
        const double diagonal = a.block(slot)[c * (size + 1)];
        if (diagonal != 0) result.inverse_diagonal[as_size(row) * size + c] = 1 / diagonal;
      }
    });
  }
  // The remaining rows are numbered without gaps, ghosts too, since their owners leave the same rows out.
  Renumbering now = renumber(numbering, result.rows);
  result.numbering = std::move(now.numbering);
  // Storage is reserved for what the kept rows have at most.
  std::int64_t n_slots = 0;
  for (const Index row : result.rows) n_slots += a.end(row) - a.begin(row);
  result.start.reserve(result.rows.size() + 1);
  result.start.push_back(0);
  result.column.reserve(as_size(n_slots));
  result.value.reserve(as_size(n_slots) * entries);
  result.fixed.reserve(result.rows.size() * size);
  // Then blocks and columns are copied in the order of before; columns of absent rows hold nothing but zeros
  // and are skipped.
  for (const Index row : result.rows) {
    for (std::int64_t s = a.begin(row); s < a.end(row); ++s) {
      const Index column = now.local[as_size(a.column[as_size(s)])];
      if (column == k_absent) continue;
      result.column.push_back(column);
      result.value.insert(result.value.end(), a.block(s), a.block(s) + entries);
    }
    result.start.push_back(static_cast<std::int64_t>(result.column.size()));
    const auto of_row = fixed.subspan(as_size(row) * size, size);
    result.fixed.insert(result.fixed.end(), of_row.begin(), of_row.end());
  }
  return result;
}

}  // namespace solidus::multigrid
