/// The range of temperatures at the start and around bounds those at the end, widened by what deformation
/// can explain.
#include "coupling/guarded_scheme.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "heat/iteration/worst_node.hpp"
#include "heat/storage/nodal_enthalpy.hpp"
#include "numbers/index_casts.hpp"
#include "numbers/types.hpp"
#include "parallel/parallel.hpp"
#include "system/errors.hpp"

namespace solidus::coupling {

namespace {

constexpr double k_overshoot = 1;       ///< of integration in space, as a share of the range
constexpr double k_slack = 10;          ///< whatever the range [K]
constexpr double k_of_deformation = 2;  ///< times the heat of deformation, which is that of the last stage
constexpr double k_most = 0.25;         ///< of the highest absolute temperature

heat::TemperatureRange range_of(const heat::ThermalPhase& phase, const State& state) {
  heat::TemperatureRange range;
  for (Index i = 0; i < phase.mesh().n_owned_nodes; ++i) {
    const double t = state.heat.temperature[as_size(i)];
    range.lowest = std::min(range.lowest, t);
    range.highest = std::max(range.highest, t);
  }
  return {parallel::global_min(range.lowest), parallel::global_max(range.highest)};
}

heat::TemperatureRange including(const heat::TemperatureRange& a, const heat::TemperatureRange& b) {
  return {std::min(a.lowest, b.lowest), std::max(a.highest, b.highest)};
}

/// Beyond which nothing heats or cools; without end where something does.
heat::TemperatureRange range_around(const Phases& phases, double time) {
  heat::TemperatureRange around = heat::ambient_range(*phases.heat, time, false);
  for (const contact::ContactPair* pair : phases.contacts) {
    if (pair->parts().spec.friction) around.highest = HUGE_VAL;
    const std::optional<double> tool = contact::tool_temperature(pair->parts().spec, pair->parts().end.time);
    if (!tool) continue;
    around.lowest = std::min(around.lowest, *tool);
    around.highest = std::max(around.highest, *tool);
  }
  return around;
}

/// The temperature by which deformation can have changed owned nodes [K].
std::vector<double> by_deformation(const Phases& phases, const State& trial, double dt, double highest) {
  std::vector<double> heat(phases.heat->mesh().x.size(), 0.0);
  if (phases.structural == nullptr) return heat;
  phases.structural->add_residual(trial.heat.temperature, heat);
  const heat::NodalEnthalpy& storage = phases.heat->storage();
  for (Index i = 0; i < phases.heat->mesh().n_owned_nodes; ++i) {
    const auto n = as_size(i);
    const double capacity = storage.capacity(i, trial.heat.temperature[n]);
    const double change = capacity > 0 ? k_of_deformation * std::abs(heat[n]) * dt / capacity : 0.0;
    heat[n] = std::min(change, k_most * highest);
  }
  return heat;
}

}  // namespace

void require_continued(const Phases& phases, const State& old, const State& trial, double time, double dt) {
  if (phases.heat == nullptr) return;
  // The range that temperatures may follow from: those at the start, and the surroundings.
  const heat::ThermalPhase& phase = *phases.heat;
  const heat::TemperatureRange start = range_of(phase, old),
                               range = including(start, range_around(phases, time));
  // A side without a bound is replaced by the extreme temperature that was found.
  const heat::TemperatureRange found = including(start, range_of(phase, trial));
  const double lowest = std::isfinite(range.lowest) ? range.lowest : found.lowest,
               highest = std::isfinite(range.highest) ? range.highest : found.highest,
               width = highest - lowest;
  // The allowance covers the overshoot of the time integration and rounding.
  const double allowed = k_overshoot * width + k_slack;
  const std::vector<double>& now = trial.heat.temperature;
  // How far each own node lies beyond the range, less what deformation explains of it.
  const auto look = [&](const std::vector<double>* deformation) {
    heat::WorstNode worst;
    for (Index i = 0; i < phase.mesh().n_owned_nodes; ++i) {
      const auto n = as_size(i);
      const double beyond = std::max(range.lowest - now[n], now[n] - range.highest);
      worst.look(n, beyond - allowed - (deformation != nullptr ? (*deformation)[n] : 0.0));
    }
    return worst;
  };
  // The heat of deformation is computed only when something lies outside.
  if (!(parallel::global_max(look(nullptr).size) > 0)) return;
  const std::vector<double> deformation = by_deformation(phases, trial, dt, highest);
  const heat::WorstNode worst = look(&deformation);
  if (!(parallel::global_max(worst.size) > 0)) return;
  throw StepRejected(
      fmt::format(
          "coupling: a temperature that does not follow from those at the start of the step and around "
          "({:.4g} to {:.4g} degC), nor from the heat of deformation: another solution of the equations, or "
          "a split that diverges",
          lowest - k_zero_celsius, highest - k_zero_celsius),
      worst.text(phase.mesh(), now, {}), Failure::another_solution);
}

GuardedScheme::GuardedScheme(std::unique_ptr<CouplingScheme> scheme, Phases phases)
    : scheme_(std::move(scheme)), phases_(std::move(phases)) {}

StepEffort GuardedScheme::advance(const State& old, State& trial, double time, double dt) {
  return *advance_unless(old, trial, time, dt, {});
}

std::optional<StepEffort> GuardedScheme::advance_unless(const State& old, State& trial, double time,
                                                        double dt, const HeatJudge& stop) {
  std::optional<StepEffort> effort = scheme_->advance_unless(old, trial, time, dt, stop);
  if (effort) require_continued(phases_, old, trial, time, dt);
  return effort;
}

}  // namespace solidus::coupling
