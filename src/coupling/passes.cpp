#include "coupling/passes.hpp"

#include <mpi.h>

#include <algorithm>

#include "coupling/contact_states.hpp"
#include "coupling/contact_work.hpp"
#include "system/errors.hpp"
#include "system/profile.hpp"

namespace solidus::coupling {

namespace {

/// @param hardest  iterations of the harder stage
void add(const linear::NewtonReport& newton, int hardest, double seconds, PhaseEffort& effort) {
  effort.iterations += newton.iterations;
  effort.hardest += hardest;
  effort.linear_iterations += newton.linear_iterations;
  effort.residual = newton.residuals.empty() ? 0.0 : newton.residuals.back();
  effort.seconds += seconds;
}

}  // namespace

bool mechanical_pass(const Phases& phases, const MechanicalStart& old, State& trial,
                     const mechanics::MechanicalPass& pass, StepEffort& effort,
                     const std::vector<contact::ContactState>& contacts) {
  const profile::Part part("mechanics");
  const double start = MPI_Wtime();
  const std::vector<double> coherency =
      phases.contacts.empty() ? std::vector<double>{} : coherency_of(phases, old.heat);
  begin_contacts(phases, old.contacts, old.mechanics, pass, coherency, contacts);
  mechanics::PhaseReport report;
  mechanics::MechanicalPass turn = pass;
  mechanics::MechanicalState next;
  // Most of a state is its history: the storage of the one that is overwritten serves again.
  if (pass.iterate != &trial.mechanics && &old.mechanics != &trial.mechanics)
    next.history = std::move(trial.mechanics.history);
  for (int n_turns = 1;; ++n_turns) {
    try {
      const mechanics::PhaseReport of_turn = phases.mechanics->solve(old.mechanics, next, turn);
      add(of_turn.newton, of_turn.newton.iterations, 0, effort.mechanics);
      report = of_turn;
    } catch (const StepRejected& rejected) {
      reject_with_contacts(phases, rejected);
    }
    {
      const profile::Part of_contact("contact");
      for (contact::ContactPair* pair : phases.contacts) pair->update(next.displacement);
    }
    // Penetrations of an iterate that is not in equilibrium say nothing of the multipliers; those of one that
    // is are brought down in equilibrium too.
    if (!report.newton.converged || penetrations_small(phases, n_turns)) break;
    turn.start = next.displacement;
    turn.newton_steps = 0;
  }
  trial.mechanics = std::move(next);
  trial.contacts = contact_states(phases);

  effort.energy.kinetic = report.work.kinetic;
  effort.energy.numerical = report.work.numerical;
  effort.energy.work = report.work.external_work + report.work.support_work;
  effort.energy.unbalanced = report.work.residual_work;
  effort.energy.viscous_dissipation = report.work.dissipation - report.work.plastic_dissipation;
  effort.energy.plastic_dissipation = report.work.plastic_dissipation;
  effort.energy.plastic_work = report.work.plastic_work;
  effort.energy.inelastic_entropy = report.work.inelastic_entropy;
  effort.least_dissipation = report.work.least_dissipation;
  effort.largest_dissipation = report.work.largest_dissipation;
  effort.mechanics.seconds += MPI_Wtime() - start;
  return report.newton.converged;
}

// Γ stays as the mechanical phase left it.
bool thermal_pass(const Phases& phases, const State& old, State& trial, const heat::ThermalPass& pass,
                  StepEffort& effort) {
  const profile::Part part("heat");
  const double start = MPI_Wtime();
  if (phases.mechanics == nullptr) rest_contacts(phases, old, pass.time, pass.dt);
  for (contact::ContactPair* pair : phases.contacts) pair->begin_heat(pass.dt, pass.adiabatic);
  const heat::PhaseReport report = phases.heat->solve(old.heat, trial.heat, pass);

  effort.energy.stored_heat = report.balance.stored;
  effort.energy.heat_in = 0;
  effort.energy.entropy_in = report.balance.entropy_in;
  for (const heat::ConditionHeat& condition : report.balance.conditions)
    effort.energy.heat_in += condition.heat;
  effort.energy.heat_exchanged = report.balance.exchanged;
  if (phases.structural != nullptr) {
    effort.energy.structural = phases.structural->change(trial.heat.temperature).energy;
  } else {
    keep_heat_alone(effort.energy);
  }
  effort.energy.interface = {};
  commit_contact_heat(phases, trial.heat.temperature, report.balance.contributions, effort.energy);
  const auto remembers = [](const contact::ContactPair* pair) { return pair->has_temperature(); };
  if (phases.mechanics != nullptr || std::ranges::any_of(phases.contacts, remembers))
    trial.contacts = contact_states(phases);
  add(report.newton, report.hardest, MPI_Wtime() - start, effort.heat);
  return report.newton.converged;
}

}  // namespace solidus::coupling
