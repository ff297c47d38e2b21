/// Stages and cycles are unrolled in time; names are resolved and contradictions told before anything is
/// built.
#include "cases/stage_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "numbers/index_casts.hpp"

namespace solidus::cases {

namespace {

std::vector<std::string> stage_names(const CaseSpec& spec) {
  std::vector<std::string> names;
  for (const StageSpec& s : spec.stages) names.push_back(s.name);
  return names;
}

/// The number of a stage in the case, from zero.
std::size_t find_stage(const CaseSpec& spec, const std::string& name, const SourceLocation& where,
                       const std::string& user) {
  const std::vector<std::string> names = stage_names(spec);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw InputError(where, fmt::format("{} names an unknown stage '{}'", user, name),
                     names.empty() ? "a [[stage]] of this name" : one_of(names, name));
  return as_size(found - names.begin());
}

void check_stage(const CaseSpec& spec, const StageSpec& s) {
  // Names are unique, because cycles and conditions refer to them. Every stage needs a first step from
  // somewhere, which fits into it and between the limits that hold for it.
  const auto same = std::count_if(spec.stages.begin(), spec.stages.end(),
                                  [&](const StageSpec& other) { return other.name == s.name; });
  if (s.name.empty()) throw InputError(s.where, "a [[stage]] has an empty name");
  if (same > 1)
    throw InputError(s.where, fmt::format("the name '{}' is used by two [[stage]] sections", s.name),
                     "each needs a name of its own; [[cycle]] repeats stages");
  if (s.step && s.steps)
    throw InputError(s.where, fmt::format("the stage '{}' has both 'step' and 'steps'", s.name),
                     "the size of a step or the number of steps");
  if (!s.step && !s.steps && !spec.time.step)
    throw InputError(s.where, fmt::format("the stage '{}' has no time step", s.name),
                     "step or steps in the stage, or step in [time] for all stages");
  // The first step must fit the stage and lie between its limits, or those of [time].
  const double step = first_step(s, spec.time);
  if (step > s.duration)
    throw InputError(s.where,
                     fmt::format("the stage '{}' lasts {:g} s, its step {:g} s", s.name, s.duration, step),
                     "a step that is not longer than the stage");
  const auto most = s.max_step ? s.max_step : spec.time.max_step;
  const auto least = s.min_step ? s.min_step : spec.time.min_step;
  if (least && *least > step)
    throw InputError(s.where,
                     fmt::format("the step of the stage '{}', {:g} s, is below 'min_step'", s.name, step),
                     fmt::format("at least {:g} s, or another min_step in the stage", *least));
  if (most && *most < step)
    throw InputError(s.where,
                     fmt::format("the step of the stage '{}', {:g} s, is above 'max_step'", s.name, step),
                     fmt::format("at most {:g} s, or another max_step in the stage", *most));
  if (s.max_step && !spec.time.adaptive)
    throw InputError(s.where, "'max_step' means nothing without adaptive = true in [time]",
                     "adaptive = true, or no max_step");
}

/// Checks the keys of the search for the periodic state.
void check_periodic(const CaseSpec& spec, const CycleSpec& cycle) {
  if (!cycle.periodic) {
    if (cycle.search != CycleSpec::Search::anderson)
      throw InputError(cycle.where,
                       fmt::format("'search' means nothing without 'periodic' in the cycle '{}'", cycle.name),
                       "periodic = \"1 K\", say, or no search");
    return;
  }
  // The search is for temperatures without inertia, in a cycle at the end of the run with a body that stays.
  if (!spec.has_heat())
    throw InputError(
        cycle.where,
        fmt::format("the cycle '{}' asks for periodic temperatures in an analysis without heat", cycle.name),
        "physics = \"heat\" or \"thermomechanical\", or no 'periodic'");
  if (spec.dynamics)
    throw InputError(
        cycle.where,
        fmt::format("the cycle '{}' asks for its periodic state, but the analysis has inertia", cycle.name),
        "no [dynamics], or no 'periodic'");
  if (cycle.stages.empty() || cycle.stages.back() != spec.stages.back().name)
    throw InputError(cycle.where,
                     fmt::format("the run ends when the cycle '{}' is periodic, but '{}' comes after it",
                                 cycle.name, spec.stages.back().name),
                     "a cycle with the last stages of the case, or no 'periodic'");
  if (std::none_of(spec.bodies.begin(), spec.bodies.end(), [&](const BodySpec& body) {
        return std::all_of(cycle.stages.begin(), cycle.stages.end(), [&](const std::string& stage) {
          return body.stages.empty() ||
                 std::find(body.stages.begin(), body.stages.end(), stage) != body.stages.end();
        });
      }))
    throw InputError(cycle.where, fmt::format("no body is there in all stages of the cycle '{}'", cycle.name),
                     "a die that stays, or no 'periodic'");
}

/// The cycle of each stage of the case, with those that a cycle has standing in a row.
std::vector<const CycleSpec*> cycles_of_stages(const CaseSpec& spec) {
  std::vector<const CycleSpec*> cycle_of(spec.stages.size(), nullptr);
  for (const CycleSpec& cycle : spec.cycles) {
    if (cycle.stages.empty())
      throw InputError(cycle.where, fmt::format("the cycle '{}' has no stages", cycle.name));
    // Stages of a cycle come in a row, as in the case, and belong to no other one.
    std::size_t next = 0;
    for (std::size_t i = 0; i < cycle.stages.size(); ++i) {
      const std::size_t stage =
          find_stage(spec, cycle.stages[i], cycle.where, fmt::format("the cycle '{}'", cycle.name));
      if (i > 0 && stage != next)
        throw InputError(cycle.where,
                         fmt::format("in the cycle '{}' the stage '{}' follows '{}', in the case it does not",
                                     cycle.name, cycle.stages[i], cycle.stages[i - 1]),
                         "stages in the order of the case, one behind the other");
      if (cycle_of[stage] != nullptr)
        throw InputError(cycle.where, fmt::format("the stage '{}' belongs to two cycles", cycle.stages[i]));
      cycle_of[stage] = &cycle;
      next = stage + 1;
    }
  }
  return cycle_of;
}

}  // namespace

std::vector<StageRun> stage_runs(const CaseSpec& spec) {
  // Stages are laid out in time, one run after the other. A cycle repeats its stages as often as it says, and
  // each round of a cycle of shots is numbered.
  const std::vector<const CycleSpec*> cycle_of = cycles_of_stages(spec);
  std::vector<StageRun> runs;
  double time = 0;
  int shot = 0;
  // A stage of the run has its place in time and the number of its round.
  const auto add = [&](std::size_t i, int cycle) {
    const double end = time + spec.stages[i].duration;
    StageRun& run = runs.emplace_back();
    run = {.stage = &spec.stages[i],
           .number = static_cast<int>(i) + 1,
           .cycle = cycle,
           .start = time,
           .end = end};
    // A stage pours if a body is there that was not in the stage before.
    time = end;
    if (runs.size() < 2) return;
    const StageRun& before = runs[runs.size() - 2];
    run.pours = std::any_of(spec.bodies.begin(), spec.bodies.end(), [&](const BodySpec& body) {
      return holds(body.stages, &run) && !holds(body.stages, &before);
    });
  };
  for (std::size_t i = 0; i < spec.stages.size();) {
    if (cycle_of[i] == nullptr) {
      add(i++, 0);
      continue;
    }
    // Rounds of shots are counted through all cycles.
    const std::size_t n = cycle_of[i]->stages.size();
    const bool shots = is_of_shots(spec, *cycle_of[i]);
    for (int cycle = 1; cycle <= cycle_of[i]->repeat; ++cycle) {
      shot += shots ? 1 : 0;
      for (std::size_t k = 0; k < n; ++k) {
        add(i + k, cycle);
        if (!shots) continue;
        runs.back().shot = shot;
        runs.back().begins_shot = k == 0;
        runs.back().ends_shot = k + 1 == n;
      }
    }
    i += n;
  }
  return runs;
}

bool is_of_shots(const CaseSpec& spec, const CycleSpec& cycle) {
  if (cycle.periodic) return true;
  return std::any_of(spec.bodies.begin(), spec.bodies.end(), [&](const BodySpec& body) {
    const auto there = std::count_if(cycle.stages.begin(), cycle.stages.end(), [&](const std::string& stage) {
      return body.stages.empty() ||
             std::find(body.stages.begin(), body.stages.end(), stage) != body.stages.end();
    });
    return there > 0 && there < static_cast<std::ptrdiff_t>(cycle.stages.size());
  });
}

std::vector<char> staying_bodies(const CaseSpec& spec) {
  std::vector<char> stays(spec.bodies.size(), 1);
  for (const StageRun& run : stage_runs(spec))
    for (std::size_t b = 0; b < stays.size(); ++b)
      if (run.shot > 0 && !holds(spec.bodies[b].stages, &run)) stays[b] = 0;
  return stays;
}

const CycleSpec* periodic_cycle(const CaseSpec& spec) {
  for (const CycleSpec& cycle : spec.cycles)
    if (cycle.periodic) return &cycle;
  return nullptr;
}

bool holds(const std::vector<std::string>& stages, const StageRun* run) {
  return stages.empty() || run == nullptr ||
         std::find(stages.begin(), stages.end(), run->stage->name) != stages.end();
}

TimeFunction on_clock(const Function& function, TimeOrigin clock, const StageRun* run) {
  if (clock == TimeOrigin::run || run == nullptr) return function.table;
  return {function.table, run->start, run->stage->duration};
}

double first_step(const StageSpec& stage, const TimeSpec& time) {
  if (stage.step) return *stage.step;
  return stage.steps ? stage.duration / *stage.steps : *time.step;
}

void resolve_stages(CaseSpec& spec) {
  if (spec.stages.empty()) {
    if (!spec.cycles.empty())
      throw InputError(spec.cycles.front().where, "there is a [[cycle]], but no [[stage]]",
                       "[[stage]] sections, which the cycle names");
    return;
  }
  // Stages and the end of [time] exclude one another.
  if (spec.time.steady)
    throw InputError(spec.stages.front().where, "a steady analysis has no stages", "steady = false");
  if (spec.time.end)
    throw InputError(spec.time.where, "'end' is given, but the case has stages: their durations make the end",
                     "no end in [time]");
  // At last each stage and cycle by itself.
  for (const StageSpec& stage : spec.stages) check_stage(spec, stage);
  for (const CycleSpec& cycle : spec.cycles) check_periodic(spec, cycle);
  spec.time.end = stage_runs(spec).back().end;
}

void check_stage_names(const CaseSpec& spec) {
  const auto check = [&spec](const std::vector<std::string>& stages, const SourceLocation& where,
                             const std::string& user) {
    for (const std::string& name : stages) find_stage(spec, name, where, user);
  };
  const auto check_clock = [&](TimeOrigin clock, const SourceLocation& where, const std::string& user) {
    if (clock == TimeOrigin::stage && spec.stages.empty())
      throw InputError(where, user + " counts the time of a stage, but the case has no stages",
                       "time = \"run\", or [[stage]] sections");
  };
  // Every user of stages names only stages that the case has.
  for (const auto& c : spec.thermal_conditions) {
    const std::string user = "the thermal condition '" + c.name + "'";
    check(c.stages, c.where, user);
    check_clock(c.clock, c.where, user);
  }
  for (const auto& c : spec.mechanical_conditions) {
    const std::string user = "the mechanical condition '" + c.name + "'";
    check(c.stages, c.where, user);
    check_clock(c.clock, c.where, user);
    if (c.relative && spec.stages.empty())
      throw InputError(c.where, user + " is relative to the start of a stage, but the case has no stages",
                       "relative = false, or [[stage]] sections");
  }
  for (const auto& c : spec.channels) {
    const std::string user = "the channel '" + c.name + "'";
    check(c.stages, c.where, user);
    check_clock(c.clock, c.where, user);
  }
  for (const auto& b : spec.bodies) check(b.stages, b.where, "the body '" + b.name + "'");
  for (const auto& c : spec.contacts) check(c.stages, c.where, "the contact '" + c.name + "'");
}

void check_stage_of_checkpoint(const CaseSpec& spec, const coupling::StageStart& stage, double time) {
  const std::vector<StageRun> runs = stage_runs(spec);
  const auto text = [](int number, const std::string& name, double start) {
    return number == 0 ? std::string("a run without stages")
                       : fmt::format("stage {} of the run, '{}' from {:g} s on", number, name, start);
  };
  int number = 0;
  for (const StageRun& run : runs) {
    ++number;
    // At the end of a stage a checkpoint is in this stage, or where the next one got stuck in that.
    const bool in_it = run.start <= time && time <= run.end;
    if (in_it && stage.number == number && stage.name == run.stage->name && stage.time == run.start) return;
  }
  if (runs.empty() && stage.number == 0) return;
  const auto here = std::find_if(runs.begin(), runs.end(), [&](const StageRun& r) { return time <= r.end; });
  const std::string found = text(stage.number, stage.name, stage.time);
  const std::string needed =
      runs.empty()         ? text(0, "", 0)
      : here == runs.end() ? fmt::format("no stage, for it ends at {:g} s,", runs.back().end)
                           : text(static_cast<int>(here - runs.begin()) + 1, here->stage->name, here->start);
  throw InputError(
      spec.stages.empty() ? spec.time.where : spec.stages.front().where,
      fmt::format("the checkpoint at t = {:g} s is in {}; the case has {} there", time, found, needed),
      "the same stages up to there, or a run without --restart");
}

}  // namespace solidus::cases
