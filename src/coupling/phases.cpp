#include "coupling/phases.hpp"

#include <algorithm>
#include <limits>

#include "algebra/parallel.hpp"

namespace solidus::coupling {

namespace {

void range_of_owned(const std::vector<double>& temperature, Index n_owned, StepEffort& effort) {
  const auto [low, high] = std::minmax_element(temperature.begin(), temperature.begin() + n_owned);
  constexpr double k_far = std::numeric_limits<double>::max();  // of a process that owns nothing
  effort.min_temperature = algebra::global_min(n_owned > 0 ? *low : k_far);
  effort.max_temperature = algebra::global_max(n_owned > 0 ? *high : -k_far);
}

}  // namespace

void summarise(const Phases& phases, const State& state, StepEffort& effort) {
  if (phases.heat != nullptr) {
    range_of_owned(state.heat.temperature, phases.heat->mesh().n_owned_nodes, effort);
    effort.solid_fraction = phases.heat->mean_solid_fraction(state.heat);
  } else {
    range_of_owned(phases.temperature, phases.mechanics->mesh().n_owned_nodes, effort);
  }
  effort.contacts.clear();
  for (const contact::ContactPair* pair : phases.contacts) {
    const contact::ContactSums sums = pair->sums(state.heat.temperature);
    effort.contacts.push_back({.closed_points = static_cast<int>(sums.closed_points),
                               .points = static_cast<int>(sums.points),
                               .heat = sums.heat,
                               .force = sums.force,
                               .sticking_points = static_cast<int>(sums.sticking_points),
                               .friction = sums.friction,
                               .resultant = sums.resultant,
                               .moment = sums.moment,
                               .dissipation = sums.dissipation});
  }
}

}  // namespace solidus::coupling
