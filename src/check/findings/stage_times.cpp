// Findings on the times of stages: steps, tables of time on another clock than their condition, and supports
// that begin in a later stage where a casting has shrunk by then.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "check/finding_family.hpp"
#include "numbers/index_casts.hpp"
#include "setup/body_input.hpp"

namespace solidus::check {

namespace {

constexpr double k_fine = 4,
                 k_least_steps_to_freeze =
                     20;        // steps, least steps, in the estimated time to freeze: so many at least
constexpr double k_many = 5e4;  // steps of a stage that are too many
constexpr double k_least_share_of_range = 0.2;  // of the range of a table

/// Stages of which a casting sees something while it freezes, as they first come.
std::vector<const cases::StageRun*> freezing_stages(const cases::CaseSpec& spec, const setup::Assembly& a,
                                                    const Pour& pour) {
  std::vector<const cases::StageRun*> stages;
  std::optional<double> poured;
  for (const cases::StageRun& stage : a.stages) {
    const bool there = cases::holds(spec.bodies[pour.body].stages, &stage);
    if (!there && poured) break;
    if (!there) continue;
    if (!poured) poured = stage.start;
    if (stage.start >= *poured + pour.freezing.time.value_or(0)) break;
    stages.push_back(&stage);
  }
  return stages;
}

/// The first stage has the rule of runs without stages where steps are fixed; all others have theirs here.
void steps_of_freezing(const cases::CaseSpec& spec, const setup::Assembly& a, const Pour& pour,
                       Findings& findings) {
  if (!pour.freezing.time) return;
  const double time = *pour.freezing.time;
  const std::string& name = spec.bodies[pour.body].name;
  // One finding is enough: later stages would repeat it.
  for (const cases::StageRun* run : freezing_stages(spec, a, pour)) {
    const cases::StageSpec& stage = *run->stage;
    // Adaptive stages are judged by their first step, fixed ones by the step they keep.
    const double step = cases::first_step(stage, spec.time);
    const bool first = run == a.first_stage();
    if (k_fine * step > time && (spec.time.adaptive || !first)) {
      findings.push_back(
          {false, stage.where,
           fmt::format("the {} of the stage '{}' {} {:g} s, but '{}' freezes within some {:.3g} s",
                       spec.time.adaptive ? "first step" : "steps", stage.name,
                       spec.time.adaptive ? "is" : "are", step, name, time),
           spec.time.adaptive ? "a 'step' of a thousandth to a hundredth of that"
                              : "twenty steps and more while it freezes; time.adaptive chooses them"});
      return;
    }
    // The least step must leave some steps for the freezing, or a rough place cannot be got over.
    if (const double least = spec.time.adaptive ? stage.min_step.value_or(0) : 0;
        k_least_steps_to_freeze * least > time) {
      findings.push_back(
          {false, stage.where,
           fmt::format("steps of {:g} s at least in the stage '{}', but '{}' freezes within some {:.3g} s",
                       least, stage.name, name, time),
           "a smaller 'min_step', or none"});
      return;
    }
  }
}

/// Steps of a stage by themselves.
void steps_of_stages(const cases::CaseSpec& spec, Findings& findings) {
  for (const cases::StageSpec& stage : spec.stages) {
    if (const double most = stage.max_step.value_or(0); most > stage.duration)
      findings.push_back({false, stage.where,
                          fmt::format("a max_step of {:g} s limits nothing: the stage '{}' takes {:g} s",
                                      most, stage.name, stage.duration),
                          "a tenth of the stage and less, or none; is its unit right?"});
    const double step = spec.time.adaptive ? stage.max_step.value_or(0) : cases::first_step(stage, spec.time);
    if (step > 0 && stage.duration > k_many * step)
      findings.push_back({false, stage.where,
                          fmt::format("the stage '{}' of {:g} s takes {:.3g} steps of {:g} s", stage.name,
                                      stage.duration, stage.duration / step, step),
                          "some hundred steps; time.adaptive chooses them"});
  }
}

/// A table of time of a condition.
struct TimeTable {
  const Table& table;
  const std::vector<std::string>& stages;
  cases::TimeOrigin clock;
  std::string name;
  SourceLocation where;
};

std::vector<TimeTable> time_tables(const cases::CaseSpec& spec) {
  std::vector<TimeTable> tables;
  // Only tables of time that are tables: those of place have the time within them.
  const auto add = [&](const auto& c, const Function& f) {
    if (f.place == nullptr && f.of == Argument::time && !f.table.constant())
      tables.push_back({f.table, c.stages, c.clock, c.name, c.where});
  };
  // All functions of both kinds of conditions, components of motion included.
  for (const cases::ThermalConditionSpec& c : spec.thermal_conditions)
    for (const Function* f :
         {&c.coefficient, &c.ambient, &c.temperature, &c.flux, &c.emissivity, &c.power, &c.factor})
      add(c, *f);
  for (const cases::MechanicalConditionSpec& c : spec.mechanical_conditions) {
    for (const Function* f : {&c.pressure, &c.level, &c.squeeze}) add(c, *f);
    for (const std::vector<Function>* all : {&c.traction, &c.force})
      for (const Function& f : *all) add(c, f);
    for (const auto* u : {&c.ux, &c.uy, &c.uz, &c.ur})
      if (*u) add(c, **u);
  }
  return tables;
}

/// A table that counts from the start of the run, and is over when its stage begins, or in the first of
/// several rounds. Two points of a condition of all stages are a start that is over.
void tables_of_the_run(const setup::Assembly& a, const TimeTable& t, Findings& findings) {
  // The stages in which the condition holds, in the order in which they run.
  std::vector<const cases::StageRun*> runs;
  for (const cases::StageRun& stage : a.stages)
    if (cases::holds(t.stages, &stage)) runs.push_back(&stage);
  const double last = t.table.x().back();
  if (runs.empty()) return;
  const bool named = !t.stages.empty();
  // The table has ended before the condition first acts, so that it only ever gives its last value.
  if (named && last <= runs.front()->start && runs.front()->start > 0) {
    findings.push_back({false, t.where,
                        fmt::format("the table of '{}' ends at {:g} s, but its stage '{}' begins at {:g} s",
                                    t.name, last, runs.front()->stage->name, runs.front()->start),
                        "time = \"stage\": then it counts from the start of the stage"});
    return;
  }
  // Rounds repeat a stage at later times, at which a table of the run is over.
  const int rounds = runs.back()->cycle;
  const auto first_round =
      std::ranges::find_if(runs, [](const cases::StageRun* run) { return run->cycle > 1; });
  constexpr std::size_t k_ramp = 2;
  if (first_round == runs.end() || runs.front()->cycle == 0 || (!named && t.table.x().size() <= k_ramp))
    return;
  if (const double end = (*(first_round - 1))->end; last <= end)
    findings.push_back(
        {false, t.where,
         fmt::format("the table of '{}' ends at {:g} s, in the first of {} rounds; from then on "
                     "it is a number",
                     t.name, last, rounds),
         "time = \"stage\": then it counts from the start of each stage"});
}

/// The share of the range of a table that lies in its first seconds.
double share_of_range(const Table& table, double seconds) {
  double low = std::min(table.value(0), table.value(seconds)),
         high = std::max(table.value(0), table.value(seconds));
  for (std::size_t i = 0; i < table.x().size(); ++i)
    if (table.x()[i] > 0 && table.x()[i] < seconds) {
      low = std::min(low, table.y()[i]);
      high = std::max(high, table.y()[i]);
    }
  return (high - low) / (table.max_value() - table.min_value());
}

/// A table that counts from the start of its stage, and changes when that is over, or begins where the stage
/// begins in the run.
void tables_of_the_stage(const setup::Assembly& a, const TimeTable& t, Findings& findings) {
  constexpr double k_same = 0.01;
  double longest = 0;
  const cases::StageRun* begins_there = nullptr;
  const double first = t.table.x().front(), last = t.table.x().back();
  // The longest of its stages is what the table has to be spread over.
  for (const cases::StageRun& stage : a.stages) {
    if (!cases::holds(t.stages, &stage)) continue;
    longest = std::max(longest, stage.stage->duration);
    if (first > 0 && std::abs(first - stage.start) <= k_same * stage.start) begins_there = &stage;
  }
  if (begins_there != nullptr)
    findings.push_back(
        {false, t.where,
         fmt::format("the table of '{}' begins at {:g} s, as the stage '{}' does in the run, but "
                     "counts from the start of the stage",
                     t.name, first, begins_there->stage->name),
         "a table that begins at 0 s, or time = \"run\""});
  // Longer than the stage, and nearly flat within it: its change comes when the condition no longer
  // acts.
  else if (last > longest && share_of_range(t.table, longest) < k_least_share_of_range)
    findings.push_back(
        {false, t.where,
         fmt::format("the table of '{}' goes from {:g} s to {:g} s, counted from the start of a "
                     "stage of {:g} s, which sees next to nothing of it",
                     t.name, first, last, longest),
         "times within the stage, or time = \"run\""});
}

/// A support that begins later pulls the nodes to their places in the mesh. Collective.
void late_supports(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m,
                   Findings& findings) {
  for (const cases::MechanicalConditionSpec& c : spec.mechanical_conditions) {
    // Relative supports hold where the node is; those that move in time are meant to.
    if (c.kind != cases::MechanicalConditionSpec::Kind::displacement || c.relative || c.stages.empty())
      continue;
    const std::array components{&c.ux, &c.uy, &c.uz, &c.ur};
    if (std::ranges::any_of(components, [](const auto* u) { return *u && !is_number(**u); })) continue;
    const int number = setup::measure_surface(a.mesh, c.group, spec.analysis.kind).body;
    if (number < 0 || !m.is_poured(as_size(number))) continue;
    const cases::BodySpec& body = spec.bodies[as_size(number)];
    // A stage in which the support is new while the casting has been there before.
    for (std::size_t i = 1; i < a.stages.size() && a.stages[i].cycle <= 1; ++i) {
      const cases::StageRun &before = a.stages[i - 1], &now = a.stages[i];
      const bool begins = cases::holds(c.stages, &now) && !cases::holds(c.stages, &before) &&
                          cases::holds(body.stages, &before) && cases::holds(body.stages, &now);
      if (cases::only_conducts(body) || !begins) continue;
      findings.push_back(
          {false, c.where,
           fmt::format("the support '{}' begins at {:g} s, in the stage '{}', and pulls '{}' of '{}' to its "
                       "place in the mesh within the first step: the casting has moved by then",
                       c.name, now.start, now.stage->name, c.group, body.name),
           "relative = true: it holds the nodes where they are"});
      break;
    }
  }
}

void find(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m, Findings& findings) {
  if (a.stages.empty()) return;
  for (const TimeTable& table : time_tables(spec))
    table.clock == cases::TimeOrigin::run ? tables_of_the_run(a, table, findings)
                                          : tables_of_the_stage(a, table, findings);
  if (m.pours.empty()) return;
  for (const Pour& pour : m.pours) steps_of_freezing(spec, a, pour, findings);
  steps_of_stages(spec, findings);
  if (spec.has_mechanics()) late_supports(spec, a, m, findings);
}

}  // namespace

// The place of the family among the others, its search, and the rows of the reference page, whose numbers are
// the thresholds that the search compares with.
FindingFamily findings_stage_times() {
  return {
      .name = "times of stages",
      .place = 120,
      .find = &find,
      .rows = {{Topic::pour, "steps of a stage",
                fmt::format("while the casting freezes: fixed ones, or the first of adaptive ones, above "
                            "1/{} of the estimated time to freeze, `min_step` above 1/{} of it; `max_step` "
                            "longer than the stage; more than {} fixed steps, or steps of `max_step`, in one "
                            "stage of a case where something is poured",
                            number(k_fine), number(k_least_steps_to_freeze), number(k_many))},
               {Topic::conditions, "tables of time on another clock than their stage",
                fmt::format("one with `time = \"run\"` that has ended when its stage begins, or in the first "
                            "of several rounds; one with `time = \"stage\"` that begins at the time at which "
                            "the stage begins in the run, or of whose range the stage uses less than {}",
                            percent(k_least_share_of_range))},
               {Topic::mechanics, "a support that begins later",
                "on a surface of a casting that existed before, a constant and not `relative`"}}};
}

}  // namespace solidus::check
