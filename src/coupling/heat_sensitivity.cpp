#include "coupling/heat_sensitivity.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "system/errors.hpp"

namespace solidus::coupling {

namespace {

void check(const Phases& phases) {
  if (phases.heat == nullptr || phases.mechanics != nullptr)
    throw InputError({}, "derivatives are known of runs of heat alone", "physics = \"heat\"");
  const auto stores = [](const contact::ContactPair* pair) { return pair->parts().heat.has_temperature(); };
  if (std::ranges::any_of(phases.contacts, stores))
    throw InputError({}, "derivatives are not known where an interface stores heat",
                     "contacts without contact.interface.heat_capacity");
}

/// Whether the tangents of all pairs are exact: that of radiation is not (contact/heat/heat_term.hpp).
bool exact(const Phases& phases) {
  return std::ranges::none_of(phases.contacts, [](const contact::ContactPair* pair) {
    const auto& heat = pair->parts().spec.heat;
    return heat && heat->slave_emissivity > 0 && heat->master_emissivity > 0;
  });
}

/// Heat through contact is that of a pass in which it flows, over this step.
void begin_heat(const Phases& phases, double dt) {
  for (contact::ContactPair* pair : phases.contacts) pair->parts().heat.begin(dt, false);
}

}  // namespace

HeatSensitivity::HeatSensitivity(const Phases& phases, std::vector<Neighbour> neighbours)
    : phases_(phases), sensitivity_((check(phases), *phases.heat), exact(phases)) {
  for (Neighbour& n : neighbours) {
    of_neighbours_.push_back(n.phases);
    neighbours_.push_back({n.phases->heat, std::move(n.initial)});
  }
  phases.heat->keep_stages(true);
}

void HeatSensitivity::begin(const State& state) {
  if (!state.burning.lit.empty())
    throw InputError({}, "derivatives are not known where bodies burn",
                     "a case without kind = \"exothermic\"");
  before_ = state.heat;
}

void HeatSensitivity::step(const StepRecord& record, const State& state) {
  if (record.fields.flows.dt != record.dt)
    throw std::logic_error("sensitivities: the step is not the one that its flows are of");
  begin_heat(phases_, record.dt);
  for (const Phases* phases : of_neighbours_) begin_heat(*phases, record.dt);
  sensitivity_.advance(before_, record.fields.flows, state.heat, neighbours_);
  before_ = state.heat;
}

}  // namespace solidus::coupling
