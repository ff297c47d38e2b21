#include "coupling/sequential_split.hpp"

#include <mpi.h>

#include <stdexcept>

#include "coupling/stability_audit.hpp"

namespace solidus::coupling {

namespace {

PhaseEffort effort_of(const algebra::NewtonReport& newton, double seconds) {
  return {newton.iterations, newton.linear_iterations,
          newton.residuals.empty() ? 0.0 : newton.residuals.back(), seconds};
}

}  // namespace

SequentialSplit::SequentialSplit(Phases phases, mechanics::Mapping mapping) : phases_(std::move(phases)) {
  if (phases_.mechanics != nullptr && phases_.mechanics->mapping() != mapping)
    throw std::invalid_argument("the mechanical phase was built for another split");
}

void SequentialSplit::synchronise(const State& state) {
  if (phases_.mechanics == nullptr) return;  // without deformation the gaps stay as they were made
  for (contact::ContactPair* pair : phases_.contacts) pair->update(state.mechanics.displacement);
}

void SequentialSplit::forget() {
  if (phases_.mechanics != nullptr) phases_.mechanics->forget();
  if (phases_.heat != nullptr) phases_.heat->forget();
}

StepEffort SequentialSplit::advance(const State& old, State& trial, double time, double dt) {
  StepEffort effort;
  if (phases_.mechanics != nullptr) mechanical_phase(old, trial, time, dt, effort);
  if (phases_.heat != nullptr) thermal_phase(old, trial, time, dt, effort);
  effort.stability = stability_audit(phases_, old, trial, effort);
  summarise(phases_, trial, effort);
  return effort;
}

// Equilibrium from the temperature of t_n (4.40, 4.46), then gaps and conductances of the configuration
// found.
void SequentialSplit::mechanical_phase(const State& old, State& trial, double time, double dt,
                                       StepEffort& effort) {
  const double start = MPI_Wtime();
  const double spring_energy = contact_energy(phases_);
  const std::vector<double>& temperature =
      phases_.heat != nullptr ? old.heat.temperature : phases_.temperature;
  const mechanics::PhaseReport report =
      phases_.mechanics->solve(old.mechanics, trial.mechanics, temperature, time, dt);
  for (contact::ContactPair* pair : phases_.contacts) pair->update(trial.mechanics.displacement);

  effort.energy.contact = contact_energy(phases_) - spring_energy;
  effort.energy.kinetic = report.work.kinetic;
  effort.energy.numerical = report.work.numerical;
  effort.energy.work = report.work.external_work + report.work.support_work;
  effort.energy.unbalanced = report.work.residual_work;
  effort.energy.viscous_dissipation = report.work.dissipation - report.work.plastic_dissipation;
  effort.energy.plastic_dissipation = report.work.plastic_dissipation;
  effort.energy.plastic_work = report.work.plastic_work;
  effort.least_dissipation = report.work.least_dissipation;
  effort.largest_dissipation = report.work.largest_dissipation;
  effort.mechanics = effort_of(report.newton, MPI_Wtime() - start);
}

// The balance of energy at the new configuration (4.43, 4.53): Γ stays as the mechanical phase left it.
void SequentialSplit::thermal_phase(const State& old, State& trial, double time, double dt,
                                    StepEffort& effort) {
  const double start = MPI_Wtime();
  const heat::PhaseReport report = phases_.heat->solve(old.heat, trial.heat, time, dt);

  effort.energy.stored_heat = report.balance.stored;
  for (const heat::ConditionHeat& condition : report.balance.conditions)
    effort.energy.heat_in += condition.heat;
  effort.energy.heat_exchanged = report.balance.exchanged;
  if (phases_.structural != nullptr) {
    effort.energy.structural = phases_.structural->change(trial.heat.temperature).energy;
  } else {
    // Deformation exchanges nothing with heat: the first law is that of the thermal phase alone.
    effort.energy.work = effort.energy.contact = effort.energy.kinetic = effort.energy.numerical = 0;
  }
  effort.heat = effort_of(report.newton, MPI_Wtime() - start);
}

}  // namespace solidus::coupling
