/// The calls around the solve of a phase that every scheme needs: contact before and after, augmentations,
/// and the energies for the audit.
#include "coupling/passes.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "coupling/contact_states.hpp"
#include "coupling/contact_work.hpp"
#include "coupling/largest_difference.hpp"
#include "mechanics/elements/block_kernel.hpp"
#include "mechanics/mechanical_restart.hpp"
#include "system/errors.hpp"
#include "system/processes.hpp"
#include "system/profile.hpp"

namespace solidus::coupling {

namespace {

/// @param hardest  effort of the harder stage
void add(const linear::NewtonReport& newton, int hardest, double seconds, PhaseEffort& effort) {
  effort.iterations += newton.iterations;
  effort.hardest += hardest;
  effort.linear_iterations += newton.linear_iterations;
  effort.residual = newton.residuals.empty() ? 0.0 : newton.residuals.back();
  effort.seconds += seconds;
}

/// Iterations between thermal phase and return mapping: at most, and the share of the step's largest change
/// of temperature that the last one may bring, the tolerance of the nodal heat balance.
constexpr int k_most_flow_iterations = 12;
constexpr double k_flow_settled = heat::k_nodal_tolerance;

}  // namespace

mechanics::MechanicalReport mechanical_pass(const Phases& phases, const MechanicalStart& old, State& trial,
                                            const mechanics::MechanicalPass& pass, StepEffort& effort,
                                            const std::vector<contact::ContactState>& contacts,
                                            int* augmentations) {
  const profile::Part part("mechanics");
  const double start = processes::wall_time();
  // Augmentations of earlier passes count too, so that a step has one limit for all of them.
  const int earlier = augmentations != nullptr ? *augmentations : 0;
  const std::vector<double> coherency =
      phases.contacts.empty() ? std::vector<double>{} : coherency_of(phases, old.mechanics, pass);
  begin_contacts(phases, old.contacts, old.mechanics, pass, coherency, contacts, earlier > 0);
  // A firmer hold of contact helps the first pass of a step that failed.
  if (pass.contact_hold != 1)
    for (contact::ContactPair* pair : phases.contacts)
      pair->parts().forces.term().stabilisation().hold(pass.contact_hold);
  if (phases.structural != nullptr) phases.structural->release();
  mechanics::MechanicalReport report;
  // Each augmentation is a whole equilibrium with the multipliers of the one before.
  mechanics::MechanicalPass augmented = pass;
  mechanics::MechanicalState next;
  // Most of a state is its history: the storage of the one that is overwritten serves again.
  if (pass.iterate != &trial.mechanics && &old.mechanics != &trial.mechanics) {
    next.history = std::move(trial.mechanics.history);
    next.elements = std::move(trial.mechanics.elements);
  }
  for (int augmentation = 1;; ++augmentation) {
    if (augmentations != nullptr) *augmentations = earlier + augmentation;
    report.deformation.clear();  // its storage serves again
    try {
      report = phases.mechanics->solve(old.mechanics, next, augmented);
      add(report.newton, report.newton.effort, 0, effort.mechanics);
    } catch (StepRejected& rejected) {
      if (augmentation > 1 && restore_multipliers(phases))
        continue;  // `augmented.start` is the equilibrium before
      add_contacts(phases, rejected);
      throw;
    }
    {
      // Contact is placed at the solution, where penetrations are measured.
      const profile::Part of_contact("contact");
      for (contact::ContactPair* pair : phases.contacts) pair->update(next.displacement);
    }
    // Penetrations of an iterate that is not in equilibrium say nothing of the multipliers; those of one that
    // is are brought down in equilibrium too.
    if (!report.newton.converged || penetrations_small(phases, augmentation, earlier)) break;
    augmented.start = next.displacement;
    augmented.newton_steps = 0;
  }
  // Only now is the trial state replaced: a phase that fails leaves it as it was.
  trial.mechanics = std::move(next);
  trial.contacts = contact_states(phases);

  book_work(report, effort);
  effort.mechanics.seconds += processes::wall_time() - start;
  return report;
}

void book_work(const mechanics::MechanicalReport& report, StepEffort& effort) {
  // Support work counts as work of the outside, since a prescribed motion does it.
  const mechanics::MechanicalWork& work = report.work;
  EnergyAudit& energy = effort.energy;
  energy.kinetic = work.kinetic;
  energy.numerical = work.numerical;
  energy.work = work.external_work + work.support_work;
  energy.unbalanced = work.residual_work;
  // What dissipates and is not plastic flow is viscous.
  energy.viscous_dissipation = work.dissipation - work.plastic_dissipation;
  energy.plastic_dissipation = work.plastic_dissipation;
  energy.plastic_work = work.plastic_work;
  energy.inelastic_entropy = work.inelastic_entropy;
  effort.least_dissipation = work.least_dissipation;
  effort.largest_dissipation = work.largest_dissipation;
  effort.fields.reactions = report.reactions;
}

void book_excess_work(const Phases& phases, const mechanics::StepDeformation& deformation,
                      EnergyAudit& energy) {
  if (phases.structural != nullptr && phases.mechanics->bodies().work_share() == 1)
    energy.excess_work = mechanics::excess_work(deformation);
}

// Γ stays as the mechanical phase left it.
bool thermal_pass(const Phases& phases, const State& old, State& trial,
                  const mechanics::StepDeformation& deformation, const heat::ThermalPass& pass,
                  StepEffort& effort) {
  const profile::Part part("heat");
  const double start = processes::wall_time();
  // Contacts rest where there is no mechanics; else they are as the mechanical phase left them.
  if (phases.mechanics == nullptr) rest_contacts(phases, old, pass.time, pass.dt);
  for (contact::ContactPair* pair : phases.contacts) pair->parts().heat.begin(pass.dt, pass.adiabatic);
  if (phases.structural != nullptr) phases.structural->set_deformation(deformation);
  if (pass.iterate == nullptr && &trial != &old) trial.heat = {};  // its memory serves the step
  heat::ThermalReport report = phases.heat->solve(old.heat, trial.heat, pass);

  // The energies of the step: heat stored, supplied and exchanged, and the structural energy at the new
  // temperatures.
  effort.energy.stored_heat = report.balance.stored;
  effort.energy.heat_in = 0;
  effort.energy.entropy_in = report.balance.entropy_in;
  for (const heat::ConditionHeat& condition : report.balance.conditions)
    effort.energy.heat_in += condition.heat;
  effort.energy.heat_exchanged = report.balance.exchanged;
  effort.energy.to_channels = 0;
  for (const heat::ChannelReading& channel : report.channels) effort.energy.to_channels += channel.heat;
  if (!pass.adiabatic) {
    effort.channels = std::move(report.channels);
    effort.conditions = std::move(report.balance.conditions);
    effort.conditions_time = pass.dt;
  }
  if (phases.structural != nullptr) {
    effort.energy.structural = mechanics::structural_change(deformation, trial.heat.temperature).energy;
  } else {
    keep_heat_alone(effort.energy);
  }
  effort.energy.interface = {};
  commit_contact_heat(phases, trial.heat.temperature, report.balance.contributions, effort.energy);
  // Contacts that have a temperature of their own are part of the new state.
  const auto remembers = [](const contact::ContactPair* pair) {
    return pair->parts().heat.has_temperature();
  };
  if (phases.mechanics != nullptr || std::ranges::any_of(phases.contacts, remembers))
    trial.contacts = contact_states(phases);
  if (!pass.adiabatic) effort.fields.flows = std::move(report.flows);
  add(report.newton, report.hardest, processes::wall_time() - start, effort.heat);
  return report.newton.converged;
}

bool thermal_pass_with_flow(const Phases& phases, const State& old, State& trial,
                            mechanics::StepDeformation& deformation, heat::ThermalPass heat,
                            const mechanics::MechanicalState& started, const mechanics::MechanicalPass& pass,
                            StepEffort& effort) {
  // Heat and return mapping are solved in alternation, because the flow at the new temperatures changes the
  // heat. Without flow the first solution is kept.
  bool converged = thermal_pass(phases, old, trial, deformation, heat, effort);
  double change = 0;
  for (int iteration = 1; iteration <= k_most_flow_iterations; ++iteration) {
    const std::vector<double> led = trial.heat.temperature;
    const mechanics::FlowChange flow =
        mechanics::restart_flow(*phases.mechanics, started, pass, led, trial.mechanics, deformation);
    if (iteration == 1 && !flow.flows) return converged;
    heat.iterate = &trial.heat;
    converged = thermal_pass(phases, old, trial, deformation, heat, effort);
    change = largest_difference(trial.heat.temperature, led);
    if (change > k_flow_settled * largest_difference(trial.heat.temperature, old.heat.temperature)) continue;
    // Once the temperatures hardly change, the flow that was found replaces that of the mechanical phase in
    // the energies.
    effort.energy.viscous_dissipation += flow.work.dissipation - flow.work.plastic_dissipation;
    effort.energy.plastic_dissipation += flow.work.plastic_dissipation;
    effort.energy.plastic_work += flow.work.plastic_work;
    effort.energy.inelastic_entropy += flow.work.inelastic_entropy;
    effort.least_dissipation = std::min(effort.least_dissipation, flow.work.least_dissipation);
    effort.largest_dissipation = std::max(effort.largest_dissipation, flow.work.largest_dissipation);
    return converged;
  }
  throw StepRejected(
      fmt::format("coupling: return mapping and heat of the thermal phase do not converge: the "
                  "temperatures still change by {:.3g} K after {} iterations",
                  change, k_most_flow_iterations),
      "flow whose heat depends strongly on the temperature", Failure::coupling);
}

}  // namespace solidus::coupling
