/// Elements are born after the step that leads to their time: its end is as it was computed, and the state
/// that a checkpoint holds is that of the next step's start.
#include "coupling/growth.hpp"

namespace solidus::coupling {

BodyHeat let_grow(Growth& growth, CouplingScheme& scheme, const std::function<double(const State&)>& energy,
                  State& state) {
  const double before = energy ? energy(state) : 0.0;
  BodyHeat heat = growth.grow(state.time, &state);
  scheme.conditions_changed();
  scheme.synchronise(state);
  // Metal that arrives changes the internal energy without heat or work, and is booked as carried.
  if (energy) heat.energy += energy(state) - before;
  scheme.forget();
  return heat;
}

void add_births(const Growth& growth, std::vector<TimeEvent>& events) {
  for (const double time : growth.births()) events.push_back({time, true, false});
}

}  // namespace solidus::coupling
