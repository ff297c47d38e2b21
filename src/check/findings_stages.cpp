// Findings on stages: what a later stage leaves a casting without.
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "build/body_input.hpp"
#include "check/findings.hpp"

namespace solidus::model {

namespace {

/// Shorter stages than this share of the time that a casting takes to freeze need no cooling.
constexpr double k_short = 0.1;

/// Bodies that are there in a stage and that shared nodes join to one, itself included, [body].
std::vector<char> joined(const CaseSpec& spec, const CaseMeasures& m, std::size_t body,
                         const StageRun& stage) {
  std::vector<char> found(spec.bodies.size(), 0);
  std::vector<std::size_t> next{body};
  found[body] = 1;
  while (!next.empty()) {
    const std::size_t one = next.back();
    next.pop_back();
    for (std::size_t other = 0; other < found.size(); ++other)
      if (found[other] == 0 && m.bodies[one].shared_nodes[other] > 0 &&
          holds(spec.bodies[other].stages, &stage)) {
        found[other] = 1;
        next.push_back(other);
      }
  }
  return found;
}

/// Whether a condition or a contact passes heat through the skin of some bodies in a stage.
bool exchanges_heat(const CaseSpec& spec, const Assembly& a, const CaseMeasures& m,
                    const std::vector<char>& bodies, const StageRun& stage) {
  const auto among = [&](int body) {
    return body == k_several_bodies || (body >= 0 && bodies[static_cast<std::size_t>(body)] != 0);
  };
  for (std::size_t t = 0; t < spec.thermal_conditions.size(); ++t) {
    const ThermalConditionSpec& condition = spec.thermal_conditions[t];
    const bool within =
        m.surfaces[t].area == 0 || condition.in_volume();  // of volumes and nodes: it may be any body's
    if (holds(condition.stages, &stage) && (within || among(m.surfaces[t].body))) return true;
  }
  for (std::size_t c = 0; c < spec.contacts.size(); ++c)
    if (spec.contacts[c].heat && holds(spec, spec.contacts[c], a.mesh, &stage) &&
        (among(m.contacts[c].slave_body) || among(m.contacts[c].master_body)))
      return true;
  return false;
}

}  // namespace

void find_in_stages(const CaseSpec& spec, const Assembly& a, const CaseMeasures& m, Findings& findings) {
  if (!spec.has_heat()) return;
  for (const Pour& pour : m.pours) {
    std::set<std::string> told;
    for (const StageRun& stage : a.stages) {
      const StageSpec& its = *stage.stage;
      const double freezes = pour.freezing.time.value_or(0);
      if (&stage == &a.stages.front() || !holds(spec.bodies[pour.body].stages, &stage) || !(freezes > 0) ||
          its.duration < k_short * freezes || told.contains(its.name))
        continue;
      const std::vector<char> bodies = joined(spec, m, pour.body, stage);
      bool alone = true;
      for (std::size_t b = 0; b < bodies.size(); ++b) alone = alone && (bodies[b] == 0 || m.is_poured(b));
      if (!alone || exchanges_heat(spec, a, m, bodies, stage)) continue;
      told.insert(its.name);
      findings.push_back(
          {false, its.where,
           fmt::format("nothing cools '{}' in the stage '{}': neither a condition nor a contact acts on it, "
                       "and it keeps its heat for {:.4g} s",
                       spec.bodies[pour.body].name, its.name, its.duration),
           "after the shake-out a film of 5 to 30 W/m2/K and radiation, with the stage among its 'stages'"});
    }
  }
}

}  // namespace solidus::model
