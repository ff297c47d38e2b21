/// The level of each pool by Newton's method within a bracket, for all pools at once so that processes meet
/// once a trial.
#include "criteria/feeding_levels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "system/processes.hpp"

namespace solidus::criteria {

namespace {

/// Bounds of a level, and where it is looked for next.
struct Search {
  double above = 0, below = 0;  ///< levels that give too little, and enough [m]
  double level = 0;
  bool found = true;
};

constexpr double k_level_found = 1e-13;
constexpr int k_most_trials = 100;

}  // namespace

double DrainedNode::gain(double level) const {
  const double depth = std::max(high - low, std::numeric_limits<double>::min());
  return std::max(0.0, std::clamp((high - level) / depth, 0.0, 1.0) - drained);
}

std::vector<PoolLevel> find_levels(std::span<const DrainedNode> nodes, std::span<const double> metal) {
  // For each pool the level is sought above which the metal drained equals what is asked for. All pools are
  // searched at once, so that each trial costs one sum over the processes.
  const std::size_t n = metal.size();
  constexpr double k_no_level = std::numeric_limits<double>::max();
  std::vector<double> extent(2 * n, -k_no_level);  // highest top, and the lowest bottom with its sign turned
  for (const DrainedNode& i : nodes) {
    extent[i.pool] = std::max(extent[i.pool], i.high);
    extent[n + i.pool] = std::max(extent[n + i.pool], -i.low);
  }
  // The search goes from the lowest bottom to the highest top; the lowest is found as the largest negative.
  processes::largest(extent);
  std::vector<Search> search(n);
  std::vector<PoolLevel> levels(n);
  // Pools without nodes or without anything to drain keep the level zero.
  for (std::size_t p = 0; p < n; ++p) {
    if (!(metal[p] > 0) || extent[p] == -k_no_level) continue;
    search[p] = {extent[p], -extent[n + p], -extent[n + p], false};
  }
  // Each trial sums what lies above the present level, and its increase per depth for Newton's step.
  std::vector<double> sums(2 * n);  // metal and its increase per depth
  for (int trial = 0; trial < k_most_trials; ++trial) {
    if (std::ranges::all_of(search, [](const Search& s) { return s.found; })) break;
    std::ranges::fill(sums, 0.0);
    for (const DrainedNode& i : nodes) {
      const Search& s = search[i.pool];
      if (s.found) continue;
      const double gain = i.gain(s.level);
      sums[i.pool] += i.metal * gain;
      if (gain > 0 && s.level > i.low && s.level < i.high) sums[n + i.pool] += i.metal / (i.high - i.low);
    }
    processes::sum(sums);
    // The drained metal falls monotonously with the level, so the bracket [below, above] always holds. The
    // first trial is the bottom: if even that is not enough, the pool is empty.
    for (std::size_t p = 0; p < n; ++p) {
      Search& s = search[p];
      if (s.found) continue;
      const double excess = sums[p] - metal[p];
      levels[p] = {s.level, sums[p]};
      const bool at_bottom = trial == 0 && excess <= 0, at_top = s.level >= s.above && excess >= 0;
      if (std::abs(excess) <= k_level_found * metal[p] || at_bottom || at_top) {
        s.found = true;
        continue;
      }
      if (trial > 0) (excess < 0 ? s.above : s.below) = s.level;
      // Newton's step is taken where it stays within the bracket, bisection otherwise. A level that no longer
      // moves has been found as well as rounding allows.
      double next = trial == 0 ? s.above : (s.above + s.below) / 2;
      if (trial > 0 && sums[n + p] > 0) {
        const double newton = s.level + excess / sums[n + p];
        if (newton > s.below && newton < s.above) next = newton;
      }
      if (trial > 1 && next == s.level) s.found = true;
      s.level = next;
    }
  }
  return levels;
}

}  // namespace solidus::criteria
