/// Numbers that mostly rise by one from place to place, as those of elements in a file do: stored by runs.
#pragma once

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <vector>

#include "numbers/types.hpp"

namespace solidus::mesh {

/// A list that is read by position and extended at its end. A run of consecutive numbers takes 16 bytes,
/// whatever its length, in place of 8 bytes a number; lists in any other order stay as they are.
class NumberRuns {
 public:
  NumberRuns() = default;
  NumberRuns(std::initializer_list<GlobalIndex> numbers) : NumberRuns(std::vector<GlobalIndex>(numbers)) {}
  explicit NumberRuns(std::vector<GlobalIndex> numbers) {
    std::size_t runs = 0;
    for (std::size_t i = 0; i < numbers.size(); ++i)
      if (i == 0 || numbers[i] != numbers[i - 1] + 1) ++runs;
    if (2 * runs > numbers.size()) {
      listed_ = std::move(numbers);
      return;
    }
    runs_.reserve(runs);
    for (const GlobalIndex number : numbers) push_back(number);
  }

  std::size_t size() const { return listed_.empty() ? size_ : listed_.size(); }
  bool empty() const { return size() == 0; }
  void push_back(GlobalIndex number) {
    if (!listed_.empty()) {
      listed_.push_back(number);
      return;
    }
    if (runs_.empty() || number != runs_.back().number_at(size_)) runs_.push_back({size_, number});
    ++size_;
  }
  void clear() { *this = NumberRuns(); }

  GlobalIndex operator[](std::size_t i) const {
    if (!listed_.empty()) return listed_[i];
    const auto after = std::upper_bound(runs_.begin(), runs_.end(), i,
                                        [](std::size_t at, const Run& run) { return at < run.first; });
    return (after - 1)->number_at(i);
  }
  /// The first `n` numbers, one by one.
  std::vector<GlobalIndex> first(std::size_t n) const {
    std::vector<GlobalIndex> numbers(n);
    for (std::size_t i = 0; i < n; ++i) numbers[i] = (*this)[i];
    return numbers;
  }
  std::size_t bytes() const {
    return runs_.capacity() * sizeof(Run) + listed_.capacity() * sizeof(GlobalIndex);
  }

 private:
  struct Run {
    std::size_t first;  ///< position of its first number
    GlobalIndex number;
    GlobalIndex number_at(std::size_t i) const { return number + static_cast<GlobalIndex>(i - first); }
  };
  std::vector<Run> runs_;
  std::size_t size_ = 0;             ///< of all runs
  std::vector<GlobalIndex> listed_;  ///< in place of runs
};

}  // namespace solidus::mesh
