#include "coupling/contact_states.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/errors.hpp"
#include "base/profile.hpp"

namespace solidus::coupling {

namespace {

constexpr int k_most_augmentations = 60;

const contact::ContactState& state_of(const std::vector<contact::ContactState>& contacts, std::size_t i) {
  static const contact::ContactState k_unmoved;
  return contacts.empty() ? k_unmoved : contacts[i];
}

}  // namespace

void begin_contacts(const Phases& phases, const std::vector<contact::ContactState>& contacts,
                    const mechanics::MechanicalState& old, const mechanics::MechanicalPass& pass) {
  const profile::Part part("contact");
  const contact::ContactPass of_contact{
      .time = pass.time,
      .dt = pass.dt,
      .displacement = old.displacement,
      .temperature = pass.temperature,
      .isentropic = phases.heat != nullptr && phases.mechanics->mapping() == mechanics::Mapping::isentropic,
      .share = phases.mechanics->force_share()};
  for (std::size_t i = 0; i < phases.contacts.size(); ++i)
    phases.contacts[i]->begin(state_of(contacts, i), of_contact);
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

std::vector<contact::ContactState> second_start(const std::vector<contact::ContactState>& old,
                                                const std::vector<contact::ContactState>& stage,
                                                double carried) {
  std::vector<contact::ContactState> start = stage;
  for (std::size_t i = 0; i < stage.size(); ++i) {
    if (state_of(old, i).points.empty()) continue;
    for (std::size_t p = 0; p < stage[i].points.size(); ++p) {
      const contact::PointState &from = old[i].points[p], &to = stage[i].points[p];
      contact::PointState& s = start[i].points[p];
      if (!from.anchored || !to.anchored) continue;
      const auto go_on = [&](auto field) { s.*field = from.*field + carried * (to.*field - from.*field); };
      for (auto field : {&contact::PointState::penetration, &contact::PointState::internal_variable,
                         &contact::PointState::slip, &contact::PointState::work,
                         &contact::PointState::dissipation, &contact::PointState::wear_depth})
        go_on(field);
      for (auto field : {&contact::PointState::traction, &contact::PointState::anchor})
        s.*field = contact::add_scaled(from.*field, carried, contact::subtract(to.*field, from.*field));
    }
  }
  return start;
}

bool penetrations_small(const Phases& phases, int turn) {
  double excess = 0;
  const contact::ContactPair* worst = nullptr;
  for (const contact::ContactPair* pair : phases.contacts)
    if (const double of_pair = pair->excess(); of_pair > excess) {
      excess = of_pair;
      worst = pair;
    }
  if (excess <= 1) return true;
  if (turn >= k_most_augmentations)
    throw StepRejected(
        fmt::format("contact '{}': {} turns of the augmented Lagrangian leave penetrations {:.3g} times as "
                    "large as allowed",
                    worst->spec().name, turn, excess),
        "a larger penalty, a larger penetration_tolerance or a smaller Newton tolerance");
  for (contact::ContactPair* pair : phases.contacts) pair->augment();
  return false;
}

void reject_with_contacts(const Phases& phases, const StepRejected& rejected) {
  for (const contact::ContactPair* pair : phases.contacts)
    if (const std::string trouble = pair->trouble(); !trouble.empty())
      throw StepRejected(rejected.reason() + " (" + trouble + ")", rejected.where());
  throw rejected;
}

}  // namespace solidus::coupling
