#include "coupling/sequential_split.hpp"

#include <stdexcept>

#include "coupling/contact_states.hpp"
#include "coupling/contact_work.hpp"
#include "coupling/passes.hpp"
#include "coupling/stability_audit.hpp"
#include "system/profile.hpp"

namespace solidus::coupling {

namespace {

/// x + dt × rate; empty where no rate is known.
std::vector<double> extrapolated(const std::vector<double>& x, const std::vector<double>& rate, double dt) {
  std::vector<double> guess(rate.size());
  for (std::size_t i = 0; i < guess.size(); ++i) guess[i] = x[i] + dt * rate[i];
  return guess;
}

std::vector<double> rate(const std::vector<double>& from, const std::vector<double>& to, double dt) {
  std::vector<double> result(to.size());
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = (to[i] - from[i]) / dt;
  return result;
}

/// The interfaces that have a temperature begin with the one at rest between the bodies at t_n: in the first
/// step it is not known before a mechanical phase, and heat comes first.
void find_interface_temperatures(const Phases& phases, const State& old, double time) {
  if (!old.contacts.empty()) return;
  const std::vector<double> coherency = coherency_of(phases, old.heat);
  for (contact::ContactPair* pair : phases.contacts) {
    if (!pair->has_temperature()) continue;
    pair->begin({}, {.time = time,
                     .dt = 0,
                     .displacement = old.mechanics.displacement,
                     .temperature = old.heat.temperature,
                     .coherency = coherency});
    pair->update(old.mechanics.displacement);
  }
}

}  // namespace

SequentialSplit::SequentialSplit(Phases phases, mechanics::Mapping mapping, PhaseOrder order,
                                 ThermalFlow flow)
    : phases_(std::move(phases)), order_(order), flow_(flow) {
  if (phases_.mechanics != nullptr && phases_.mechanics->mapping() != mapping)
    throw std::invalid_argument("the mechanical phase was built for another split");
  if (phases_.mechanics == nullptr || phases_.heat == nullptr) order_ = PhaseOrder::mechanics_first;
}

void SequentialSplit::synchronise(const State& state) {
  if (phases_.mechanics == nullptr) return;  // without deformation the gaps stay as they were made
  restore_contacts(phases_, state);
}

void SequentialSplit::forget() {
  if (phases_.mechanics != nullptr) phases_.mechanics->forget();
  if (phases_.heat != nullptr) phases_.heat->forget();
  for (contact::ContactPair* pair : phases_.contacts) pair->forget();
}

StepEffort SequentialSplit::advance(const State& old, State& trial, double time, double dt) {
  return *advance_unless(old, trial, time, dt, {});
}

std::optional<StepEffort> SequentialSplit::advance_unless(const State& old, State& trial, double time,
                                                          double dt, const HeatJudge& stop) {
  std::optional<StepEffort> effort = order_ == PhaseOrder::heat_first ? heat_first(old, trial, time, dt, stop)
                                                                      : mechanics_first(old, trial, time, dt);
  if (effort) summarise(phases_, trial, *effort);
  return effort;
}

StepEffort SequentialSplit::mechanics_first(const State& old, State& trial, double time, double dt) {
  StepEffort effort;
  if (phases_.mechanics != nullptr) mechanical_phase(old, old, trial, time, dt, effort);
  if (phases_.heat != nullptr)
    thermal_phase(old, old, trial, {.time = time, .dt = dt, .stepping = phases_.heat->stepping()}, effort);
  book_interface(effort.energy, phases_.structural != nullptr);
  const profile::Part part("audit");
  effort.stability = stability_audit(phases_, old, trial, effort);
  return effort;
}

std::optional<StepEffort> SequentialSplit::heat_first(const State& old, State& trial, double time, double dt,
                                                      const HeatJudge& stop) {
  State warm;
  StepEffort effort = heat_at_rest(old, warm, time, dt);
  if (stop && stop(warm, effort.fields.flows)) return {};
  const contact::InterfaceSums conducted = effort.energy.interface;
  StepEffort deformed;
  mechanical_phase(old, warm, trial, time, dt, deformed);
  thermal_phase(old, warm, trial, {.time = time, .dt = dt, .adiabatic = true}, deformed);
  book_interface(deformed.energy, phases_.structural != nullptr);
  deformed.stability = stability_audit(phases_, warm, trial, deformed);
  effort += deformed;
  effort.energy.interface.add(conducted);
  return effort;
}

StepEffort SequentialSplit::heat_at_rest(const State& old, State& warm, double time, double dt) {
  StepEffort effort;
  phases_.mechanics->hold_deformation(old.mechanics, old.heat.temperature, plateau_share(phases_, old.heat));
  find_interface_temperatures(phases_, old, time - dt);
  for (contact::ContactPair* pair : phases_.contacts) pair->hold_deformation();
  thermal_pass(phases_, old, warm, {.time = time, .dt = dt, .stepping = phases_.heat->stepping()}, effort);
  book_interface(effort.energy, phases_.structural != nullptr);
  effort.stability = stability_audit(phases_, old, warm, effort);
  return effort;
}

void SequentialSplit::thermal_phase(const State& old, const State& warm, State& trial,
                                    const heat::ThermalPass& pass, StepEffort& effort) {
  if (flow_ == ThermalFlow::kept || phases_.mechanics == nullptr) {
    thermal_pass(phases_, warm, trial, pass, effort);
    return;
  }
  const std::vector<double> share = plateau_share(phases_, warm.heat);
  thermal_pass_with_flow(
      phases_, warm, trial, pass, old.mechanics,
      {.time = pass.time, .dt = pass.dt, .temperature = warm.heat.temperature, .plateau_share = share},
      effort);
}

// From the temperature of t_n (4.40, 4.46), or from the one that conduction has left.
void SequentialSplit::mechanical_phase(const State& old, const State& warm, State& trial, double time,
                                       double dt, StepEffort& effort) {
  ContactWork contact(phases_);
  const std::vector<double>& temperature =
      phases_.heat != nullptr ? warm.heat.temperature : phases_.temperature;
  const std::vector<double> guess = extrapolated(old.mechanics.displacement, old.displacement_rate, dt),
                            pressure = extrapolated(old.mechanics.pressure, old.pressure_rate, dt);
  const std::vector<double> share = plateau_share(phases_, warm.heat);
  mechanical_pass(phases_, {old.mechanics, warm.contacts, warm.heat}, trial,
                  {.time = time,
                   .dt = dt,
                   .temperature = temperature,
                   .plateau_share = share,
                   .guess = guess,
                   .guessed_pressure = pressure},
                  effort);
  trial.displacement_rate = rate(old.mechanics.displacement, trial.mechanics.displacement, dt);
  trial.pressure_rate = rate(old.mechanics.pressure, trial.mechanics.pressure, dt);
  contact.add(phases_.mechanics->work_share());
  contact.book(effort.energy);
}

}  // namespace solidus::coupling
