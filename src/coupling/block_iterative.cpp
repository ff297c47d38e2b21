/// Both phases are solved in alternation until the largest change of temperature and displacement is within
/// the tolerance; relaxation and damping speed that up or end it.
#include "coupling/block_iterative.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <utility>

#include "coupling/contact_states.hpp"
#include "coupling/largest_difference.hpp"
#include "coupling/passes.hpp"
#include "coupling/phase_iterate.hpp"
#include "coupling/stability_audit.hpp"
#include "heat/iteration/worst_node.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "system/errors.hpp"

namespace solidus::coupling {

namespace {

/// Changes below this part of the values themselves are rounding.
constexpr double k_rounding = 1e-13;
/// Iterations within which the change of temperature is to fall to a half; else the temperatures that the
/// mechanical pass sees go half as far. Where heat follows a contact that closes by it (a gap that opens as
/// its metal cools), the whole step goes round between two states, one with contact and one without.
constexpr std::size_t k_patience = 8;
/// Iterations without damping, with the stabilisation of contact as it is given and with limits of conduction
/// that each thermal pass finds for itself.
constexpr std::size_t k_whole_steps = 24;
/// A change of temperature so many times the first one says that the iteration diverges.
constexpr double k_diverged = 100;

double largest(std::span<const double> a) {
  double size = 0;
  for (const double v : a) size = std::max(size, std::abs(v));
  return parallel::global_max(size);
}

/// Θ_c of all points of all pairs [K]; zero where it is not known.
std::vector<double> interface_temperatures(const std::vector<contact::ContactState>& contacts) {
  std::vector<double> result;
  for (const contact::ContactState& contact : contacts)
    for (const contact::ContactPointState& point : contact.points) result.push_back(point.temperature);
  return result;
}

}  // namespace

/// A step on its way.
struct BlockIterative::Iterate {
  Attempt attempt;
  int number = 0;                 ///< of the iteration
  State now;                      ///< results of the last passes
  PhaseIterate phases;            ///< fractions of phase changes that the mechanical pass holds
  std::vector<double> interface;  ///< Θ_c that friction holds in it; empty in the first iteration [K]
  /// Θ⁽ⁱ⁾ that the mechanical pass sees, and Θ⁽ⁱ⁻¹⁾ [K], [local node].
  std::vector<double> temperature, before;
  mechanics::StepDeformation deformation;  ///< of the last mechanical pass
  bool solved = false;                     ///< both passes reached the tolerances of their phases
  bool at_rest = false;   ///< the last mechanical pass set out in balance, within tolerance or rounding
  double damping = 1;     ///< of relaxation
  int augmentations = 0;  ///< of the Lagrangian, in all mechanical passes
  StepEffort& effort;
};

BlockIterative::BlockIterative(Phases phases, IterationOptions options)
    : phases_(std::move(phases)),
      options_(options),
      relaxation_{Relaxation(options.relaxation), Relaxation(options.relaxation)} {
  if (phases_.heat == nullptr || phases_.mechanics == nullptr)
    throw std::invalid_argument("the block-iterative scheme needs both phases");
  using mechanics::Mapping;
  const Mapping mapping = phases_.mechanics->bodies().options.mapping;
  if (mapping == Mapping::simultaneous)
    throw std::invalid_argument("the mechanical phase was built for another scheme");
  if (mapping == Mapping::isentropic && phases_.structural == nullptr)
    throw std::invalid_argument("isentropic passes need structural heat");
  if (mapping == Mapping::isentropic && options_.relaxation.kind == RelaxationOptions::Kind::aitken)
    throw std::invalid_argument("Aitken's relaxation is for isothermal passes");
  using mechanics::StructuralForm;
  if (phases_.structural != nullptr && phases_.structural->form() != StructuralForm::energy &&
      phases_.structural->form() != StructuralForm::entropy)
    throw std::invalid_argument("the block-iterative scheme has the energy and the entropy form only");
}

void BlockIterative::synchronise(const State& state) {
  restore_contacts(phases_, state);
}

void BlockIterative::forget() {
  phases_.mechanics->system().solver().forget();
  heat::forget(*phases_.heat);
  for (contact::ContactPair* pair : phases_.contacts) pair->parts().geometry.graph().forget();
}

StepEffort BlockIterative::advance(const State& old, State& trial, double time, double dt) {
  // Contact's energies are taken before the step, so that what the step changes can be booked after
  // it.
  const ContactWork contact(phases_);
  StepEffort effort;
  // One iteration with one Newton step in each phase; if that fails the full iteration follows.
  if (options_.loop == IterationOptions::Loop::single) {
    try {
      solve(old, trial, {.time = time, .dt = dt, .newton_steps = 1}, contact, effort);
      return effort;
    } catch (const StepRejected&) {
      // The failed attempt has moved the contact pairs: they are set back to the start of the step.
      synchronise(old);
    }
  }
  solve(old, trial, {.time = time, .dt = dt, .newton_steps = 0}, contact, effort);
  return effort;
}

void BlockIterative::solve(const State& old, State& trial, const Attempt& attempt, ContactWork contact,
                           StepEffort& effort) {
  // The iteration starts from the committed state. Once the phases agree, their work is booked with the share
  // of the integrator.
  Iterate it{.attempt = attempt,
             .now = old,
             .phases = {phases_, old.heat},
             .interface = {},
             .temperature = old.heat.temperature,
             .before = {},
             .deformation = {},
             .effort = effort};
  iterate_until_agreement(old, it);
  effort.coupling_iterations = it.number;
  if (phases_.structural != nullptr) {
    contact.add(phases_.mechanics->bodies().work_share());
    contact.book(effort.energy);
  }
  book_excess_work(phases_, it.deformation, effort.energy);
  book_interface(effort.energy, phases_.structural != nullptr);
  // The results become the trial state; nothing of the committed one has changed.
  trial.heat = std::move(it.now.heat);
  trial.mechanics = std::move(it.now.mechanics);
  trial.contacts = std::move(it.now.contacts);
  effort.stability = stability_audit(phases_, old, trial, it.deformation, effort, Booking::mechanical);
  summarise(phases_, trial, effort);
}

void BlockIterative::iterate_until_agreement(const State& old, Iterate& it) {
  for (Relaxation& relaxation : relaxation_) relaxation.begin();
  // Each round solves both phases once and measures how far they have changed each other.
  changes_.clear();
  while (true) {
    ++it.number;
    iterate(old, it);
    if (agrees(old, it)) {
      if (it.attempt.newton_steps == 0) break;
      // Single steps of Newton's method do not look at the limits of conduction: whole passes follow.
      it.attempt.newton_steps = 0;
    }
    // A further round: give up where it cannot converge, halve the step where changes stopped
    // falling, and mix old and new.
    require_progress(it);
    damp(it);
    relax(it);
  }
  if (options_.sweep == IterationOptions::Sweep::jacobi) thermal(old, it, 0);
}

bool BlockIterative::mechanical(const State& old, Iterate& it, int newton_steps) const {
  // The mechanical pass holds the fractions of the iterate. Late iterations hold open points more firmly,
  // because the whole steps before did not come to rest.
  mechanics::MechanicalPass pass{
      .time = it.attempt.time, .dt = it.attempt.dt, .temperature = old.heat.temperature};
  it.phases.hold(pass);
  pass.newton_steps = newton_steps;
  if (it.number > static_cast<int>(k_whole_steps)) pass.contact_hold = k_firm_hold;
  // From the second iteration on it starts from the deformation before, at the temperatures that heat has
  // found.
  if (it.number > 1) {
    pass.iterate_temperature = it.temperature;
    pass.iterate = &it.now.mechanics;
  }
  const std::vector<contact::ContactState> before = it.number > 1 ? it.now.contacts : old.contacts;
  const int earlier = it.augmentations;
  it.deformation.clear();  // its storage serves again
  mechanics::MechanicalReport report =
      mechanical_pass(phases_, old, it.now, pass, it.effort, before, &it.augmentations);
  it.deformation = std::move(report.deformation);
  it.at_rest = it.augmentations == earlier + 1 && report.newton.began_balanced;
  return report.newton.converged;
}

bool BlockIterative::thermal(const State& old, Iterate& it, int newton_steps) const {
  const heat::ThermalPass pass{.time = it.attempt.time,
                               .dt = it.attempt.dt,
                               .iterate = &it.now.heat,
                               .newton_steps = newton_steps,
                               .keeps_limits = it.number > static_cast<int>(k_whole_steps)};
  return thermal_pass(phases_, old, it.now, it.deformation, pass, it.effort);
}

// A pass of each phase (4.2, 4.3), and how much they changed.
void BlockIterative::iterate(const State& old, Iterate& it) {
  // Displacements before the round, to measure how far it moves.
  const std::vector<double> displacement = it.now.mechanics.displacement;
  try {
    // Which phase comes first alternates where a gap conducts so much that one order alone would
    // swing.
    if (alternates(it)) {
      it.solved = thermal(old, it, it.attempt.newton_steps);
      it.solved = mechanical(old, it, it.attempt.newton_steps) && it.solved;
    } else {
      it.solved = mechanical(old, it, it.attempt.newton_steps);
      it.solved = thermal(old, it, it.attempt.newton_steps) && it.solved;
    }
  } catch (const StepRejected& rejected) {
    // A phase that fails after growing changes is a symptom of the iteration, not of the phase.
    const bool grew = changes_.size() > 1 && changes_.back().temperature > changes_.front().temperature;
    if (!grew) throw;
    diverged(it, rejected.reason());
  }
  // The change of the round is that between what was guessed and what both phases have answered.
  double change = largest_difference(it.now.heat.temperature, answered(it));
  const std::vector<double> interface = interface_temperatures(it.now.contacts);
  if (it.interface.size() == interface.size())
    change = std::max(change, largest_difference(interface, it.interface));
  changes_.push_back({change, largest_difference(it.now.mechanics.displacement, displacement)});
}

/// Whether the thermal pass works at the configuration of the iteration before.
bool BlockIterative::alternates(const Iterate& it) const {
  return options_.sweep == IterationOptions::Sweep::jacobi && it.number > 1;
}

/// The temperature that the displacements answer at which the thermal pass works.
const std::vector<double>& BlockIterative::answered(const Iterate& it) const {
  return alternates(it) ? it.before : it.temperature;
}

bool BlockIterative::agrees(const State& old, const Iterate& it) const {
  const auto small = [this](double change, std::span<const double> now, std::span<const double> before) {
    if (!std::isfinite(change)) return false;
    return change <= options_.tolerance * largest_difference(now, before) ||
           change <= k_rounding * largest(now);
  };
  const double of_fractions = it.phases.any() ? it.phases.difference(it.now.heat) : 0.0;
  if (!it.solved || of_fractions > options_.tolerance ||
      !small(changes_.back().temperature, it.now.heat.temperature, old.heat.temperature))
    return false;
  // Displacements that equilibrium hardly determines (of melt, or of a body that contact alone holds) wander
  // by what the tolerance of forces leaves, however little the temperatures change.
  const bool wanders = changes_.size() > k_whole_steps && it.at_rest;
  return wanders ||
         small(changes_.back().displacement, it.now.mechanics.displacement, old.mechanics.displacement);
}

void BlockIterative::damp(Iterate& it) const {
  const std::size_t n = changes_.size();
  if (n < k_whole_steps || n % k_patience != 0) return;
  const auto least = [this](std::size_t from, std::size_t to) {
    double found = changes_[from].temperature;
    for (std::size_t i = from; i < to; ++i) found = std::min(found, changes_[i].temperature);
    return found;
  };
  if (least(n - k_patience, n) > 0.5 * least(n - 2 * k_patience, n - k_patience)) it.damping *= 0.5;
}

void BlockIterative::require_progress(const Iterate& it) const {
  // What can no longer converge ends the iteration at once.
  const std::vector<double>& now = it.now.heat.temperature;
  const bool cold = std::any_of(now.begin(), now.end(), [](double t) { return !(t > 0); });
  if (parallel::any_process(cold)) diverged(it, "a temperature fell below 0 K");
  if (!std::isfinite(changes_.back().temperature) || !std::isfinite(changes_.back().displacement))
    diverged(it, "a temperature or displacement is not a number");
  if (changes_.back().temperature > k_diverged * changes_.front().temperature)
    diverged(it, "the phases drive each other away");
  // The numbers of the last round tell how far it was.
  if (it.number < options_.max_iterations) return;
  throw StepRejected(fmt::format("coupling: no convergence in {} iterations, the last of which changed "
                                 "temperatures by {:.3g} K and displacements by {:.3g} m",
                                 it.number, changes_.back().temperature, changes_.back().displacement),
                     largest_change(it), Failure::coupling);
}

void BlockIterative::diverged(const Iterate& it, const std::string& how) const {
  throw StepRejected(fmt::format("coupling: the iteration between the phases diverges ({}); the change of "
                                 "temperature grew from {:.3g} K to {:.3g} K in {} iterations",
                                 how, changes_.front().temperature, changes_.back().temperature, it.number),
                     largest_change(it), Failure::divergence);
}

/// The node whose temperature the last iteration has changed most.
std::string BlockIterative::largest_change(const Iterate& it) const {
  const std::vector<double>&now = it.now.heat.temperature, &before = answered(it);
  heat::WorstNode worst;
  for (Index i = 0; i < phases_.heat->mesh().n_owned_nodes; ++i) {
    const auto n = as_size(i);
    if (n < now.size() && n < before.size()) worst.look(n, std::abs(now[n] - before[n]));
  }
  return worst.text(phases_.heat->mesh(), now, {});
}

// The mechanical pass that follows sees a relaxed temperature; the thermal one knows its own.
void BlockIterative::relax(Iterate& it) {
  const std::vector<double>& from = answered(it);
  const auto n_owned = as_size(phases_.heat->mesh().n_owned_nodes);
  std::vector<double> change(from.size());
  for (std::size_t i = 0; i < change.size(); ++i) change[i] = it.now.heat.temperature[i] - from[i];
  const bool second = options_.sweep == IterationOptions::Sweep::jacobi && it.number % 2 == 1;
  const double factor = it.damping * relaxation_[second ? 1 : 0].factor(std::span(change).first(n_owned));
  for (std::size_t i = 0; i < change.size(); ++i) change[i] = from[i] + factor * change[i];
  it.before = std::exchange(it.temperature, std::move(change));
  it.interface = interface_temperatures(it.now.contacts);
  it.phases.advance(it.now.heat, it.damping);
}

}  // namespace solidus::coupling
