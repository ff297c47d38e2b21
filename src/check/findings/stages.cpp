// Findings on stages: what a later stage leaves a casting without.
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "check/finding_family.hpp"
#include "mesh/body_faces.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "setup/body_input.hpp"

namespace solidus::check {

namespace {

/// Shorter stages than this share of the time that a casting takes to freeze need no cooling.
constexpr double k_short = 0.1;
/// A smaller part of the skin that nothing cools is left alone.
constexpr double k_small = 0.2;

/// Bodies that are there in a stage and that shared nodes join to one, itself included, [body].
std::vector<char> joined(const cases::CaseSpec& spec, const CaseMeasures& m, std::size_t body,
                         const cases::StageRun& stage) {
  // A walk over shared nodes, from body to body, among those that the stage has.
  std::vector<char> found(spec.bodies.size(), 0);
  std::vector<std::size_t> next{body};
  found[body] = 1;
  while (!next.empty()) {
    const std::size_t one = next.back();
    next.pop_back();
    for (std::size_t other = 0; other < found.size(); ++other)
      if (found[other] == 0 && m.bodies[one].shared_nodes[other] > 0 &&
          cases::holds(spec.bodies[other].stages, &stage)) {
        found[other] = 1;
        next.push_back(other);
      }
  }
  return found;
}

/// Whether a condition or a contact passes heat through the skin of some bodies in a stage.
bool exchanges_heat(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m,
                    const std::vector<char>& bodies, const cases::StageRun& stage) {
  // Measures of a surface give one body, or that there are several, any of which it may be.
  const auto among = [&](int body) {
    return body == setup::k_several_bodies || (body >= 0 && bodies[as_size(body)] != 0);
  };
  // Conditions first, then contacts with a law of heat on either side.
  for (std::size_t t = 0; t < spec.thermal_conditions.size(); ++t) {
    const cases::ThermalConditionSpec& condition = spec.thermal_conditions[t];
    const bool within =
        m.surfaces[t].area == 0 || condition.in_volume();  // of volumes and nodes: it may be any body's
    if (cases::holds(condition.stages, &stage) && (within || among(m.surfaces[t].body))) return true;
  }
  for (std::size_t c = 0; c < spec.contacts.size(); ++c)
    if (spec.contacts[c].heat && setup::holds(spec, spec.contacts[c], a.mesh, &stage) &&
        (among(m.contacts[c].slave_body) || among(m.contacts[c].master_body)))
      return true;
  return false;
}

/// Surfaces on which a condition of a stage, or one of its contacts that pass heat, acts.
std::set<std::string> cooled_surfaces(const cases::CaseSpec& spec, const setup::Assembly& a,
                                      const cases::StageRun& stage) {
  std::set<std::string> surfaces;
  for (const cases::ThermalConditionSpec& condition : spec.thermal_conditions)
    if (!condition.in_volume() && cases::holds(condition.stages, &stage)) surfaces.insert(condition.group);
  for (const cases::ContactSpec& contact : spec.contacts)
    if (contact.heat && setup::holds(spec, contact, a.mesh, &stage))
      for (const std::string& side : contact.sides()) surfaces.insert(side);
  return surfaces;
}

/// The share of the faces of a casting that contacts cooled in an earlier stage, and that nothing cools in
/// this one. Collective.
double share_left_alone(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m,
                        std::size_t body, const cases::StageRun& stage) {
  std::set<std::string> sides;
  for (std::size_t c = 0; c < spec.contacts.size(); ++c) {
    const bool earlier = std::any_of(a.stages.data(), &stage, [&](const cases::StageRun& before) {
      return before.cycle <= 1 && setup::holds(spec, spec.contacts[c], a.mesh, &before);
    });
    if (!spec.contacts[c].heat || !earlier) continue;
    if (m.contacts[c].slave_body == static_cast<int>(body)) sides.insert(m.contacts[c].slave);
    if (m.contacts[c].master_body == static_cast<int>(body)) sides.insert(m.contacts[c].master);
  }
  const auto all = mesh::body_face_keys(a.mesh, sides);
  const auto cooled = mesh::body_face_keys(a.mesh, cooled_surfaces(spec, a, stage));
  const double n = parallel::global_sum(static_cast<double>(all.size()));
  const double left = parallel::global_sum(static_cast<double>(
      std::ranges::count_if(all, [&](const auto& face) { return !cooled.contains(face); })));
  return n > 0 ? left / n : 0;
}

void find(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m, Findings& findings) {
  // After the shake-out the surface of a casting needs a condition of its own. For each poured body and later
  // stage the share of the skin is found that a contact cooled before and nothing cools now.
  if (!spec.has_heat()) return;
  for (const Pour& pour : m.pours) {
    std::set<std::string> told;
    for (const cases::StageRun& stage : a.stages) {
      const cases::StageSpec& its = *stage.stage;
      // Stages that are short against the freezing time (the body is carried from place to place) are left
      // out, and a stage of a cycle is told once.
      const double freezes = pour.freezing.time.value_or(0);
      if (&stage == &a.stages.front() || !cases::holds(spec.bodies[pour.body].stages, &stage) ||
          !(freezes > 0) || its.duration < k_short * freezes || !told.insert(its.name).second)
        continue;
      const std::vector<char> bodies = joined(spec, m, pour.body, stage);
      bool alone = true;
      for (std::size_t b = 0; b < bodies.size(); ++b) alone = alone && (bodies[b] == 0 || m.is_poured(b));
      const std::string& name = spec.bodies[pour.body].name;
      if (exchanges_heat(spec, a, m, bodies, stage)) {
        if (const double share = share_left_alone(spec, a, m, pour.body, stage); share > k_small)
          findings.push_back(
              {false, its.where,
               fmt::format(
                   "{:.0f} % of the skin of '{}' that contacts cooled before has neither a contact nor "
                   "a condition in the stage '{}'",
                   100 * share, name, its.name),
               "after the shake-out a film of 5 to 30 W/m2/K and radiation on each surface that is free "
               "then, "
               "with the stage among its 'stages'"});
        continue;
      }
      // A stage in which nothing at all cools the body and all that it is joined to is told otherwise.
      if (!alone) continue;
      findings.push_back(
          {false, its.where,
           fmt::format("nothing cools '{}' in the stage '{}': neither a condition nor a contact acts on it, "
                       "and it keeps its heat for {:.4g} s",
                       name, its.name, its.duration),
           "after the shake-out a film of 5 to 30 W/m2/K and radiation, with the stage among its 'stages'"});
    }
  }
}

}  // namespace

// The place of the family among the others, its search, and the rows of the reference page, whose numbers are
// the thresholds that the search compares with.
FindingFamily findings_stages() {
  return {.name = "stages",
          .place = 100,
          .find = &find,
          .rows = {{Topic::pour, "nothing cools a casting in a later stage",
                    fmt::format("neither a condition nor a contact acts on it, for more than {} of the "
                                "estimated time to freeze",
                                percent(k_short))},
                   {Topic::pour, "a surface that was freed and that nothing cools",
                    fmt::format("in such a stage, more than {} of the faces that contacts cooled before have "
                                "neither a contact nor a condition",
                                percent(k_small))}}};
}

}  // namespace solidus::check
