/// The two halves of a step as calls of the phases, in the order that makes the product formula of second
/// order; the energies of both are added up.
#include "coupling/double_pass.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "coupling/contact_states.hpp"
#include "coupling/contact_work.hpp"
#include "coupling/largest_difference.hpp"
#include "coupling/passes.hpp"
#include "coupling/stability_audit.hpp"
#include "mechanics/mechanical_restart.hpp"
#include "system/errors.hpp"

namespace solidus::coupling {

namespace {

/// Iterations of an isothermal pass: at most, and the share of the first change of temperature that may be
/// left, which is an error of the step's error. A change that does not fall to the second share in all of
/// them says that the coupling is too strong.
constexpr int k_most_iterations = 12;
constexpr double k_settled = 1e-4, k_falls = 0.1;

}  // namespace

DoublePass::DoublePass(Phases phases, ThermalFlow flow) : phases_(std::move(phases)), flow_(flow) {
  if (phases_.heat == nullptr || phases_.mechanics == nullptr)
    // The energy of a half step is exchanged in one form; only the energy and the entropy form
    // close the balance.
    throw std::invalid_argument("the double pass needs both phases");
  using mechanics::Mapping;
  const Mapping mapping = phases_.mechanics->bodies().options.mapping;
  if (mapping == Mapping::simultaneous)
    throw std::invalid_argument("the mechanical phase was built for another scheme");
  if (mapping == Mapping::isentropic && phases_.structural == nullptr)
    throw std::invalid_argument("isentropic passes need structural heat");
  using Form = mechanics::StructuralForm;
  // Both halves must book the same exchange.
  if (phases_.structural != nullptr && phases_.structural->form() != Form::energy &&
      phases_.structural->form() != Form::entropy)
    throw std::invalid_argument("the double pass has the energy and the entropy form only");
}

bool DoublePass::repeats() const {
  return phases_.mechanics->bodies().options.mapping == mechanics::Mapping::isothermal &&
         phases_.structural != nullptr;
}

void DoublePass::synchronise(const State& state) {
  restore_contacts(phases_, state);
}

void DoublePass::forget() {
  phases_.mechanics->system().solver().forget();
  heat::forget(*phases_.heat);
  for (contact::ContactPair* pair : phases_.contacts) pair->parts().geometry.graph().forget();
}

StepEffort DoublePass::advance(const State& old, State& trial, double time, double dt) {
  State half;
  mechanics::ForcesAtWork in_middle;
  StepEffort effort = first_half(old, half, time, dt, in_middle);
  const contact::InterfaceSums first = effort.energy.interface;
  effort += second_half(half, trial, time, dt, in_middle);
  effort.energy.interface.add(first);
  summarise(phases_, trial, effort);
  return effort;
}

void DoublePass::mechanical_half(const State& start, State& end, mechanics::MechanicalPass& pass,
                                 const Answer& answer, Half& half, StepEffort& effort) const {
  // The first pass holds temperature or entropy as the scheme says. Passes that hold the temperature repeat
  // until it is the one that their own deformation leads to.
  int augmentations = 0;
  half.report = mechanical_pass(phases_, start, end, pass, effort, {}, &augmentations);
  if (!repeats()) return;
  std::vector<double> held(pass.iterate_temperature.begin(), pass.iterate_temperature.end());
  if (held.empty()) held.assign(pass.temperature.begin(), pass.temperature.end());
  half.held = std::move(held);
  double first = 0, change = 0;
  // Each iteration asks which temperature the deformation leads to, and repeats the pass with it. The change
  // has to fall by a factor in all; otherwise the coupling is too strong for such passes.
  for (int iteration = 1; iteration <= k_most_iterations; ++iteration) {
    State led;
    answer(half.report.deformation, led);
    change = largest_difference(led.heat.temperature, half.held);
    if (iteration == 1) first = change;
    if (!(change > k_settled * first)) return;
    half.held = std::move(led.heat.temperature);
    pass.iterate_temperature = half.held;
    pass.iterate = &end.mechanics;
    const std::vector<contact::ContactState> contacts = end.contacts;
    half.report.deformation.clear();  // its storage serves again
    half.report = mechanical_pass(phases_, start, end, pass, effort, contacts, &augmentations);
  }
  if (change <= k_falls * first) return;
  throw StepRejected(
      fmt::format("coupling: isothermal passes do not converge: the change of temperature went "
                  "from {:.3g} K to {:.3g} K in {} iterations",
                  first, change, k_most_iterations),
      "the coupling is too strong for passes that hold the temperature", Failure::divergence);
}

void DoublePass::thermal_half(const State& start, State& end, mechanics::StepDeformation& deformation,
                              const heat::ThermalPass& heat, const mechanics::MechanicalPass& moved,
                              StepEffort& effort) const {
  if (flow_ == ThermalFlow::kept)
    thermal_pass(phases_, start, end, deformation, heat, effort);
  else
    thermal_pass_with_flow(phases_, start, end, deformation, heat, start.mechanics, moved, effort);
}

StepEffort DoublePass::first_half(const State& old, State& half, double time, double dt,
                                  mechanics::ForcesAtWork& in_middle) {
  StepEffort effort;
  const double middle = time - 0.5 * dt;
  const bool moves = phases_.mechanics->bodies().inertia != nullptr;
  ContactWork contact(phases_);
  // The share of the plateau is held while the mechanical phase works, as the temperature is.
  const std::vector<double> share = plateau_share(phases_, old.heat);
  // Step 0: a predictor of heat over the first half with the deformation held.
  if (phases_.structural != nullptr) phases_.structural->release();
  mechanics::StepDeformation held =
      mechanics::held_deformation(*phases_.mechanics, old.mechanics, old.heat.temperature, share);
  for (contact::ContactPair* pair : phases_.contacts) pair->parts().heat.hold_deformation();
  // It gives the temperature at which the mechanical phase evaluates properties.
  State predicted;
  thermal_pass(phases_, old, predicted, held, {.time = middle, .dt = 0.5 * dt}, effort);
  held.clear();  // its storage serves again
  // Step 1: mechanics over the first half, at the temperatures of t_n.
  mechanics::MechanicalPass pass{.time = middle,
                                 .dt = 0.5 * dt,
                                 .temperature = old.heat.temperature,
                                 .plateau_share = share,
                                 .iterate_temperature = predicted.heat.temperature,
                                 .returns_at_work = !moves};
  Half moved;
  mechanical_half(
      old, half, pass,
      [&](const mechanics::StepDeformation& deformation, State& led) {
        thermal_pass(phases_, old, led, deformation, {.time = middle, .dt = 0.5 * dt}, effort);
      },
      moved, effort);
  in_middle = std::move(moved.report.at_work);
  // The work of contact in the half step is booked before gaps move on.
  contact.add(phases_.mechanics->bodies().work_share());
  contact.book(effort.energy);
  for (contact::ContactPair* pair : phases_.contacts) pair->parts().heat.predict();
  // The deformation of the whole step acts at once before it: temperatures that leave their range by it come
  // back in step 4.
  thermal_half(old, half, moved.report.deformation,
               {.time = time, .dt = dt, .stepping = heat::ThermalStepping::sdirk2, .within_range = false},
               pass, effort);
  book_interface(effort.energy, phases_.structural != nullptr);
  effort.stability = stability_audit(phases_, old, half, moved.report.deformation, effort);
  return effort;
}

StepEffort DoublePass::second_half(const State& half, State& trial, double time, double dt,
                                   const mechanics::ForcesAtWork& in_middle) {
  StepEffort effort;
  const bool moves = phases_.mechanics->bodies().inertia != nullptr;
  const heat::ThermalPass adiabatic{.time = time, .dt = dt, .adiabatic = true};
  ContactWork contact(phases_);
  const std::vector<double> share = plateau_share(phases_, half.heat);
  mechanics::MechanicalPass pass{.time = time,
                                 .dt = 0.5 * dt,
                                 .temperature = half.heat.temperature,
                                 .plateau_share = share,
                                 // Without inertia the forces in the middle do the work of both
                                 // halves.
                                 .at_work = moves ? nullptr : &in_middle};
  // Step 3: mechanics over the second half, then heat that only exchanges with deformation (step
  // 4).
  Half moved;
  mechanical_half(
      half, trial, pass,
      [&](const mechanics::StepDeformation& deformation, State& led) {
        thermal_pass(phases_, half, led, deformation, adiabatic, effort);
      },
      moved, effort);
  // In quasi-statics the work of the pressure in the middle, as that of the stress.
  contact.add(moves ? phases_.mechanics->bodies().work_share() : 0);
  contact.book(effort.energy);
  thermal_half(half, trial, moved.report.deformation, adiabatic, pass, effort);
  book_interface(effort.energy, phases_.structural != nullptr);
  effort.energy.heat_exchanged = 0;  // what deformation and heat exchange within a point
  effort.stability = stability_audit(phases_, half, trial, moved.report.deformation, effort);
  return effort;
}

}  // namespace solidus::coupling
