#include "coupling/error_estimate.hpp"

#include <cassert>
#include <cstddef>

namespace solidus::coupling {

namespace {

std::vector<double> difference(const std::vector<double>& from, const std::vector<double>& to,
                               double divisor = 1) {
  std::vector<double> result(to.size());
  for (std::size_t i = 0; i < to.size(); ++i) result[i] = (to[i] - from[i]) / divisor;
  return result;
}

std::vector<double> half_of_what_was_not_predicted(const std::vector<double>& old,
                                                   const std::vector<double>& now, double dt,
                                                   const std::vector<double>& rate) {
  assert(rate.size() == now.size());
  std::vector<double> error(now.size());
  for (std::size_t i = 0; i < now.size(); ++i) error[i] = (now[i] - old[i] - dt * rate[i]) / 2;
  return error;
}

}  // namespace

LocalError ErrorEstimate::predictor(const State& old, const State& now, double dt, const Rates& rates) const {
  return {norm_(half_of_what_was_not_predicted(old.heat.temperature, now.heat.temperature, dt,
                                               rates.temperature)),
          norm_(half_of_what_was_not_predicted(old.mechanics.displacement, now.mechanics.displacement, dt,
                                               rates.displacement))};
}

LocalError ErrorEstimate::doubling(const State& whole, const State& halves) const {
  return {norm_(difference(whole.heat.temperature, halves.heat.temperature)),
          norm_(difference(whole.mechanics.displacement, halves.mechanics.displacement))};
}

Rates rates_of(const State& old, const State& now, double dt) {
  return {difference(old.heat.temperature, now.heat.temperature, dt),
          difference(old.mechanics.displacement, now.mechanics.displacement, dt)};
}

}  // namespace solidus::coupling
