#include "coupling/step_sensitivity.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "coupling/contact_states.hpp"
#include "system/errors.hpp"

namespace solidus::coupling {

namespace {

void check(const Phases& phases) {
  if (phases.heat == nullptr)
    throw InputError({}, "derivatives are known of runs with heat", "physics = \"heat\" or thermomechanical");
  if (phases.mechanics != nullptr && phases.mechanics->bodies().inertia)
    throw InputError({}, "derivatives are not known of bodies with inertia", "a case without [dynamics]");
  const auto stores = [](const contact::ContactPair* pair) { return pair->parts().heat.has_temperature(); };
  if (std::ranges::any_of(phases.contacts, stores))
    throw InputError({}, "derivatives are not known where an interface stores heat or rubs",
                     "contacts without contact.interface.heat_capacity and friction");
}

/// Whether the tangents of all terms are exact: those of radiation between surfaces are not
/// (contact/heat/heat_term.hpp), nor is the lumped one of structural heat.
bool exact(const Phases& phases) {
  return phases.structural == nullptr &&
         std::ranges::none_of(phases.contacts, [](const contact::ContactPair* pair) {
           const auto& heat = pair->parts().spec.heat;
           return heat && heat->slave_emissivity > 0 && heat->master_emissivity > 0;
         });
}

/// Where bodies deform derivatives are as exact as the run itself, ten times its tolerance.
double accuracy(const Phases& phases) {
  if (phases.mechanics == nullptr) return heat::k_sensitivity_accuracy;
  return std::max(heat::k_sensitivity_accuracy, 10 * phases.mechanics->bodies().options.newton.tolerance);
}

/// Heat through contact is that of a pass in which it flows, over this step.
void begin_heat(const Phases& phases, double dt) {
  for (contact::ContactPair* pair : phases.contacts) pair->parts().heat.begin(dt, false);
}

}  // namespace

StepSensitivity::StepSensitivity(const Phases& phases, std::vector<Neighbour> neighbours)
    : phases_(phases), of_heat_((check(phases), *phases.heat), exact(phases), accuracy(phases)) {
  for (Neighbour& n : neighbours) {
    heat_.push_back({n.phases->heat, std::move(n.initial.heat)});
    deformed_.push_back({n.phases, std::move(n.initial.mechanics), std::move(n.initial.contacts)});
  }
  if (phases.mechanics != nullptr)
    of_bodies_ = std::make_unique<mechanics::StepSensitivity>(*phases.mechanics, accuracy(phases));
}

void StepSensitivity::begin(const State& state) {
  if (!state.burning.lit.empty())
    throw InputError({}, "derivatives are not known where bodies burn",
                     "a case without kind = \"exothermic\"");
  before_ = state;
}

void StepSensitivity::step(const StepRecord& record, const State& state) {
  if (record.fields.flows.dt != record.dt)
    throw std::logic_error("sensitivities: the step is not the one that its flows are of");
  // Deformation comes first, as in the run: it decides through which gaps heat flows.
  if (of_bodies_) deform(record, state);
  begin_heat(phases_, record.dt);
  for (const Deformed& n : deformed_) begin_heat(*n.phases, record.dt);
  of_heat_.advance(before_.heat, record.fields.flows, state.heat, heat_);
  before_ = state;
}

/// The equilibrium of the step once more with the phases at hand, and that of each neighbour beside it.
void StepSensitivity::deform(const StepRecord& record, const State& state) {
  mechanics::StepDeformation deformation = deform(phases_, before_, state, record, nullptr);
  if (phases_.structural != nullptr) phases_.structural->set_deformation(std::move(deformation));
  State old;
  for (std::size_t i = 0; i < deformed_.size(); ++i) {
    Deformed& n = deformed_[i];
    // A neighbour starts from its own state, in its own pass; what it has in common with the run is the
    // tangent, and the end of the step near which it ends itself.
    old.heat = heat_[i].state;
    old.mechanics = std::move(n.mechanics);
    old.contacts = std::move(n.contacts);
    deformation = deform(*n.phases, old, state, record, &n);
    if (n.phases->structural != nullptr) n.phases->structural->set_deformation(std::move(deformation));
  }
}

/// @param now        the end of the run's step
/// @param neighbour  gets its end; null: the step of the run itself
mechanics::StepDeformation StepSensitivity::deform(const Phases& phases, const State& old, const State& now,
                                                   const StepRecord& record, Deformed* neighbour) {
  // The pass is that of the split with mechanics first: at the temperatures of t_n.
  const std::vector<double> share = plateau_share(phases, old.heat);
  const mechanics::MechanicalPass pass{
      .time = now.time, .dt = record.dt, .temperature = old.heat.temperature, .plateau_share = share};
  if (phases.structural != nullptr) phases.structural->release();
  // Multipliers are those that the run has ended with: an augmented contact is then as stiff as its penalty
  // here.
  const std::vector<double> coherency =
      phases.contacts.empty() ? std::vector<double>{} : coherency_of(phases, old.mechanics, pass);
  begin_contacts(phases, old.contacts, old.mechanics, pass, coherency, now.contacts);
  mechanics::StepDeformation deformation;
  if (neighbour == nullptr) {
    // A step whose history does not come out again was not made of one equilibrium at these temperatures.
    if (!of_bodies_->linearise(old.mechanics, pass, now.mechanics, deformation))
      throw InputError(
          {}, "derivatives are known where the thermal phase leaves flow as deformation has found it",
          "thermal_flow = \"kept\" in [coupling]");
    for (contact::ContactPair* pair : phases.contacts) pair->update(now.mechanics.displacement);
    return deformation;
  }
  neighbour->mechanics = of_bodies_->follow(*phases.mechanics, old.mechanics, pass, deformation);
  for (contact::ContactPair* pair : phases.contacts) pair->update(neighbour->mechanics.displacement);
  neighbour->contacts = contact_states(phases);
  return deformation;
}

void StepSensitivity::read(std::size_t neighbour, State& state) const {
  state.time = before_.time;
  state.heat = heat_[neighbour].state;
  if (!of_bodies_) return;
  state.mechanics = deformed_[neighbour].mechanics;
  state.contacts = deformed_[neighbour].contacts;
}

}  // namespace solidus::coupling
