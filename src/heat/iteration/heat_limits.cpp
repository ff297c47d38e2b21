#include "heat/iteration/heat_limits.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "heat/loads/temperature_range.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"

namespace solidus::heat {

namespace {

constexpr double k_rounding = 1e-7;  ///< of temperatures [K]

}  // namespace

bool HeatLimits::find(std::span<const double> temperature, double negligible) {
  // Without a limiter, or without positive entries in the matrix, nothing is limited. The conduction matrix
  // itself has to be at hand, since elements are not asked again.
  ConductionLimiter* const limiter = parts_.conduction.limiter();
  if (limiter == nullptr || !parts_.exchanges) return false;
  parts_.conduction.keep();
  if (!limiter->needed()) return false;
  // For every node what flows in and what flows out is summed, as magnitudes: bounds let through what sources
  // and surfaces bring. Conduction without limits comes first, then films, fluxes and radiation, then
  // sources.
  const auto n = as_size(parts_.prescribed.n_owned());
  std::vector<double> gain(n), loss(n);
  const std::span<const double> flow = parts_.conduction.flow(temperature);
  for (std::size_t i = 0; i < n; ++i) (flow[i] > 0 ? gain : loss)[i] += std::abs(flow[i]);
  std::vector<LimitedFlow*> flows;
  for (SurfaceHeat& surface : parts_.surfaces.each()) {
    surface.add_supply(temperature, gain, loss);
    for (LimitedFlow& limited : surface.flows()) flows.push_back(&limited);
  }
  parts_.channels.add_supply(temperature, gain, loss);
  parts_.sources.add_supply(gain, loss);
  parts_.contributions.add_supply(temperature, gain, loss);
  // From these sums the limiter finds the shares that are held in the iteration that follows.
  return limiter->find_shares(temperature, gain, loss, parts_.prescribed.fixed(), negligible, flows);
}

void HeatLimits::clear() {
  if (ConductionLimiter* const limiter = parts_.conduction.limiter()) limiter->clear_shares();
  for (SurfaceHeat& surface : parts_.surfaces.each())
    for (LimitedFlow& flow : surface.flows()) flow.left = 0;
}

HeldNodes::Found HeatLimits::hold(std::span<const double> temperature, const TemperatureRange& range) {
  ConductionLimiter* const limiter = parts_.conduction.limiter();
  if (limiter == nullptr || !parts_.exchanges || !limiter->needed()) return HeldNodes::Found::none;
  const double lowest = range.lowest - k_rounding, highest = range.highest + k_rounding;
  const HeldNodes::Found held = limiter->held().hold(temperature, lowest, highest);
  // Contributions limit what they exchange at the same nodes.
  if (held == HeldNodes::Found::none || parts_.contributions.empty()) return held;
  std::vector<char> beyond(temperature.size());
  for (std::size_t i = 0; i < beyond.size(); ++i)
    beyond[i] = temperature[i] < lowest || temperature[i] > highest ? 1 : 0;
  parts_.contributions.limit_exchange(beyond);
  return held;
}

void HeatLimits::release() {
  ConductionLimiter* const limiter = parts_.conduction.limiter();
  if (limiter == nullptr) return;
  limiter->held().release();
  parts_.contributions.limit_exchange({});
}

TemperatureRange HeatLimits::surroundings() const {
  TemperatureRange range = parts_.prescribed.range();
  for (const SurfaceHeat& surface : parts_.surfaces.each())
    if (const std::optional<TemperatureRange> ambient = surface.law().ambient())
      range = united(range, *ambient);
  range = united(range, parts_.channels.ambient());
  return over_processes(range);
}

TemperatureRange HeatLimits::ambient(bool with_contributions) const {
  // A flux or a source may heat or cool beyond any temperature, so that there is no bound on that side. Films
  // and radiation have surroundings, which are the bounds otherwise.
  auto [cooling, heating] = parts_.sources.heat_range();
  for (const SurfaceHeat& surface : parts_.surfaces.each()) {
    if (surface.law().ambient()) continue;
    const auto [least, greatest] = surface.flux_range();
    cooling = std::min(cooling, least);
    heating = std::max(heating, greatest);
  }
  TemperatureRange range = surroundings();
  const bool contributed = with_contributions && parts_.contributions.heat();
  if (parallel::global_min(cooling) < 0 || contributed) range.lowest = -HUGE_VAL;
  if (parallel::global_max(heating) > 0 || contributed) range.highest = HUGE_VAL;
  return range;
}

TemperatureRange HeatLimits::closed(const TemperatureRange& range, const TemperatureRange& start,
                                    std::span<const double> temperature) {
  if (std::isfinite(range.lowest) && std::isfinite(range.highest)) return range;
  return united(united(ambient(false), start), parts_.contributions.range(temperature));
}

}  // namespace solidus::heat
