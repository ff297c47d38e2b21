/// One or two stages, each a Newton iteration of both fields inside a loop over what the iteration holds:
/// pores, multipliers, limits of conduction, fractions of phases.
#include "coupling/simultaneous.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "coupling/contact_states.hpp"
#include "coupling/contact_work.hpp"
#include "coupling/passes.hpp"
#include "coupling/phase_iterate.hpp"
#include "coupling/stability_audit.hpp"
#include "heat/loads/stage_loads.hpp"
#include "material/time_integration.hpp"
#include "mechanics/solver/nodal_pressure.hpp"
#include "system/errors.hpp"
#include "system/log.hpp"
#include "system/processes.hpp"
#include "system/profile.hpp"

namespace solidus::coupling {

namespace {

constexpr int k_revisions = 5;  ///< of the limits of conduction, each with a further solution of both fields
/// Solutions with fractions of phase changes that follow the temperatures: at most, and the difference
/// between two at which they have settled, as a part of what the step changes.
constexpr int k_most_fraction_iterations = 24;
/// After so many they go half of the way, after as many again a quarter, and so on: a step that freezes
/// much may alternate between two sets of fractions.
constexpr int k_whole_fraction_iterations = 8;
constexpr double k_settled = 1e-9;
/// The difference that may be left where the residuals with the new fractions are within the tolerances.
constexpr double k_balanced = 1e-3;
/// Plastic work of the second of two stages over that of the first, below which the plastic strain that the
/// second one starts from has gone too far: one where flow is steady, 0.22 where a load has jumped.
constexpr double k_flow_falls = 0.5;

const Phases& checked(const Phases& phases, const SimultaneousOptions& options) {
  if (phases.heat == nullptr || phases.mechanics == nullptr)
    throw std::invalid_argument("the simultaneous scheme needs both phases");
  if (phases.mechanics->bodies().options.mapping != mechanics::Mapping::simultaneous)
    throw std::invalid_argument("the mechanical phase was built for a split");
  using Form = mechanics::StructuralForm;
  if (phases.structural != nullptr && phases.structural->form() != Form::energy &&
      phases.structural->form() != Form::entropy)
    throw std::invalid_argument("the simultaneous scheme has the energy and the entropy form only");
  const bool one_stage =
      phases.mechanics->bodies().inertia != nullptr ||
      phases.mechanics->bodies().options.integration != mechanics::TimeIntegration::backward_euler;
  if (one_stage && options.integration == SimultaneousOptions::Integration::sdirk2)
    throw std::invalid_argument("two stages are for quasi-statics with backward Euler");
  return phases;
}

/// y_n + carried (Y_1 − y_n).
mechanics::MechanicalState second_start(const mechanics::MechanicalState& old,
                                        const mechanics::MechanicalState& stage, double carried) {
  mechanics::MechanicalState start = old;
  for (std::size_t i = 0; i < start.displacement.size(); ++i)
    start.displacement[i] += carried * (stage.displacement[i] - old.displacement[i]);
  for (std::size_t b = 0; b < start.history.size(); ++b) {
    PackVector<Lane>& values = start.history[b].values;
    const PackVector<Lane>& end = stage.history[b].values;
    for (std::size_t i = 0; i < values.size(); ++i) values[i] += Lane(carried) * (end[i] - values[i]);
  }
  start.solid_fraction = stage.solid_fraction;  // a fraction is not extrapolated
  return start;
}

}  // namespace

SimultaneousScheme::SimultaneousScheme(Phases phases, SimultaneousOptions options)
    : phases_(checked(phases, options)), options_(options), newton_(std::in_place, phases_, options.solver) {
  if (phases_.structural != nullptr) phases_.structural->leave_tangent();
}

void SimultaneousScheme::synchronise(const State& state) {
  restore_contacts(phases_, state);
}

void SimultaneousScheme::forget() {
  newton_->forget();
  phases_.mechanics->system().solver().forget();
  for (contact::ContactPair* pair : phases_.contacts) pair->parts().geometry.graph().forget();
}

mechanics::StepDeformation SimultaneousScheme::drop_carried() {
  mechanics::StepDeformation deformation;
  for (mechanics::CoupledKernel* kernel : newton_->kernels()) deformation.push_back(kernel->drop_carried());
  return deformation;
}

StepEffort SimultaneousScheme::advance(const State& old, State& trial, double time, double dt) {
  drop_carried();  // of a step that failed
  mechanics::StepDeformation deformation;
  std::optional<ContactWork> contact(std::in_place, phases_);
  StepEffort effort;
  // Backward Euler is one Newton iteration at the end of the step. Two stages fall back to first order, from
  // the same start, where they would overshoot or find no solution.
  if (options_.integration == SimultaneousOptions::Integration::backward_euler) {
    effort = backward_euler(old, trial, time, dt, deformation);
    book_excess_work(phases_, deformation, effort.energy);
  } else if (const std::optional<StepEffort> found =
                 two_stages(old, trial, time, dt, true, *contact, deformation)) {
    effort = *found;
  } else {
    logging::debug(
        "both fields: the step to t = {:g} s would overshoot, in heat or in flow, or finds no solution; "
        "it is of first order",
        time);
    // The failed try has moved contacts and kept deformations: both are put back before the second attempt.
    drop_carried();
    deformation.clear();  // its storage serves again
    restore_contacts(phases_, old);
    contact.emplace(phases_);
    effort = *two_stages(old, trial, time, dt, false, *contact, deformation);
  }
  // With structural heat the work of contact is booked as it was done between the stages; without it
  // deformation and heat exchange nothing, and the balance is that of heat alone.
  if (phases_.structural != nullptr) {
    contact->add(phases_.mechanics->bodies().work_share());
    contact->book(effort.energy);
    effort.energy.structural = mechanics::structural_change(deformation, trial.heat.temperature).energy;
  } else {
    keep_heat_alone(effort.energy);
  }
  book_interface(effort.energy, phases_.structural != nullptr);
  // At last the step is audited for stability, with the same deformation that the balance has used.
  effort.stability = stability_audit(phases_, old, trial, deformation, effort, Booking::mechanical);
  summarise(phases_, trial, effort);
  return effort;
}

StepEffort SimultaneousScheme::backward_euler(const State& old, State& trial, double time, double dt,
                                              mechanics::StepDeformation& deformation) {
  newton_->thermal().begin(old.heat, dt, LoadWindow::backward_euler(time - dt, time));
  const std::vector<double> share = plateau_share(phases_, old.heat);
  PhaseIterate fractions(phases_, old.heat);
  return stage(old.mechanics, old.contacts, coherency_of(phases_, old.heat),
               {.time = time, .dt = dt, .temperature = old.heat.temperature, .plateau_share = share}, trial,
               deformation, &fractions);
}

std::optional<StepEffort> SimultaneousScheme::two_stages(const State& old, State& trial, double time,
                                                         double dt, bool extrapolated, ContactWork& contact,
                                                         mechanics::StepDeformation& deformation) {
  // The first stage is backward Euler over its share of the step.
  const double first_dt = material::k_sdirk_share * dt, middle = time - dt + first_dt;
  const std::vector<double> share = plateau_share(phases_, old.heat);
  const mechanics::MechanicalPass to_middle{
      .time = middle, .dt = first_dt, .temperature = old.heat.temperature, .plateau_share = share};
  State first;
  heat::ThermalIteration& thermal = newton_->thermal();
  thermal.begin(old.heat, first_dt, heat::first_loads(time, dt));
  const std::vector<double> coherency = coherency_of(phases_, old.heat);
  PhaseIterate of_middle(phases_, old.heat);
  const StepEffort of_first =
      stage(old.mechanics, old.contacts, coherency, to_middle, first, deformation, &of_middle);

  // The second stage starts from the extrapolated first one, if temperatures stay in their range; otherwise
  // it is backward Euler over the rest of the step.
  extrapolated =
      extrapolated && thermal.watch().may_extrapolate(old.heat, first.heat, heat::last_loads(time, dt, true));
  // By extrapolation the second stage starts at Y_n + carried (Y_1 − Y_n).
  const double carried = extrapolated ? material::k_sdirk_carried : 1.0;
  contact.add(1, carried);
  for (std::size_t b = 0; b < deformation.size(); ++b)
    newton_->kernels()[b]->carry(carried, deformation[b].get(), first.heat.temperature);
  deformation.clear();  // its storage serves again
  const mechanics::MechanicalState start = second_start(old.mechanics, first.mechanics, carried);
  mechanics::MechanicalPass to_end = to_middle;
  to_end.time = time;
  to_end.dt = extrapolated ? first_dt : dt - first_dt;
  to_end.from_extrapolation = extrapolated;
  to_end.iterate = &first.mechanics;
  PhaseIterate of_end(phases_, first.heat);
  of_end.hold(to_end);
  thermal.begin_stage(old.heat, first.heat, carried, to_end.dt, heat::last_loads(time, dt, extrapolated));
  StepEffort effort;
  try {
    effort = stage(start, second_start(phases_, old.contacts, first.contacts, carried), coherency, to_end,
                   trial, deformation, &of_end);
  } catch (const StepRejected&) {
    if (extrapolated) return std::nullopt;  // the extrapolated state may have no equilibrium nearby
    throw;
  }
  if (extrapolated && thermal.watch().overshoots(trial.heat)) return std::nullopt;
  // The extrapolation continues the plastic strain of the first stage: the second stage must not flow back.
  if (extrapolated && effort.energy.plastic_work < k_flow_falls * of_first.energy.plastic_work)
    return std::nullopt;
  // Energies and effort of both stages add up.
  deformation = drop_carried();
  // Structural heat is booked with the deformation of the whole step.
  if (phases_.structural != nullptr) phases_.structural->set_deformation(deformation);
  effort.energy.add_first_stage(of_first.energy, carried);
  effort.mechanics.iterations += of_first.mechanics.iterations;
  effort.mechanics.linear_iterations += of_first.mechanics.linear_iterations;
  effort.mechanics.seconds += of_first.mechanics.seconds;
  effort.heat.iterations = effort.mechanics.iterations;
  effort.least_dissipation = std::min(effort.least_dissipation, of_first.least_dissipation);
  effort.largest_dissipation = std::max(effort.largest_dissipation, of_first.largest_dissipation);
  return effort;
}

void SimultaneousScheme::warn_of_held_fractions(double time) {
  if (std::exchange(warned_, true)) return;
  logging::warn(
      "t = {:g} s: the fractions of phase changes alternate between two sets in this step; those of the last "
      "of {} solutions are held, as a split holds those of its start. Shorter steps settle them",
      time, k_most_fraction_iterations);
}

bool SimultaneousScheme::settled(const PhaseIterate& fractions, int iteration) {
  const double left = fractions.difference(newton_->thermal().state());
  if (left <= k_settled) return true;
  const CoupledResidual& start = report_.residuals.front();
  return iteration > 0 && left <= k_balanced &&
         start.force <= phases_.mechanics->bodies().options.newton.tolerance &&
         start.heat <= newton_->thermal().equations().imbalance().tolerance;
}

StepEffort SimultaneousScheme::stage(const mechanics::MechanicalState& old,
                                     const std::vector<contact::ContactState>& contacts,
                                     std::span<const double> coherency, mechanics::MechanicalPass pass,
                                     State& trial, mechanics::StepDeformation& deformation,
                                     PhaseIterate* fractions) {
  const profile::Part part("both fields");
  const double start = processes::wall_time();
  pass.iterate_temperature = newton_->thermal().state().temperature;
  begin_contacts(phases_, contacts, old, pass, coherency);
  mechanics::NodalPressure* const pressure = phases_.mechanics->bodies().pressure.get();
  if (pressure != nullptr) mechanics::release_pores(*pressure);
  phases_.mechanics->equations().begin(old, pass);
  std::vector<double> x = phases_.mechanics->bodies().start(old, pass);
  // The loop goes on as long as something that Newton's iteration holds must change: pores,
  // multipliers, limits of conduction, fractions of phases.
  int iterations = 0, linear_iterations = 0, revisions = 0, fraction_iterations = 0;
  // The equilibrium that an augmentation of the Lagrangian sets out from.
  std::vector<double> balanced;
  heat::ThermalState balanced_heat;
  for (int solution = 1;; ++solution) {
    try {
      report_ = newton_->solve(old, pass, x);
    } catch (StepRejected& rejected) {
      // An augmentation without equilibrium is taken back, and the one before it is the solution.
      if (!balanced.empty() && restore_multipliers(phases_)) {
        x = std::exchange(balanced, {});
        newton_->thermal().restart(balanced_heat);
        continue;
      }
      add_contacts(phases_, rejected);
      throw;
    }
    iterations += report_.iterations;
    linear_iterations += report_.linear_iterations;
    const std::span<const double> pressures =
        std::span(x).subspan(phases_.mechanics->bodies().n_displacements());
    // Pressures below that of a pore change which nodes are pores; the equilibrium is found again.
    if (pressure != nullptr && mechanics::fill_pores(*pressure, pressures, solution)) continue;
    if (!penetrations_small(phases_, solution)) {
      balanced = x;
      balanced_heat = newton_->thermal().state();
      continue;
    }
    balanced.clear();
    // Limits of conduction follow the solution a few times, then stay.
    if (revisions < k_revisions && newton_->thermal().watch().revise_limits(newton_->thermal().state())) {
      ++revisions;
      continue;
    }
    if (fractions == nullptr || !fractions->any()) break;
    if (settled(*fractions, fraction_iterations)) break;
    if (++fraction_iterations > k_most_fraction_iterations) {
      warn_of_held_fractions(pass.time);
      break;
    }
    fractions->advance(newton_->thermal().state(),
                       std::ldexp(1.0, -fraction_iterations / k_whole_fraction_iterations));
    fractions->hold(pass);
  }
  newton_->release_deformation();
  mechanics::MechanicalReport solved =
      phases_.mechanics->equations().conclude(old, pass, std::move(x), trial.mechanics);
  if (phases_.structural != nullptr) phases_.structural->set_deformation(solved.deformation);
  deformation = std::move(solved.deformation);
  const heat::HeatBalance balance = newton_->thermal().conclude(trial.heat);

  StepEffort effort;
  EnergyAudit& energy = effort.energy;
  book_work(solved, effort);
  energy.stored_heat = balance.stored;
  for (const heat::ConditionHeat& condition : balance.conditions) energy.heat_in += condition.heat;
  energy.entropy_in = balance.entropy_in;
  commit_contact_heat(phases_, trial.heat.temperature, balance.contributions, energy);
  trial.contacts = contact_states(phases_);
  energy.heat_exchanged = balance.exchanged;
  effort.conditions = balance.conditions;
  effort.conditions_time = pass.dt;
  const CoupledResidual& end = report_.residuals.back();
  // One iteration for both fields, booked with the mechanical phase.
  effort.mechanics = {iterations, linear_iterations, end.force, processes::wall_time() - start};
  effort.heat = {iterations, 0, end.heat, 0.0};
  return effort;
}

}  // namespace solidus::coupling
