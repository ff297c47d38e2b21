#include "coupling/double_pass.hpp"

#include <stdexcept>

#include "coupling/contact_states.hpp"
#include "coupling/contact_work.hpp"
#include "coupling/passes.hpp"
#include "coupling/stability_audit.hpp"

namespace solidus::coupling {

DoublePass::DoublePass(Phases phases) : phases_(std::move(phases)) {
  if (phases_.heat == nullptr || phases_.mechanics == nullptr || phases_.structural == nullptr)
    throw std::invalid_argument("the double pass needs both phases and structural heat");
  if (phases_.mechanics->mapping() != mechanics::Mapping::isentropic)
    throw std::invalid_argument("the mechanical phase was built for another split");
  if (phases_.mechanics->dynamic()) throw std::invalid_argument("the double pass has no inertia");
}

void DoublePass::synchronise(const State& state) {
  restore_contacts(phases_, state);
}

void DoublePass::forget() {
  phases_.mechanics->forget();
  phases_.heat->forget();
  for (contact::ContactPair* pair : phases_.contacts) pair->forget();
}

StepEffort DoublePass::advance(const State& old, State& trial, double time, double dt) {
  State half;
  StepEffort effort = first_half(old, half, time, dt);
  const contact::InterfaceSums first = effort.energy.interface;
  effort += second_half(half, trial, time, dt);
  add(first, effort.energy.interface);
  summarise(phases_, trial, effort);
  return effort;
}

StepEffort DoublePass::first_half(const State& old, State& half, double time, double dt) {
  StepEffort effort;
  const double middle = time - 0.5 * dt;
  ContactWork contact(phases_);
  const std::vector<double> share = plateau_share(phases_, old.heat);
  phases_.mechanics->hold_deformation(old.mechanics, old.heat.temperature, share);
  for (contact::ContactPair* pair : phases_.contacts) pair->hold_deformation();
  State predicted;
  thermal_pass(phases_, old, predicted, {.time = middle, .dt = 0.5 * dt}, effort);
  mechanical_pass(phases_, old, half,
                  {.time = middle,
                   .dt = 0.5 * dt,
                   .temperature = old.heat.temperature,
                   .plateau_share = share,
                   .iterate_temperature = predicted.heat.temperature,
                   .work = mechanics::StressAtWork::end_kept},
                  effort);
  contact.add();
  contact.book(effort.energy);
  for (contact::ContactPair* pair : phases_.contacts) pair->predict_heat();
  // The deformation of the whole step acts at once before it: temperatures that leave their range by it come
  // back in step 4.
  thermal_pass(phases_, old, half,
               {.time = time, .dt = dt, .stepping = heat::ThermalStepping::sdirk2, .within_range = false},
               effort);
  book_interface(effort.energy, true);
  effort.stability = stability_audit(phases_, old, half, effort);
  return effort;
}

StepEffort DoublePass::second_half(const State& half, State& trial, double time, double dt) {
  StepEffort effort;
  ContactWork contact(phases_);
  const std::vector<double> share = plateau_share(phases_, half.heat);
  mechanical_pass(phases_, half, trial,
                  {.time = time,
                   .dt = 0.5 * dt,
                   .temperature = half.heat.temperature,
                   .plateau_share = share,
                   .work = mechanics::StressAtWork::kept},
                  effort);
  contact.add(0);  // of the pressure in the middle, as that of the stress
  contact.book(effort.energy);
  thermal_pass(phases_, half, trial, {.time = time, .dt = dt, .adiabatic = true}, effort);
  book_interface(effort.energy, true);
  effort.energy.heat_exchanged = 0;  // what deformation and heat exchange within a point
  effort.stability = stability_audit(phases_, half, trial, effort);
  return effort;
}

}  // namespace solidus::coupling
