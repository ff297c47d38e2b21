/// What can be said of all phases together: coherency, ranges, and the summary of a step's effort.
#include "coupling/phases.hpp"

#include <algorithm>
#include <limits>

#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"

namespace solidus::coupling {

namespace {

/// @param active  null: of all nodes
void range_of_owned(const std::vector<double>& temperature, Index n_owned, const linear::ActiveSet* active,
                    StepEffort& effort) {
  constexpr double k_unbounded = std::numeric_limits<double>::max();  // of a process that owns nothing
  double low = k_unbounded, high = -k_unbounded;
  for (Index i = 0; i < n_owned; ++i) {
    if (active != nullptr && !active->node(i)) continue;
    low = std::min(low, temperature[as_size(i)]);
    high = std::max(high, temperature[as_size(i)]);
  }
  effort.min_temperature = parallel::global_min(low);
  effort.max_temperature = parallel::global_max(high);
  // Before a body begins to grow nothing is there: then the range is that of what will come.
  if (effort.max_temperature < effort.min_temperature && active != nullptr)
    range_of_owned(temperature, n_owned, nullptr, effort);
}

}  // namespace

std::vector<double> plateau_share(const Phases& phases, const heat::ThermalState& state) {
  return phases.heat != nullptr ? phases.heat->states().plateau_share(state) : std::vector<double>{};
}

std::vector<double> coherency_of(const Phases& phases, const heat::ThermalState& heat) {
  return phases.coherency == nullptr ? std::vector<double>{}
                                     : phases.coherency->at(phases.heat, heat, phases.temperature);
}

std::vector<double> coherency_of(const Phases& phases, const mechanics::MechanicalState& old,
                                 const mechanics::MechanicalPass& pass) {
  if (phases.coherency == nullptr) return {};
  return phases.coherency->of(phases.mechanics->mean_solid_fraction(old, pass),
                              phases.mechanics->bodies().nodal_phases.fields());
}

void summarise(const Phases& phases, const State& state, StepEffort& effort) {
  // The range of temperatures and the solid part are those of heat, or of the given temperatures without
  // heat.
  if (phases.heat != nullptr) {
    range_of_owned(state.heat.temperature, phases.heat->mesh().n_owned_nodes, &heat::active(*phases.heat),
                   effort);
    effort.solid_fraction = phases.heat->states().mean_solid_fraction(state.heat);
  } else {
    range_of_owned(phases.temperature, phases.mechanics->mesh().n_owned_nodes, nullptr, effort);
  }
  effort.contacts.clear();
  // Each contact tells its sums at the end of the step.
  for (const contact::ContactPair* pair : phases.contacts) {
    const contact::ContactSums sums = contact::sums(pair->view(), state.heat.temperature);
    effort.contacts.push_back({.closed_points = static_cast<int>(sums.closed_points),
                               .points = static_cast<int>(sums.points),
                               .heat = sums.heat,
                               .force = sums.force,
                               .sticking_points = static_cast<int>(sums.sticking_points),
                               .friction = sums.friction,
                               .resultant = sums.resultant,
                               .moment = sums.moment,
                               .dissipation = sums.dissipation,
                               .heat_to_slave = sums.heat_to_slave,
                               .heat_to_master = sums.heat_to_master,
                               .wet_area = sums.wet_area,
                               .left_area = sums.left_area,
                               .left_gap = sums.left_gap,
                               .left_penetration = pair->parts().augmentations.left_penetration()});
  }
}

}  // namespace solidus::coupling
