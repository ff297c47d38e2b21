/// The mirror half of a symmetric matrix as a list of places, made in a counting pass and a filling pass.
#include "multigrid/matrix_view.hpp"

#include "numbers/index_casts.hpp"

namespace solidus::multigrid {

LowerPart::LowerPart(std::span<const std::int64_t> start, std::span<const Index> column)
    : start_(start.size(), 0) {
  // For every row the blocks below the diagonal are those above it in other rows, seen from the side. The
  // first pass counts them, the second notes the row and the place in it.
  const auto n = as_index(start.size()) - 1;
  const auto each_above = [&](const auto& f) {
    for (Index row = 0; row < n; ++row) {
      const std::int64_t begin = start[as_size(row)];
      for (std::int64_t s = begin; s < start[as_size(row) + 1]; ++s)
        if (const Index j = column[as_size(s)]; j > row && j < n) f(row, as_size(j), as_index(s - begin));
    }
  };
  each_above([&](Index, std::size_t j, Index) { ++start_[j + 1]; });
  for (std::size_t i = 1; i < start_.size(); ++i) start_[i] += start_[i - 1];
  blocks_.resize(as_size(start_.back()));
  std::vector<std::int64_t> next(start_.begin(), start_.end() - 1);
  each_above([&](Index row, std::size_t j, Index place) { blocks_[as_size(next[j]++)] = {row, place}; });
}

}  // namespace solidus::multigrid
