// Findings on the order in which bodies come and leave: moulds that leave melt behind or come too late,
// stages of pouring in which nothing is poured, dies that lose their heat, and searches for a periodic state
// that end too soon.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string>
#include <vector>

#include "cases/roles.hpp"
#include "check/finding_family.hpp"
#include "numbers/index_casts.hpp"
#include "setup/body_input.hpp"

namespace solidus::check {

namespace {

/// Castings are solid no sooner than after this share of the estimate: of the runs that findings.md compares,
/// one with a burning sleeve is the soonest, at 1/1.35 of it.
constexpr double k_solid_at_last = 0.7;
/// Rounds that are too few for a search of a periodic state.
constexpr int k_least_rounds = 3;

bool is_there(const cases::CaseSpec& spec, std::size_t body, const cases::StageRun& stage) {
  return cases::holds(spec.bodies[body].stages, &stage);
}

/// When the casting that is there in a stage came [s].
double time_of_pour(const cases::CaseSpec& spec, const setup::Assembly& a, std::size_t body,
                    std::size_t stage) {
  while (stage > 0 && is_there(spec, body, a.stages[stage - 1])) --stage;
  return a.stages[stage].start;
}

/// The other side of a contact, where one side is the body; negative where it is no body, or several.
int partner(const setup::ContactMeasures& sides, std::size_t body) {
  const int one = static_cast<int>(body);
  if (sides.slave_body == one) return sides.master_body;
  return sides.master_body == one ? sides.slave_body : -1;
}

std::string with_next(std::string names, const std::string& name) {
  return (names.empty() ? "'" : names + ", '") + name + "'";
}

/// Stages that take moulds, cores or chills away from a casting before it can be solid. Collective.
void leave_melt(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m,
                const Pour& pour, Findings& findings) {
  if (!pour.freezing.time) return;
  // Pairs of successive stages of the first round: further rounds repeat them.
  for (std::size_t i = 1; i < a.stages.size() && a.stages[i].cycle <= 1; ++i) {
    const cases::StageRun &before = a.stages[i - 1], &now = a.stages[i];
    if (!is_there(spec, pour.body, before) || !is_there(spec, pour.body, now)) continue;
    // The time since the pour of this casting, which may itself come late in a cycle.
    const double since = now.start - time_of_pour(spec, a, pour.body, i);
    if (since >= k_solid_at_last * *pour.freezing.time) continue;
    // Names of all that leaves at once, so that one message tells them.
    std::string names;
    for (std::size_t c = 0; c < spec.contacts.size(); ++c) {
      const int other = partner(m.contacts[c], pour.body);
      if (other < 0 || m.is_poured(as_size(other))) continue;
      if (setup::holds(spec, spec.contacts[c], a.mesh, &before) &&
          !setup::holds(spec, spec.contacts[c], a.mesh, &now))
        names = with_next(names, spec.bodies[as_size(other)].name);
    }
    if (names.empty()) continue;
    findings.push_back(
        {false, now.stage->where,
         fmt::format("the stage '{}' frees '{}' of {} {:.3g} s after its pour, but it takes "
                     "some {:.3g} s to freeze",
                     now.stage->name, spec.bodies[pour.body].name, names, since, *pour.freezing.time),
         "moulds and cores leave what is solid: longer stages before, twice the estimate for "
         "thick places"});
    return;
  }
}

/// Bodies that come to a casting which has stood without them.
void come_too_late(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m,
                   const Pour& pour, Findings& findings) {
  std::vector<char> told(spec.bodies.size(), 0);
  for (std::size_t i = 1; i < a.stages.size() && a.stages[i].cycle <= 1; ++i) {
    const cases::StageRun &before = a.stages[i - 1], &now = a.stages[i];
    // A partner that comes while the casting is there already: the new body finds metal that has
    // frozen without it.
    if (!is_there(spec, pour.body, before) || !is_there(spec, pour.body, now)) continue;
    for (std::size_t c = 0; c < spec.contacts.size(); ++c) {
      const int number = partner(m.contacts[c], pour.body);
      if (number < 0) continue;
      const auto other = as_size(number);
      if (told[other] != 0 || m.is_poured(other) || is_there(spec, other, before) ||
          !is_there(spec, other, now))
        continue;
      told[other] = 1;
      findings.push_back(
          {false, spec.bodies[other].where,
           fmt::format("'{}' comes when the stage '{}' begins, at {:g} s; '{}' has been there without it "
                       "since {:g} s",
                       spec.bodies[other].name, now.stage->name, now.start, spec.bodies[pour.body].name,
                       before.start),
           "what holds a casting is there before it: stages run in the order of the file, and a body that "
           "comes back is new"});
    }
  }
}

/// Whether a stage is called after pouring.
bool is_called_pouring(std::string name) {
  std::ranges::transform(name, name.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name.starts_with("pour") || name.starts_with("fill");
}

/// Stages that are called after pouring, in which no casting is new.
void pour_nothing(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m,
                  Findings& findings) {
  for (std::size_t i = 0; i < a.stages.size() && a.stages[i].cycle <= 1; ++i) {
    const cases::StageRun& now = a.stages[i];
    // Stages that say in their name that they pour, and in which no casting is new.
    if (!is_called_pouring(now.stage->name)) continue;
    const bool pours = std::ranges::any_of(m.pours, [&](const Pour& pour) {
      return is_there(spec, pour.body, now) && (i == 0 || !is_there(spec, pour.body, a.stages[i - 1]));
    });
    // Two such stages in a row may be one pour in two parts.
    const bool follows_a_pour = i > 0 && is_called_pouring(a.stages[i - 1].stage->name);
    if (m.pours.empty() || pours || follows_a_pour) continue;
    const std::size_t casting = m.pours.front().body;
    const std::string name = spec.bodies[casting].name;
    // The stage in which the casting really begins is named, for the two are mostly exchanged.
    const auto first = std::ranges::find_if(
        a.stages, [&](const cases::StageRun& stage) { return is_there(spec, casting, stage); });
    findings.push_back(
        {false, now.stage->where,
         fmt::format("the stage '{}' begins at {:g} s, but '{}' is poured when '{}' begins, at {:g} s",
                     now.stage->name, now.start, name, first->stage->name, first->start),
         "[[stage]] sections in the order in which they come; 'stages' of a casting with that of its pour"});
  }
}

/// A die that leaves in the course of a shot is new in the next one.
void cold_dies(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m,
               Findings& findings) {
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    if (spec.bodies[b].role != cases::Role::die || m.is_poured(b)) continue;
    const auto comes_back = std::ranges::find_if(a.stages, [&](const cases::StageRun& stage) {
      const auto i = as_size(&stage - a.stages.data());
      return i > 0 && stage.cycle > 1 && is_there(spec, b, stage) && !is_there(spec, b, a.stages[i - 1]);
    });
    if (comes_back == a.stages.end()) continue;
    findings.push_back(
        {false, spec.bodies[b].where,
         fmt::format("the die '{}' leaves, and comes back new at {:g} s, with the {:.0f} degC of its start",
                     spec.bodies[b].name, comes_back->start, a.start[b].high - k_zero_celsius),
         "a die keeps its heat from shot to shot where it is there in all stages; cores are new"});
  }
}

/// Rounds that are too few for a search.
void few_rounds(const cases::CaseSpec& spec, Findings& findings) {
  for (const cases::CycleSpec& cycle : spec.cycles)
    if (cycle.periodic && cycle.repeat < k_least_rounds)
      findings.push_back({false, cycle.where,
                          fmt::format("the cycle '{}' looks for its periodic state in {} round{} at most",
                                      cycle.name, cycle.repeat, cycle.repeat == 1 ? "" : "s"),
                          "a 'repeat' of 20 to 200: the search ends as soon as it has found"});
}

void find(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m, Findings& findings) {
  if (!spec.has_heat() || a.stages.empty()) return;
  for (const Pour& pour : m.pours) {
    leave_melt(spec, a, m, pour, findings);
    come_too_late(spec, a, m, pour, findings);
  }
  pour_nothing(spec, a, m, findings);
  cold_dies(spec, a, m, findings);
  few_rounds(spec, findings);
}

}  // namespace

// The place of the family among the others, its search, and the rows of the reference page, whose numbers are
// the thresholds that the search compares with.
FindingFamily findings_leaving() {
  return {
      .name = "leaving",
      .place = 110,
      .find = &find,
      .rows = {
          {Topic::pour, "a mould, core or chill is removed from melt",
           fmt::format("a stage removes it from a casting at less than {} of the estimated time to freeze",
                       percent(k_solid_at_last))},
          {Topic::pour, "a mould comes too late",
           "a body in contact with a casting appears, or appears again, in a stage later than the casting"},
          {Topic::pour, "a stage of pouring in which nothing is poured",
           "its name begins with `pour` or `fill`, and no casting appears in it"},
          {Topic::pour, "a die that is new in every round",
           "a body with the role of a die is removed and appears again in a cycle"},
          {Topic::pour, "a short search for a periodic state",
           fmt::format("`repeat` allows less than {} rounds", k_least_rounds)}}};
}

}  // namespace solidus::check
