/// Errors of a step by comparison: with an extrapolation of the steps before, or with two steps of half the
/// length. Each quantity has its own norm.
#include "coupling/error_estimate.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>

#include "parallel/parallel.hpp"

namespace solidus::coupling {

namespace {

std::vector<double> difference(const std::vector<double>& from, const std::vector<double>& to,
                               double divisor = 1) {
  std::vector<double> result(to.size());
  for (std::size_t i = 0; i < to.size(); ++i) result[i] = (to[i] - from[i]) / divisor;
  return result;
}

/// The least number of steps of a run whose errors are allowed to add up.
constexpr double k_steps = 50;

std::vector<double> half_of_what_was_not_predicted(const std::vector<double>& old,
                                                   const std::vector<double>& now, double dt,
                                                   const std::vector<double>& rate) {
  assert(rate.size() == now.size());
  std::vector<double> error(now.size());
  for (std::size_t i = 0; i < now.size(); ++i) error[i] = (now[i] - old[i] - dt * rate[i]) / 2;
  return error;
}

/// Nodes that none of these coherencies has as melt; empty: all.
std::vector<char> casting(const std::vector<double>& coherency, const std::vector<double>& before = {}) {
  std::vector<char> counts(coherency.size());
  for (std::size_t i = 0; i < counts.size(); ++i)
    counts[i] = coherency[i] >= 1 && (before.empty() || before[i] >= 1);
  return counts;
}

}  // namespace

std::vector<double> ErrorEstimate::coherency(const State& state) const {
  return phases_ == nullptr ? std::vector<double>{} : coherency_of(*phases_, state.heat);
}

double ErrorEstimate::size_of_displacement(std::span<const double> error,
                                           std::span<const char> counts) const {
  if (displacement_ == Displacement::motion) return norm_(error, counts);
  // The largest distortion of a casting is that of one node, which may move by as much as all others together
  // while the last melt freezes next to it.
  return counts.empty() ? norm_.of_distortion(error, counts) : norm_.farthest_distortion(error, counts);
}

bool ErrorEstimate::measures(const heat::StageFlows& flows) const {
  return phases_ != nullptr && phases_->heat != nullptr && flows.known();
}

double ErrorEstimate::change_of(const State& old, const State& now, const heat::StageFlows& flows) const {
  return measures(flows) ? norm_(heat::change_in_kelvin(*phases_->heat, old.heat, now.heat)) : 0.0;
}

/// The part of the error `mean` of a step that is not forgotten [K]: it may be committed once for every
/// `change` of the heat, of which `before` has gone before (docs/theory/thermal.md).
double ErrorEstimate::lasting(double mean, double before, double change) const {
  return mean * std::min(k_steps, change > 0 ? 1 + before / change : k_steps);
}

double ErrorEstimate::temperature_predictor(const State& old, const State& now, double dt, const Rates& rates,
                                            const heat::StageFlows& flows) const {
  if (!measures(flows) || rates.heat_flow.empty())
    return norm_(
        half_of_what_was_not_predicted(old.heat.temperature, now.heat.temperature, dt, rates.temperature));
  const std::vector<double> error = heat::time_error(*phases_->heat, now.heat, flows, rates.heat_flow);
  return std::max(norm_(error), lasting(norm_.mean(error), rates.changed, change_of(old, now, flows)));
}

double ErrorEstimate::skin_change(const State& old, const State& now) const {
  if (phases_ == nullptr || phases_->skin == nullptr || phases_->heat == nullptr) return 0;
  return phases_->skin->change(coherency(old), coherency(now));
}

double ErrorEstimate::skin_opening(const State& old, const State& now) const {
  double widest = 0;
  for (std::size_t c = 0; c < std::min(old.contacts.size(), now.contacts.size()); ++c) {
    const std::vector<contact::ContactPointState>&before = old.contacts[c].points,
          &after = now.contacts[c].points;
    for (std::size_t i = 0; i < std::min(before.size(), after.size()); ++i)
      if (before[i].suction > 0 && after[i].suction == 0)
        widest =
            std::max(widest, std::max(-after[i].penetration, 0.0) - std::max(-before[i].penetration, 0.0));
  }
  return parallel::global_max(widest);
}

double ErrorEstimate::displacement_predictor(const State& old, const State& now, double dt,
                                             const Rates& rates) const {
  return size_of_displacement(
      half_of_what_was_not_predicted(old.mechanics.displacement, now.mechanics.displacement, dt,
                                     rates.displacement),
      casting(coherency(old), rates.coherency));
}

std::span<const double> ErrorEstimate::temperature(const State& state) const {
  return state.heat.temperature.empty() ? phases_->temperature : state.heat.temperature;
}

double ErrorEstimate::stress_predictor(const State& old, const State& now, double dt,
                                       const Rates& rates) const {
  if (creep_ == nullptr || rates.creep.empty()) return 0;
  const mechanics::CreepField rate = creep_->flow(old.mechanics, now.mechanics, 1 / dt);
  return creep_->of_stress(mechanics::CreepError::error(rate, rates.creep, dt), rate, rates.creep,
                           temperature(now), now.mechanics, dt);
}

LocalError ErrorEstimate::doubling(const State& old, const State& whole, const State& halves,
                                   const Rates& rates, double dt, const heat::StageFlows& flows) const {
  // Heat, displacement, stress of creep and skin, each by its own measure of the difference.
  double in_heat = norm_(difference(whole.heat.temperature, halves.heat.temperature));
  if (measures(flows))
    in_heat =
        std::max(in_heat, lasting(norm_.mean(heat::change_in_kelvin(*phases_->heat, whole.heat, halves.heat)),
                                  rates.changed, change_of(old, halves, flows)));
  // Stress follows from the difference of the creep strains, relaxed over the step.
  double in_stress = 0;
  if (creep_ != nullptr)
    in_stress = creep_->of_stress(creep_->flow(whole.mechanics, halves.mechanics, 1),
                                  creep_->flow(old.mechanics, halves.mechanics, 1 / dt), rates.creep,
                                  temperature(halves), halves.mechanics, dt / 2);
  return {in_heat,
          size_of_displacement(difference(whole.mechanics.displacement, halves.mechanics.displacement),
                               casting(coherency(old))),
          in_stress, skin_change(old, halves), skin_opening(old, halves)};
}

Rates ErrorEstimate::rates_of(const State& old, const State& now, double dt,
                              const heat::StageFlows& flows) const {
  // Rates of heat where the thermal phase knows its flows, else of temperature.
  Rates rates;
  if (measures(flows))
    rates.heat_flow = heat::flow_at_end(*phases_->heat, flows);
  else
    rates.temperature = difference(old.heat.temperature, now.heat.temperature, dt);
  rates.displacement = difference(old.mechanics.displacement, now.mechanics.displacement, dt);
  rates.coherency = coherency(old);
  if (creep_ != nullptr) rates.creep = creep_->flow(old.mechanics, now.mechanics, 1 / dt);
  return rates;
}

}  // namespace solidus::coupling
