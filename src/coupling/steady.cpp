/// Conduction and equilibrium in alternation until gaps and temperatures agree; without mechanics one
/// solution is enough.
#include "coupling/steady.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "coupling/contact_states.hpp"
#include "coupling/contact_work.hpp"
#include "coupling/largest_difference.hpp"
#include "coupling/passes.hpp"
#include "coupling/relaxation.hpp"
#include "heat/iteration/worst_node.hpp"
#include "numbers/index_casts.hpp"
#include "system/errors.hpp"
#include "system/processes.hpp"

namespace solidus::coupling {

namespace {

/// Changes below this are rounding [K].
constexpr double k_rounding = 1e-9;

/// The contacts where the bodies are at the start.
void place_contacts(const Phases& phases, const State& initial) {
  const std::vector<double>& temperature =
      phases.heat != nullptr ? initial.heat.temperature : phases.temperature;
  begin_contacts(phases, initial.contacts, initial.mechanics,
                 {.time = 0, .dt = k_long, .temperature = temperature}, coherency_of(phases, initial.heat));
  for (contact::ContactPair* pair : phases.contacts) pair->update(initial.mechanics.displacement);
}

void conduct(const Phases& phases, const State& initial, State& steady, StepEffort& effort) {
  // The heat of a steady state is solved from the one before, if there is one, at time zero.
  const double start = processes::wall_time();
  const heat::ThermalState& from = steady.heat.temperature.empty() ? initial.heat : steady.heat;
  heat::ThermalState next;
  const heat::ThermalReport report = phases.heat->solve_steady(from, next, 0);
  steady.heat = std::move(next);
  // What enters through conditions is the balance: nothing is stored.
  EnergyAudit& energy = effort.energy;
  energy.heat_in = 0;
  for (const heat::ConditionHeat& condition : report.balance.conditions) energy.heat_in += condition.heat;
  energy.to_channels = 0;
  for (const heat::ChannelReading& channel : report.channels) energy.to_channels += channel.heat;
  effort.channels = report.channels;
  energy.entropy_in = report.balance.entropy_in;
  energy.heat_exchanged = report.balance.exchanged;
  energy.interface = {};
  commit_contact_heat(phases, steady.heat.temperature, report.balance.contributions, energy);
  effort.heat.iterations += report.newton.iterations;
  effort.heat.linear_iterations += report.newton.linear_iterations;
  effort.heat.residual = report.newton.residuals.empty() ? 0.0 : report.newton.residuals.back();
  effort.heat.seconds += processes::wall_time() - start;
}

/// Equilibrium at `temperature`, from the bodies as they are at the start.
/// @param found  that an iteration before has found deformation: Newton's iteration sets out from it
void deform(const Phases& phases, const State& initial, std::span<const double> temperature, bool found,
            State& steady, StepEffort& effort) {
  const std::vector<double>& before = phases.heat != nullptr ? initial.heat.temperature : phases.temperature;
  const std::vector<double> share = plateau_share(phases, steady.heat);
  mechanics::MechanicalPass pass{.time = 0, .dt = k_long, .temperature = before};
  pass.phase_temperature = temperature;
  pass.at_rest = true;
  pass.plateau_share = share;
  pass.iterate_temperature = temperature;
  if (found) pass.iterate = &steady.mechanics;
  const MechanicalStart start(initial.mechanics, initial.contacts);
  const std::vector<contact::ContactState> contacts =
      found ? steady.contacts : std::vector<contact::ContactState>{};
  mechanical_pass(phases, start, steady, pass, effort, contacts);
  keep_heat_alone(effort.energy);
}

[[noreturn]] void reject(const Phases& phases, const SteadyOptions& options, double change,
                         std::span<const double> found, std::span<const double> seen) {
  // The node that changed most, for the message.
  heat::WorstNode worst;
  for (Index i = 0; i < phases.heat->mesh().n_owned_nodes; ++i) {
    const auto n = as_size(i);
    worst.look(n, std::abs(found[n] - seen[n]));
  }
  throw StepRejected(
      fmt::format(
          "coupling: heat and deformation do not agree on a steady state in {} iterations, the last of "
          "which changed temperatures by {:.3g} K: a gap that opens when it conducts and closes when "
          "it does not has none",
          options.max_iterations, change),
      worst.text(phases.heat->mesh(), found, {}), Failure::coupling);
}

}  // namespace

StepEffort solve_steady(const Phases& phases, const State& initial, State& steady,
                        const SteadyOptions& options) {
  if (phases.structural != nullptr)
    throw std::invalid_argument("in a steady state deformation exchanges no heat");
  if (phases.mechanics != nullptr && phases.mechanics->bodies().inertia != nullptr)
    throw std::invalid_argument("a steady state has no inertia");
  // Both fields are solved in alternation until the temperatures that deformation has seen are those that
  // heat finds.
  StepEffort effort;
  steady = initial;
  if (phases.mechanics != nullptr) place_contacts(phases, initial);
  // The first heat solve sees the gaps of the initial state. Without mechanics the steady state is found with
  // it.
  if (phases.heat != nullptr) conduct(phases, initial, steady, effort);
  if (phases.mechanics == nullptr) {
    summarise(phases, steady, effort);
    return effort;
  }
  // Deformation follows the temperatures found, or the given ones where heat is not solved for.
  std::vector<double> seen = phases.heat != nullptr ? steady.heat.temperature : phases.temperature;
  deform(phases, initial, seen, false, steady, effort);
  // Each further iteration conducts through the gaps of the last deformation. The change of temperature that
  // mechanics sees is relaxed by Aitken's factor, because a gap that opens cools what made it open.
  Relaxation relaxation({RelaxationOptions::Kind::aitken, 1.0});
  relaxation.begin();
  const auto n_owned = as_size(phases.mechanics->mesh().n_owned_nodes);
  while (phases.heat != nullptr && !phases.contacts.empty()) {
    conduct(phases, initial, steady, effort);
    const std::vector<double>& found = steady.heat.temperature;
    std::vector<double> change(found.size());
    for (std::size_t i = 0; i < found.size(); ++i) change[i] = found[i] - seen[i];
    // The iteration ends by the change of temperature over the whole change from the initial state.
    const double size = largest_difference(found, seen);
    if (size <= std::max(k_rounding, options.tolerance * largest_difference(found, initial.heat.temperature)))
      break;
    if (effort.coupling_iterations == options.max_iterations) reject(phases, options, size, found, seen);
    const double factor = relaxation.factor(std::span(change).first(n_owned));
    for (std::size_t i = 0; i < seen.size(); ++i) seen[i] += factor * change[i];
    deform(phases, initial, seen, true, steady, effort);
    ++effort.coupling_iterations;
  }
  summarise(phases, steady, effort);
  return effort;
}

}  // namespace solidus::coupling
