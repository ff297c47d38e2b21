/// Barriers of each free node are found once from the first stage; the second stage is then compared with
/// them, with the range around and with its own direction.
#include "heat/iteration/extrapolation_guard.hpp"

#include <algorithm>
#include <cmath>

#include "material/time_integration.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"

namespace solidus::heat {

namespace {

using material::k_sdirk_carried;

/// Share of the range by which Θ(H*) may leave it for the second stage to be tried at all.
constexpr double k_too_far = 1.0;
/// Share of the range of temperatures below which two nodes are equally warm.
constexpr double k_alike = 1e-9;
/// Factor by which a temperature may go further than in the first stage: by (1 − γ)/γ where the capacity is
/// constant, and half as much again where it is not.
constexpr double k_outside = 1.5 * k_sdirk_carried;
/// Share of the range of temperatures below which a difference is none.
constexpr double k_even = 1e-4;
/// Share of the range of temperatures by which metal may sink, root mean square over its volume.
constexpr double k_sunk = 3e-4;

}  // namespace

ExtrapolationGuard::ExtrapolationGuard(HeatSystem& system, const NodalEnthalpy& storage,
                                       const ThermalState& old, const ThermalState& middle)
    : system_(system),
      storage_(storage),
      before_(old.temperature),
      now_(middle.temperature),
      n_(as_size(storage.n_nodes())) {
  // First Θ(H*) of every free node is found: H* is the heat content that the second stage starts from,
  // extrapolated through that of the first stage. The ranges of all temperatures at the start and at the end
  // of the first stage are kept with it.
  std::vector<double> ahead(n_);  // Θ(H*)
  TemperatureRange first, second;
  const auto look = [](TemperatureRange& range, double temperature) {
    range.lowest = std::min(range.lowest, temperature);
    range.highest = std::max(range.highest, temperature);
  };
  for (std::size_t i = 0; i < n_; ++i) {
    const auto node = as_index(i);
    if (!system.parts().elements.active().node(node)) continue;
    look(first, before_[i]);
    look(second, now_[i]);
    ahead[i] = now_[i];
    if (system.parts().prescribed.fixed()[i]) continue;
    const double heat = old.enthalpy[i] + k_sdirk_carried * (middle.enthalpy[i] - old.enthalpy[i]);
    ahead[i] = storage.temperature(node, heat);
  }
  lowest_ = parallel::global_min(first.lowest);
  highest_ = parallel::global_max(first.highest);
  first_lowest_ = parallel::global_min(second.lowest);
  first_highest_ = parallel::global_max(second.highest);

  // Then a range is made for each node from itself and its neighbours: from the temperatures before, by at
  // most k_outside times the change of the first stage.
  std::vector<double> low(before_.size()), high(before_.size());
  for (std::size_t i = 0; i < low.size(); ++i) {
    const double change = k_outside * (now_[i] - before_[i]);
    low[i] = before_[i] + std::min(change, 0.0);
    high[i] = before_[i] + std::max(change, 0.0);
  }
  std::vector<double> least(low.begin(), low.begin() + static_cast<std::ptrdiff_t>(n_)),
      greatest(high.begin(), high.begin() + static_cast<std::ptrdiff_t>(n_));
  for_neighbours([&](std::size_t i, std::size_t j) {
    least[i] = std::min(least[i], low[j]);
    greatest[i] = std::max(greatest[i], high[j]);
  });
  // A node whose Θ(H*) leaves the range of its neighbourhood by more than an even field varies has passed a
  // kink of its curve: the sign says in which direction it is corrected.
  const double even = k_even * (highest_ - lowest_);
  std::vector<char> kinks(n_);
  int found = 0;
  for (std::size_t i = 0; i < kinks.size(); ++i) {
    if (!free(i)) continue;
    kinks[i] = ahead[i] < least[i] - even ? 1 : ahead[i] > greatest[i] + even ? -1 : 0;
    found += kinks[i] != 0 ? 1 : 0;
  }
  if (parallel::any_process(found > 0)) passes_kink_ = std::move(kinks);
  ahead_ = range_of_free(ahead);
}

bool ExtrapolationGuard::free(std::size_t i) const {
  return system_.parts().elements.active().node(as_index(i)) && !system_.parts().prescribed.fixed()[i];
}

/// Calls f(node, neighbour) for all neighbours of the owned nodes, which may be ghosts.
template <class F>
void ExtrapolationGuard::for_neighbours(const F& f) const {
  const std::span<const std::int64_t> start = system_.matrix().row_start();
  const std::span<const Index> columns = system_.matrix().columns();
  for (std::size_t i = 0; i < n_; ++i)
    for (std::int64_t s = start[i]; s < start[i + 1]; ++s) {
      const auto j = as_size(columns[as_size(s)]);
      f(i, j);
      if (j > i && j < n_) f(j, i);  // half of the pattern may be all that there is
    }
}

TemperatureRange ExtrapolationGuard::range_of_free(std::span<const double> temperature) const {
  TemperatureRange range;
  for (std::size_t i = 0; i < n_; ++i) {
    if (!free(i)) continue;
    range.lowest = std::min(range.lowest, temperature[i]);
    range.highest = std::max(range.highest, temperature[i]);
  }
  return range;
}

/// Whether temperatures leave the range by more than a share of it. Collective.
/// @param reached  of this process
bool ExtrapolationGuard::leaves_range(const TemperatureRange& reached, const TemperatureRange& surroundings,
                                      double share) const {
  const double low = std::min(lowest_, surroundings.lowest), high = std::max(highest_, surroundings.highest);
  const double fall = std::max(0.0, low - first_lowest_), rise = std::max(0.0, first_highest_ - high);
  const double beyond = share * (high - low);
  const double least = low - k_outside * fall - beyond, greatest = high + k_outside * rise + beyond;
  return parallel::any_process(reached.lowest < least || reached.highest > greatest);
}

bool ExtrapolationGuard::extrapolates_too_far(const TemperatureRange& surroundings) const {
  return leaves_range(ahead_, surroundings, k_too_far);
}

bool ExtrapolationGuard::overshoots(const ThermalState& next, const TemperatureRange& surroundings,
                                    double share) const {
  return leaves_range(range_of_free(next.temperature), surroundings, share);
}

// From a node on it goes to its coldest neighbour in the first stage, and so on: the hottest node that is
// met there at the end, less the node itself, is how far it has sunk below its way out (turned upside down
// where it melts).
bool ExtrapolationGuard::turns_back(const ThermalState& next, const parallel::GhostExchange& ghosts) const {
  if (passes_kink_.empty()) return false;
  const std::size_t n = n_;
  const double range = highest_ - lowest_;
  std::vector<double> sunk(n, 0.0);
  for (const double sign : {1.0, -1.0}) {
    std::vector<std::size_t> way_out(n);
    for (std::size_t i = 0; i < n; ++i) way_out[i] = i;
    for_neighbours([&](std::size_t i, std::size_t j) {
      if (sign * (now_[way_out[i]] - now_[j]) > k_alike * range) way_out[i] = j;
    });
    std::vector<double> barrier = next.temperature;
    while (raise_along(way_out, sign, barrier)) ghosts.update(barrier, 1);
    for (std::size_t i = 0; i < n; ++i)
      if (passes_kink_[i] == sign) sunk[i] = sign * (barrier[i] - next.temperature[i]);
  }
  double squares = 0, volume = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double at_node =
        storage_.sum(as_index(i), [](const material::Material& m) { return m.solidification() ? 1.0 : 0.0; });
    squares += at_node * sunk[i] * sunk[i];
    volume += at_node;
  }
  squares = parallel::global_sum(squares);
  volume = parallel::global_sum(volume);
  return squares > k_sunk * k_sunk * range * range * volume;
}

/// Takes the barriers of this process to the highest further on, its ghosts' included; returns whether one
/// has changed that another process may have to know.
bool ExtrapolationGuard::raise_along(std::span<const std::size_t> way_out, double sign,
                                     std::span<double> barrier) const {
  const std::size_t n = way_out.size();
  std::vector<char> seen(n, 0);
  // A chain along the way out is walked to its end, or to a node that was seen, and then raised
  // from the far end back: so each node is visited once.
  std::vector<std::size_t> chain;
  bool changed = false;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = i; k < n && seen[k] == 0; k = way_out[k]) {
      seen[k] = 1;
      chain.push_back(k);
    }
    for (; !chain.empty(); chain.pop_back()) {
      double& here = barrier[chain.back()];
      const double ahead = barrier[way_out[chain.back()]];
      // `sign` makes highest and lowest barriers the same loop.
      if (sign * (ahead - here) <= 0) continue;
      here = ahead;
      changed = true;
    }
  }
  return parallel::any_process(changed && n < barrier.size());
}

}  // namespace solidus::heat
