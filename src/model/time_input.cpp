#include "model/time_input.hpp"

#include <fmt/format.h>

#include <cmath>

namespace solidus::model {

namespace {

void refuse(const TimeSpec& t, bool given, const char* key, const char* needs, const char* allowed) {
  if (given) throw InputError(t.where, fmt::format("'{}' means nothing {}", key, needs), allowed);
}

void check_limits(const TimeSpec& t, const CaseSpec& spec) {
  using coupling::ErrorControl;
  const bool errors = t.temperature_error || t.displacement_error;
  const char* error_key = t.temperature_error ? "temperature_error" : "displacement_error";
  if (!t.adaptive) {
    const char* needs = "without adaptive = true";
    refuse(t, t.max_step.has_value(), "max_step", needs, "adaptive = true, or no max_step");
    refuse(t, t.error_control != ErrorControl::predictor, "error_control", needs, "adaptive = true");
    refuse(t, errors, error_key, needs, "adaptive = true");
    refuse(t, t.solid_fraction_change.has_value(), "solid_fraction_change", needs, "adaptive = true");
  }
  refuse(t, errors && t.error_control == ErrorControl::none, error_key, "with error_control = \"none\"",
         "error_control = \"predictor\" or \"doubling\"");
  if (!spec.has_heat()) {
    refuse(t, t.temperature_error.has_value(), "temperature_error", "in an analysis without heat",
           "displacement_error");
    refuse(t, t.solid_fraction_change.has_value(), "solid_fraction_change", "in an analysis without heat",
           "displacement_error");
  }
  refuse(t, !spec.has_mechanics() && t.displacement_error, "displacement_error",
         "in an analysis without mechanics", "temperature_error");
}

}  // namespace

void check_time(const CaseSpec& spec) {
  const TimeSpec& t = spec.time;
  if (t.steady) return;
  if (!t.end || !t.step)
    throw InputError(t.where, fmt::format("the key '{}' is missing in [time]", t.end ? "step" : "end"),
                     "end and step, or steady = true");
  if (*t.step > *t.end) throw InputError(t.where, "the time step is longer than the whole time");
  if (t.min_step && *t.min_step > *t.step) throw InputError(t.where, "'min_step' is above 'step'");
  if (t.max_step && *t.max_step < *t.step) throw InputError(t.where, "'max_step' is below 'step'");
  check_limits(t, spec);
  if (*t.end / *t.step > 1e8)
    throw InputError(t.where, fmt::format("{:.3g} steps would be needed", *t.end / *t.step), "at most 1e8");
}

double displacement_error(const TimeSpec& t, double diagonal) {
  constexpr double k_share_of_diagonal = 3e-5;  // a casting shrinks by 1e-2: a third of a per cent of it
  return t.displacement_error.value_or(k_share_of_diagonal * diagonal);
}

coupling::TimeOptions time_options(const CaseSpec& spec) {
  const TimeSpec& t = spec.time;
  coupling::TimeOptions options;
  options.end = *t.end;
  options.step.step = *t.step;
  options.step.adaptive = t.adaptive;
  options.step.min_step = t.min_step.value_or(0);
  options.step.max_step = t.max_step.value_or(0);
  options.step.growth = t.growth;
  options.step.cut = t.cut;
  options.step.easy_iterations = t.easy_iterations;
  options.step.limits.control = t.error_control;
  options.step.limits.temperature = t.temperature_error.value_or(1.0);
  options.step.limits.solid_fraction = t.solid_fraction_change.value_or(0.1);
  options.output_times = spec.output.times;
  options.checkpoint_every = spec.output.checkpoint_every.value_or(0);
  if (spec.output.every) {
    const double every = *spec.output.every;
    const auto n = static_cast<long>(std::floor(options.end / every * (1 + 1e-12)));
    for (long i = 1; i <= n; ++i) options.output_times.push_back(static_cast<double>(i) * every);
  }
  return options;
}

}  // namespace solidus::model
