/// Finds which of many intervals holds a number, in a time that hardly depends on how many there are.
///
/// The range of the starts is divided into equal buckets, and each knows the intervals that reach into it: a
/// curve of hundreds of pieces is looked up millions of times a step, and bisection guesses wrong at every
/// second branch.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "numbers/index_casts.hpp"

namespace solidus {

class IntervalSearch {
 public:
  /// @param starts  of the intervals, rising; at least one
  explicit IntervalSearch(std::vector<double> starts) : starts_(std::move(starts)) {
    const std::size_t n_buckets = k_buckets_an_interval * starts_.size();
    const double range = starts_.back() - starts_.front();
    buckets_per_unit_ = range > 0 ? static_cast<double>(n_buckets) / range : 0.0;
    last_bucket_ = static_cast<double>(n_buckets - 1);
    begin_.assign(n_buckets + 1, static_cast<std::uint32_t>(starts_.size()));
    for (std::size_t i = starts_.size(); i-- > 0;) begin_[bucket(starts_[i])] = static_cast<std::uint32_t>(i);
    for (std::size_t b = n_buckets; b-- > 0;) begin_[b] = std::min(begin_[b], begin_[b + 1]);
  }

  /// Returns the last interval whose start is not above x, the first one where there is none.
  std::size_t operator()(double x) const {
    const std::size_t b = bucket(x);
    const auto begin = starts_.begin() + begin_[b], end = starts_.begin() + begin_[b + 1];
    const auto above = std::upper_bound(begin, end, x);
    return above == starts_.begin() ? 0 : as_size(above - starts_.begin()) - 1;
  }

 private:
  static constexpr std::size_t k_buckets_an_interval = 4;
  std::size_t bucket(double x) const {
    const double place = (x - starts_.front()) * buckets_per_unit_;
    return place > 0 ? static_cast<std::size_t>(std::min(place, last_bucket_)) : 0;
  }

  std::vector<double> starts_;
  std::vector<std::uint32_t> begin_;  ///< first start in each bucket or behind it; one more at the end
  double buckets_per_unit_ = 0, last_bucket_ = 0;
};

}  // namespace solidus
