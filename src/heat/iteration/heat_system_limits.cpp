/// Limits of conduction in the heat system, and the temperatures around the bodies that they follow from.
#include <algorithm>
#include <cmath>

#include "heat/iteration/heat_system.hpp"
#include "parallel/parallel.hpp"

namespace solidus::heat {

namespace {

constexpr double k_rounding = 1e-7;  ///< of temperatures [K]

}  // namespace

void HeatSystem::limit(bool on) {
  on = on && closed_;
  if (on == (limiter_ != nullptr)) return;
  limiter_.reset();
  forget_conduction();
  if (!on) return;
  limiter_ = std::make_unique<ConductionLimiter>(mesh_, potentials_);
}

bool HeatSystem::find_limits(std::span<const double> temperature, double negligible) {
  // Without a limiter, or without positive entries in the matrix, nothing is limited. The conduction matrix
  // itself has to be at hand, since elements are not asked again.
  if (!limiter_ || !exchange_) return false;
  if (!keeps_conduction()) keep_conduction();
  if (!limiter_->needed()) return false;
  std::vector<LimitedFlow*> flows;
  // For every node what flows in and what flows out is summed, as magnitudes: bounds let through what sources
  // and surfaces bring.
  std::vector<double> gain(static_cast<std::size_t>(mesh_.n_owned_nodes)), loss(gain.size());
  conduct(temperature);
  // Conduction without limits comes first, then films, fluxes and radiation, then sources.
  for (std::size_t i = 0; i < gain.size(); ++i) (local_[i] > 0 ? gain : loss)[i] += std::abs(local_[i]);
  for (SurfaceHeat& surface : surfaces_) {
    surface.add_supply(temperature, gain, loss);
    surface.update_flows(temperature);
    for (LimitedFlow& flow : surface.flows()) flows.push_back(&flow);
  }
  for (const Volume& source : sources_)
    for (std::size_t i = 0; i < source.heat.size(); ++i)
      (source.heat[i] > 0 ? gain : loss)[i] += std::abs(source.heat[i]);
  // Contributions (contact, heat of deformation) count too. One whose sum over all nodes is not zero brings
  // heat of its own instead of passing it on.
  contributions_heat_ = false;  // all are looked at
  for (linear::Contribution* contribution : contributions_) {
    if (contribution->stores()) continue;
    std::fill(contributed_.begin(), contributed_.end(), 0.0);
    contribution->add_residual(temperature, contributed_);
    double net = 0, magnitude = 0;
    for (std::size_t i = 0; i < gain.size(); ++i) {
      (contributed_[i] < 0 ? gain : loss)[i] += std::abs(contributed_[i]);
      net += contributed_[i];
      magnitude += std::abs(contributed_[i]);
    }
    constexpr double k_passed_on = 1e-9;  // net heat over the heat exchanged
    if (std::abs(parallel::global_sum(net)) > k_passed_on * parallel::global_sum(magnitude))
      contributions_heat_ = true;
  }
  // From these sums the limiter finds the shares that are held in the iteration that follows.
  return limiter_->find_shares(temperature, gain, loss, fixed_, negligible, flows);
}

void HeatSystem::clear_limits() {
  if (limiter_) limiter_->clear_shares();
  for (SurfaceHeat& surface : surfaces_)
    for (LimitedFlow& flow : surface.flows()) flow.left = 0;
}

ConductionLimiter::Held HeatSystem::hold_nodes(std::span<const double> temperature,
                                               const TemperatureRange& range) {
  if (!limiter_ || !exchange_) return ConductionLimiter::Held::none;
  const double lowest = range.lowest - k_rounding, highest = range.highest + k_rounding;
  const ConductionLimiter::Held held = limiter_->hold(temperature, lowest, highest);
  // Contributions limit what they exchange at the same nodes.
  if (held == ConductionLimiter::Held::none || contributions_.empty()) return held;
  std::vector<char> beyond(temperature.size());
  for (std::size_t i = 0; i < beyond.size(); ++i)
    beyond[i] = temperature[i] < lowest || temperature[i] > highest ? 1 : 0;
  for (linear::Contribution* contribution : contributions_) contribution->limit_exchange(beyond);
  return held;
}

void HeatSystem::release_nodes() {
  if (!limiter_) return;
  limiter_->release();
  for (linear::Contribution* contribution : contributions_) contribution->limit_exchange({});
}

TemperatureRange HeatSystem::surroundings() const {
  TemperatureRange range;
  // Ambient temperatures and prescribed ones, over all processes.
  const auto include = [&range](const TemperatureRange& other) {
    range.lowest = std::min(range.lowest, other.lowest);
    range.highest = std::max(range.highest, other.highest);
  };
  for (const SurfaceHeat& surface : surfaces_)
    if (const std::optional<TemperatureRange> ambient = surface.ambient()) include(*ambient);
  for (const Prescribed& p : prescribed_)
    for (const double temperature : p.now) include({temperature, temperature});
  return {parallel::global_min(range.lowest), parallel::global_max(range.highest)};
}

TemperatureRange HeatSystem::ambient_range(bool with_contributions) const {
  // A flux or a source may heat or cool beyond any temperature, so that there is no bound on that side.
  double cooling = 0, heating = 0;
  for (const SurfaceHeat& surface : surfaces_) {
    if (surface.ambient()) continue;
    const auto [least, greatest] = surface.flux_range();
    cooling = std::min(cooling, least);
    heating = std::max(heating, greatest);
  }
  // Films and radiation have surroundings, which are the bounds otherwise.
  for (const Volume& source : sources_)
    for (const double heat : source.heat) {
      cooling = std::min(cooling, heat);
      heating = std::max(heating, heat);
    }
  TemperatureRange range = surroundings();
  const bool contributed = with_contributions && contributions_heat_;
  if (parallel::global_min(cooling) < 0 || contributed) range.lowest = -HUGE_VAL;
  if (parallel::global_max(heating) > 0 || contributed) range.highest = HUGE_VAL;
  return range;
}

TemperatureRange HeatSystem::range_of_contributions(std::span<const double> temperature) {
  TemperatureRange range;
  // Contributions that only exchange heat can lead no farther than the temperatures of the nodes that they
  // touch.
  for (linear::Contribution* contribution : contributions_) {
    if (contribution->stores()) continue;
    std::fill(contributed_.begin(), contributed_.end(), 0.0);
    contribution->add_residual(temperature, contributed_);
    for (std::size_t i = 0; i < contributed_.size(); ++i) {
      if (contributed_[i] == 0) continue;
      range.lowest = std::min(range.lowest, temperature[i]);
      range.highest = std::max(range.highest, temperature[i]);
    }
  }
  return {parallel::global_min(range.lowest), parallel::global_max(range.highest)};
}

TemperatureRange HeatSystem::closed_range(const TemperatureRange& range, const TemperatureRange& start,
                                          std::span<const double> temperature) {
  if (std::isfinite(range.lowest) && std::isfinite(range.highest)) return range;
  TemperatureRange closed = ambient_range(false);
  for (const TemperatureRange& other : {start, range_of_contributions(temperature)}) {
    closed.lowest = std::min(closed.lowest, other.lowest);
    closed.highest = std::max(closed.highest, other.highest);
  }
  return closed;
}

}  // namespace solidus::heat
