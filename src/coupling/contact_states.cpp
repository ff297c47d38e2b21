/// Pairs are set from states at the start of a pass and read back at its end; between them the loop of
/// augmentations decides whether penetrations are small enough.
#include "coupling/contact_states.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mechanics/equilibrium_rejected.hpp"
#include "parallel/parallel.hpp"
#include "system/errors.hpp"
#include "system/log.hpp"
#include "system/profile.hpp"

namespace solidus::coupling {

namespace {

// Multipliers follow the means around nodes first. After k_augmentations_by_means of them, where points at
// the edge of contact open and close from one to the next, penetrations may be k_tolerable times as large as
// allowed, with a warning; else multipliers follow the points from there on. The passes of a step that is
// iterated set out from the multipliers of the one before, and share this count.
constexpr int k_augmentations_by_means = 60;
constexpr double k_tolerable = 10;
// After so many augmentations a step is accepted as it is, with a warning that says how far it is off, unless
// the default penalty alone would leave less.
constexpr int k_most_augmentations = 200;
// Augmentations by default (ContactSpec::pressure_tolerance) end here: what is left is less than the
// penalty alone would leave.
constexpr int k_most_augmentations_by_default = 12;

const contact::ContactState& state_of(const std::vector<contact::ContactState>& contacts, std::size_t i) {
  static const contact::ContactState k_unmoved;
  return contacts.empty() ? k_unmoved : contacts[i];
}

/// Advances the history of a point to the start of the second stage, from t_n and the end of the first stage;
/// `start` is the latter on entry.
void advance_history(const contact::ContactPointState& from, const contact::ContactPointState& to,
                     double carried, contact::ContactPointState& start) {
  if (!from.anchored || !to.anchored) return;
  for (auto field : {&contact::ContactPointState::penetration, &contact::ContactPointState::internal_variable,
                     &contact::ContactPointState::slip, &contact::ContactPointState::work,
                     &contact::ContactPointState::dissipation, &contact::ContactPointState::wear_depth,
                     &contact::ContactPointState::plastic_entropy})
    start.*field = from.*field + carried * (to.*field - from.*field);
  for (auto field : {&contact::ContactPointState::traction, &contact::ContactPointState::anchor})
    start.*field = contact::add_scaled(from.*field, carried, contact::subtract(to.*field, from.*field));
  // In the entropy of the interface's capacity.
  if (from.temperature > 0 && to.temperature > 0)
    start.temperature = from.temperature * std::pow(to.temperature / from.temperature, carried);
}

/// The number among 1, 2, 5, 10, 20, 50, 100 that is not below a share in per cent: a warning that is given
/// once for each.
int rounded_up(double share) {
  constexpr int k_steps[] = {1, 2, 5, 10, 20, 50};
  for (const int step : k_steps)
    if (100 * share <= step) return step;
  return 100;
}

void warn_of_early_end(const contact::ContactPair& pair) {
  logging::warn(
      "contact '{}': in some steps, shorter ones too, the augmentations of the Lagrangian do not converge; "
      "they end at their last equilibrium, with penetrations above penetration_tolerance "
      "(augmentations_that_did_not_converge in summary.json); normal = \"penalty\" needs none",
      pair.parts().spec.name);
}

[[noreturn]] void reject_augmentations(const contact::ContactPair& pair, int augmentations, double excess) {
  throw StepRejected(fmt::format("contact '{}': {} augmentations of the Lagrangian leave penetrations "
                                 "{:.3g} times as large as allowed",
                                 pair.parts().spec.name, augmentations, excess),
                     contact::worst_penetration(pair.parts().geometry, pair.state()), Failure::multipliers);
}

bool numbers_everywhere(std::span<const double> values) {
  return !parallel::any_process(!std::ranges::all_of(values, [](double v) { return std::isfinite(v); }));
}

/// Ends the augmentations early where all pairs allow it; then true.
bool end_early(const Phases& phases) {
  for (const contact::ContactPair* pair : phases.contacts)
    if (pair->parts().augmentations.act() && !pair->parts().forces.multipliers().may_end_at(pair->state()))
      return false;
  for (contact::ContactPair* pair : phases.contacts)
    if (pair->parts().augmentations.excess() > 1) {
      pair->parts().augmentations.end();
      warn_of_early_end(*pair);
    }
  return true;
}

/// Takes the multipliers as they are and says so; throws StepRejected where pressures may be farther off than
/// with the default penalty alone.
void end_augmentations(const contact::ContactPair& pair, int augmentations, double excess) {
  constexpr double k_of_default_penalty = 0.1;
  const double share = pair.parts().augmentations.pressure_error();
  if (share > k_of_default_penalty) reject_augmentations(pair, augmentations, excess);
  logging::warn(
      "contact '{}': in some steps {} augmentations of the Lagrangian do not converge; its multipliers are "
      "taken as they are there, off by up to {} % of the mean contact pressure; normal = \"penalty\" or a "
      "larger penetration_tolerance costs fewer of them",
      pair.parts().spec.name, k_most_augmentations, rounded_up(share));
}

}  // namespace

void begin_contacts(const Phases& phases, const std::vector<contact::ContactState>& contacts,
                    const mechanics::MechanicalState& old, const mechanics::MechanicalPass& pass,
                    std::span<const double> coherency, const std::vector<contact::ContactState>& iterate,
                    bool further) {
  const profile::Part part("contact");
  // A pass tells its pairs what they need to know of the step: time, displacement and temperature at its
  // start, how solid the skins are, what the mapping holds, and the share of the forces in the balance.
  contact::ContactPass of_contact{
      .time = pass.time,
      .dt = pass.dt,
      .displacement = old.displacement,
      .temperature = pass.temperature,
      .solidity = solidity_of(phases, coherency),
      .isentropic = phases.heat != nullptr &&
                    phases.mechanics->bodies().options.mapping == mechanics::Mapping::isentropic,
      .simultaneous = phases.heat != nullptr &&
                      phases.mechanics->bodies().options.mapping == mechanics::Mapping::simultaneous,
      .further = further,
      .share = phases.mechanics->bodies().force_share()};
  // Each pair gets its own state at t_n and, within an iteration, the one of the pass before.
  for (std::size_t i = 0; i < phases.contacts.size(); ++i) {
    of_contact.iterate = iterate.empty() ? nullptr : &iterate[i];
    phases.contacts[i]->begin(state_of(contacts, i), of_contact);
  }
}

void rest_contacts(const Phases& phases, const State& old, double time, double dt) {
  for (std::size_t i = 0; i < phases.contacts.size(); ++i)
    if (phases.contacts[i]->parts().heat.has_temperature())
      phases.contacts[i]->hold(state_of(old.contacts, i), time, dt, old.heat.temperature);
}

bool interfaces_begin(const Phases& phases, const State& state) {
  bool begin = false;
  for (std::size_t i = 0; i < phases.contacts.size(); ++i) {
    if (!phases.contacts[i]->parts().heat.has_temperature()) continue;
    const auto known = [](const contact::ContactPointState& point) { return point.temperature > 0; };
    begin |= state.contacts.empty() ||
             (!state.contacts[i].points.empty() && std::ranges::none_of(state.contacts[i].points, known));
  }
  return parallel::any_process(begin);
}

void find_interface_temperatures(const Phases& phases, const State& state, double time) {
  // A step of no length finds the temperature that balances the fluxes of both sides.
  const std::vector<double> coherency = coherency_of(phases, state.heat);
  for (std::size_t i = 0; i < phases.contacts.size(); ++i) {
    contact::ContactPair& pair = *phases.contacts[i];
    // Only interfaces that store heat have a temperature that can be unknown.
    if (!pair.parts().heat.has_temperature()) continue;
    pair.begin(state_of(state.contacts, i), {.time = time,
                                             .dt = 0,
                                             .displacement = state.mechanics.displacement,
                                             .temperature = state.heat.temperature,
                                             .solidity = solidity_of(phases, coherency)});
    pair.update(state.mechanics.displacement);
  }
}

std::vector<contact::ContactState> contact_states(const Phases& phases) {
  std::vector<contact::ContactState> states;
  for (const contact::ContactPair* pair : phases.contacts) states.push_back(pair->state());
  return states;
}

void restore_contacts(const Phases& phases, const State& state) {
  for (std::size_t i = 0; i < phases.contacts.size(); ++i)
    phases.contacts[i]->restore(state_of(state.contacts, i), state.mechanics.displacement, state.time);
}

std::int64_t closed_points(const contact::ContactState& state) {
  const auto closed = std::ranges::count_if(state.points, [](const contact::ContactPointState& p) {
    return p.counted && p.status != contact::PointStatus::open;
  });
  return std::llround(parallel::global_sum(static_cast<double>(closed)));
}

std::vector<contact::ContactState> second_start(const Phases& phases,
                                                const std::vector<contact::ContactState>& old,
                                                const std::vector<contact::ContactState>& stage,
                                                double carried) {
  // Everything that integrates in time is carried on from t_n through the first stage. A pair without a state
  // at t_n starts from its initial one.
  std::vector<contact::ContactState> start = stage;
  for (std::size_t i = 0; i < stage.size(); ++i) {
    const bool moved = !state_of(old, i).points.empty();
    const contact::ContactState initial =
        moved ? contact::ContactState{} : phases.contacts[i]->parts().history.initial();
    const contact::ContactState& begun = moved ? old[i] : initial;
    for (std::size_t p = 0; p < stage[i].points.size(); ++p)
      advance_history(begun.points[p], stage[i].points[p], carried, start[i].points[p]);
    // Worn volume and dissipation of the master are carried in the same way.
    for (std::size_t a = 0; a < stage[i].master.size(); ++a)
      for (auto field : {&contact::WornNode::volume, &contact::WornNode::dissipation}) {
        const double from = begun.master[a].*field;
        start[i].master[a].*field = from + carried * (stage[i].master[a].*field - from);
      }
  }
  return start;
}

bool penetrations_small(const Phases& phases, int augmentation, int earlier) {
  // The pair whose penetration is farthest above its bound; those that ended early only have to keep theirs.
  double excess = 0;
  const contact::ContactPair* worst = nullptr;
  for (const contact::ContactPair* pair : phases.contacts) {
    const contact::AugmentedLagrangian& multipliers = pair->parts().forces.multipliers();
    if (multipliers.ended_early()) {
      // A further pass of a step whose augmentations have ended: the same bound holds for it.
      if (!multipliers.holds_bound(pair->state()))
        reject_augmentations(*pair, augmentation + earlier, pair->parts().augmentations.excess());
      continue;
    }
    // By default the pressure's tolerance ends the augmentations of a pair after a few.
    if (pair->parts().spec.pressure_tolerance && augmentation >= k_most_augmentations_by_default) continue;
    if (const double of_pair = pair->parts().augmentations.excess(); of_pair > excess) {
      excess = of_pair;
      worst = pair;
    }
  }
  if (excess <= 1) return true;
  logging::debug(
      "contact '{}': augmentation {} of the Lagrangian leaves penetrations {:.3g} times as large as "
      "allowed",
      worst->parts().spec.name, augmentation + earlier, excess);
  // After many augmentations points may alternate for good: what is nearly small enough is accepted, else
  // pairs end early, and at last all augmentations end.
  const bool enough = augmentation + earlier >= k_augmentations_by_means;
  if (enough && excess <= k_tolerable) {
    logging::warn(
        "contact '{}': in some steps points open and close from one augmentation of the Lagrangian to the "
        "next, and penetrations stay above penetration_tolerance, by less than {:g} times; normal = "
        "\"penalty\" or a larger tolerance costs fewer of them",
        worst->parts().spec.name, k_tolerable);
    return true;
  }
  if (enough && end_early(phases)) return true;
  if (augmentation + earlier >= k_most_augmentations) {
    end_augmentations(*worst, augmentation + earlier, excess);
    return true;
  }
  const contact::AugmentedBy by = enough ? contact::AugmentedBy::points : contact::AugmentedBy::means;
  for (contact::ContactPair* pair : phases.contacts) pair->parts().augmentations.augment(by);
  return false;
}

bool restore_multipliers(const Phases& phases) {
  // Only if all pairs can go back to their multipliers before the last augmentation.
  bool any = false;
  for (const contact::ContactPair* pair : phases.contacts) {
    if (!pair->parts().augmentations.act()) continue;
    if (!pair->parts().forces.multipliers().may_take_back()) return false;
    // A pair without multipliers has nothing to take back.
    any = true;
  }
  if (!any) return false;
  for (contact::ContactPair* pair : phases.contacts) {
    if (!pair->parts().augmentations.act()) continue;
    pair->parts().augmentations.take_back();
    warn_of_early_end(*pair);
  }
  return true;
}

void add_contacts(const Phases& phases, StepRejected& rejected) {
  // What contact says of its failure, and its state at the displacements that failed, for the diagnosis.
  std::string failure;
  for (const contact::ContactPair* pair : phases.contacts)
    if (failure.empty())
      failure = contact::failure_text(pair->parts().forces.term(), pair->parts().spec.name);
  if (!failure.empty()) rejected.append(" (" + failure + ")");
  // Only a failed equilibrium has an iterate at which the points can be looked at.
  auto* const equilibrium = dynamic_cast<mechanics::EquilibriumRejected*>(&rejected);
  if (equilibrium == nullptr || !numbers_everywhere(equilibrium->iterate.displacement)) return;
  equilibrium->iterate.contacts.clear();
  // update() moves the pairs to the displacements that failed; what changed in the last iteration
  // is kept.
  for (contact::ContactPair* pair : phases.contacts) {
    const std::int64_t changed = contact::changes(pair->parts().forces.term());
    pair->update(equilibrium->iterate.displacement);
    equilibrium->iterate.contacts.push_back({closed_points(pair->state()), changed});
  }
}

}  // namespace solidus::coupling
