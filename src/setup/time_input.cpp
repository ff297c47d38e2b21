/// The keys of [time] become options of the simulation, stage by stage; contradictions are told with both
/// keys.
#include "setup/time_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cases/stage_input.hpp"

namespace solidus::setup {

namespace {

void refuse(const cases::TimeSpec& t, bool given, const char* key, const char* needs, const char* allowed) {
  if (given) throw InputError(t.where, fmt::format("'{}' means nothing {}", key, needs), allowed);
}

void check_limits(const cases::TimeSpec& t, const cases::CaseSpec& spec) {
  // Keys of [time] that mean nothing with others are refused instead of ignored, each with what it would
  // need.
  using coupling::ErrorControl;
  const bool errors = t.temperature_error || t.displacement_error || t.stress_error;
  const char* error_key = t.temperature_error    ? "temperature_error"
                          : t.displacement_error ? "displacement_error"
                                                 : "stress_error";
  // Fixed steps have neither bounds nor errors to be controlled by.
  if (!t.adaptive) {
    const char* needs = "without adaptive = true";
    refuse(t, t.max_step.has_value(), "max_step", needs, "adaptive = true, or no max_step");
    refuse(t, t.error_control != ErrorControl::predictor, "error_control", needs, "adaptive = true");
    refuse(t, errors, error_key, needs, "adaptive = true");
    refuse(t, t.solid_fraction_change.has_value(), "solid_fraction_change", needs, "adaptive = true");
    refuse(t, t.skin_change.has_value(), "skin_change", needs, "adaptive = true");
  }
  // Errors and the skin are judged by an estimate of the error, which has to be there.
  refuse(t, errors && t.error_control == ErrorControl::none, error_key, "with error_control = \"none\"",
         "error_control = \"predictor\" or \"doubling\"");
  refuse(t, t.skin_change && t.error_control == ErrorControl::none, "skin_change",
         "with error_control = \"none\"", "error_control = \"predictor\" or \"doubling\"");
  // Limits of heat mean nothing without heat, those of motion nothing without motion.
  if (!spec.has_heat()) {
    refuse(t, t.temperature_error.has_value(), "temperature_error", "in an analysis without heat",
           "displacement_error");
    refuse(t, t.solid_fraction_change.has_value(), "solid_fraction_change", "in an analysis without heat",
           "displacement_error");
    refuse(t, t.skin_change.has_value(), "skin_change", "in an analysis without heat", "displacement_error");
  }
  refuse(t, !spec.has_mechanics() && t.displacement_error, "displacement_error",
         "in an analysis without mechanics", "temperature_error");
  refuse(t, !spec.has_mechanics() && t.stress_error, "stress_error", "in an analysis without mechanics",
         "temperature_error");
  refuse(t, !spec.has_mechanics() && t.skin_change, "skin_change", "in an analysis without mechanics",
         "temperature_error");
}

void check_until(const cases::TimeSpec& t, const cases::CaseSpec& spec) {
  if (t.until != cases::TimeSpec::Until::solid) return;
  refuse(t, t.steady, "until = \"solid\"", "in a steady analysis", "no 'until'");
  refuse(t, !spec.stages.empty(), "until = \"solid\"",
         "in a run with stages, whose durations say when it ends", "no 'until'");
  refuse(t, !spec.has_heat(), "until = \"solid\"", "in an analysis without heat", "no 'until'");
}

void check_number_of_steps(const cases::TimeSpec& t, double steps) {
  if (steps > 1e8)
    throw InputError(t.where, fmt::format("{:.3g} steps would be needed", steps), "at most 1e8");
}

constexpr double k_solid_fraction_of_heat = 0.1;  ///< that may change in a step

/// The error of the displacement that a step may commit where the case does not say it [m].
double default_displacement_error(std::span<const double> sections) {
  // A casting shrinks by 1e-2: across a wall, of four sections, by a hundred times this.
  constexpr double k_share_of_section = 3e-4;
  double thinnest = std::numeric_limits<double>::max();  // of heat alone
  for (const double section : sections)
    if (section > 0) thinnest = std::min(thinnest, section);
  return k_share_of_section * thinnest;
}

bool deforms(std::span<const double> sections) {
  return std::ranges::any_of(sections, [](double section) { return section > 0; });
}

/// A share of the casting that may change in a step: `standard` where the case does not say which error of
/// the displacement it allows.
double share_of_step(double standard, const cases::TimeSpec& t, std::span<const double> sections) {
  constexpr double k_least = 1e-3, k_most = 0.5;
  if (!t.displacement_error || !deforms(sections)) return standard;
  // Four times the error is twice the step, and what a step changes goes with it.
  const double ratio = *t.displacement_error / default_displacement_error(sections);
  return std::clamp(standard * std::sqrt(ratio), k_least, k_most);
}

coupling::StepOptions step_options(const cases::TimeSpec& t, double step) {
  coupling::StepOptions options;
  // A limit that the case does not give has the default of the documentation.
  options.step = step;
  options.adaptive = t.adaptive;
  options.min_step = t.min_step.value_or(0);
  options.max_step = t.max_step.value_or(0);
  options.growth = t.growth;
  options.cut = t.cut;
  options.easy_iterations = t.easy_iterations;
  options.limits.control = t.error_control;
  options.limits.temperature = t.temperature_error.value_or(1.0);
  options.limits.stress = t.stress_error.value_or(0.005);
  options.limits.solid_fraction = solid_fraction_change(t, {}, k_solid_fraction_of_heat);
  options.limits.skin = skin_change(t, {});
  return options;
}

coupling::Stage stage(const cases::TimeSpec& t, const cases::StageRun& run) {
  coupling::StepOptions step = step_options(t, cases::first_step(*run.stage, t));
  if (run.stage->min_step) step.min_step = *run.stage->min_step;
  if (run.stage->max_step) step.max_step = *run.stage->max_step;
  return {.name = run.stage->name,
          .of_case = run.number,
          .cycle = run.cycle,
          .end = run.end,
          .step = step,
          .shot = run.shot,
          .begins_shot = run.begins_shot,
          .ends_shot = run.ends_shot,
          .pours = run.pours};
}

}  // namespace

void check_time(const cases::CaseSpec& spec) {
  const cases::TimeSpec& t = spec.time;
  check_until(t, spec);
  if (t.steady) return;
  // Stages bring durations and steps of their own; a case without them needs an end and a step.
  if (!spec.stages.empty()) {  // steps and durations are checked with the stages
    check_limits(t, spec);
    double steps = 0;
    for (const cases::StageRun& run : cases::stage_runs(spec))
      steps += run.stage->duration / cases::first_step(*run.stage, t);
    return check_number_of_steps(t, steps);
  }
  if (!t.end || !t.step)
    throw InputError(t.where, fmt::format("the key '{}' is missing in [time]", t.end ? "step" : "end"),
                     "end and step, or [[stage]] sections, or steady = true");
  // The least and the largest step enclose the first one.
  if (*t.step > *t.end) throw InputError(t.where, "the time step is longer than the whole time");
  if (t.min_step && *t.min_step > *t.step) throw InputError(t.where, "'min_step' is above 'step'");
  if (t.max_step && *t.max_step < *t.step) throw InputError(t.where, "'max_step' is below 'step'");
  check_limits(t, spec);
  check_number_of_steps(t, *t.end / *t.step);
}

double displacement_error(const cases::TimeSpec& t, std::span<const double> sections) {
  return t.displacement_error ? *t.displacement_error : default_displacement_error(sections);
}

double skin_change(const cases::TimeSpec& t, std::span<const double> sections) {
  if (t.skin_change) return *t.skin_change;
  return share_of_step(coupling::StepLimits{}.skin, t, sections);
}

double solid_fraction_change(const cases::TimeSpec& t, std::span<const double> sections, double standard) {
  if (t.solid_fraction_change) return *t.solid_fraction_change;
  return deforms(sections) ? share_of_step(standard, t, sections) : k_solid_fraction_of_heat;
}

coupling::TimeOptions time_options(const cases::CaseSpec& spec) {
  const cases::TimeSpec& t = spec.time;
  coupling::TimeOptions options;
  // End, or the moment at which all is solid, and the steps on the way there, with or without
  // stages.
  options.end = *t.end;
  options.until_solid = t.until == cases::TimeSpec::Until::solid;
  if (spec.stages.empty()) options.step = step_options(t, *t.step);
  for (const cases::StageRun& run : cases::stage_runs(spec)) options.stages.push_back(stage(t, run));
  // Where bodies grow, hot metal meets cold at every birth: the error of that moment is the mesh's, and no
  // step is short enough for it.
  constexpr double k_least_of_growth = 1.0 / 16;
  if (!spec.depositions.empty() && !t.min_step) {
    options.step.min_step = k_least_of_growth * options.step.step;
    for (coupling::Stage& each : options.stages)
      if (each.step.min_step == 0) each.step.min_step = k_least_of_growth * each.step.step;
  }
  options.output_at_stage_ends = spec.output.stage_ends;
  options.output_times = spec.output.times;
  options.checkpoint_every = spec.output.checkpoint_every.value_or(0);
  // Multiples of the period up to the end; rounding must not lose the last one.
  if (spec.output.every) {
    const double every = *spec.output.every;
    const auto n = static_cast<long>(std::floor(options.end / every * (1 + 1e-12)));
    for (long i = 1; i <= n; ++i) options.output_times.push_back(static_cast<double>(i) * every);
  }
  return options;
}

}  // namespace solidus::setup
