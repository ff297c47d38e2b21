#include "coupling/phases.hpp"

#include <algorithm>
#include <limits>

#include "algebra/parallel.hpp"

namespace solidus::coupling {

void summarise(const Phases& phases, const State& state, StepEffort& effort) {
  if (phases.heat != nullptr) {
    const auto owned = static_cast<std::ptrdiff_t>(phases.heat->mesh().n_owned_nodes);
    const auto begin = state.heat.temperature.begin();
    const auto [low, high] = std::minmax_element(begin, begin + owned);
    constexpr double k_far = std::numeric_limits<double>::max();
    effort.min_temperature = algebra::global_min(owned > 0 ? *low : k_far);
    effort.max_temperature = algebra::global_max(owned > 0 ? *high : -k_far);
    effort.solid_fraction = phases.heat->mean_solid_fraction(state.heat);
  }
  effort.contacts.clear();
  for (const contact::ContactPair* pair : phases.contacts) {
    const contact::ContactSums sums = pair->sums(state.heat.temperature);
    effort.contacts.push_back(
        {static_cast<int>(sums.closed_points), static_cast<int>(sums.points), sums.heat, sums.force});
  }
}

double contact_energy(const Phases& phases) {
  double energy = 0;
  for (const contact::ContactPair* pair : phases.contacts) energy += pair->sums({}).energy;
  return energy;
}

}  // namespace solidus::coupling
