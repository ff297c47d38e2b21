/// A second stage is watched at both of its ends, and conduction at its last iterate.
#include "heat/temperature_watch.hpp"

#include <algorithm>

#include "heat/iteration/extrapolation_guard.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"

namespace solidus::heat {

namespace {

// Deformation heats and cools too. Temperatures beyond their range by no more than this are taken to be its
// work: conduction is not limited for them.
constexpr double k_by_deformation = 1;              ///< [K]
constexpr double k_by_deformation_of_range = 0.01;  ///< as a share of the range of temperatures

/// The range of two fields over all processes. Collective.
TemperatureRange range_of(std::span<const double> a, std::span<const double> b) {
  TemperatureRange range;
  for (const std::span<const double> temperatures : {a, b})
    for (const double temperature : temperatures) {
      range.lowest = std::min(range.lowest, temperature);
      range.highest = std::max(range.highest, temperature);
    }
  return {parallel::global_min(range.lowest), parallel::global_max(range.highest)};
}

}  // namespace

TemperatureWatch::TemperatureWatch(ThermalParts& parts) : parts_(parts) {}

TemperatureWatch::~TemperatureWatch() = default;

void TemperatureWatch::begin_step() {
  guard_.reset();
}

void TemperatureWatch::begin_stage(const ThermalState& old, const ThermalState& stage,
                                   const TemperatureRange& range) {
  range_ = range;
  at_start_ = range_of(old.temperature, stage.temperature);
}

bool TemperatureWatch::may_extrapolate(const ThermalState& old, const ThermalState& stage,
                                       const LoadWindow& loads) {
  if (!parts_.nodal()) return true;
  TemperatureRange around = parts_.system->limits().surroundings();  // at the end of the first stage
  parts_.system->set_window(loads);
  // The range of surroundings over the whole step, with some room for deformation.
  const TemperatureRange at_end = parts_.system->limits().surroundings();
  around = {std::min({around.lowest, at_end.lowest, at_start_.lowest}),
            std::max({around.highest, at_end.highest, at_start_.highest})};
  const double by_deformation =
      k_by_deformation + k_by_deformation_of_range * (around.highest - around.lowest);
  allowed_ = {around.lowest - by_deformation, around.highest + by_deformation};
  guard_ = std::make_unique<ExtrapolationGuard>(*parts_.system, *parts_.storage, old, stage);
  return !guard_->extrapolates_too_far(around);
}

bool TemperatureWatch::overshoots(const ThermalState& next) const {
  return guard_ && (guard_->overshoots(next, allowed_) || guard_->turns_back(next, parts_.ghosts));
}

bool TemperatureWatch::revise_limits(const ThermalState& now) {
  const TemperatureRange range = parts_.system->limits().closed(range_, at_start_, now.temperature);
  double beyond = 0;
  for (std::size_t i = 0; i < as_size(parts_.mesh.n_owned_nodes); ++i)
    beyond = std::max({beyond, range.lowest - now.temperature[i], now.temperature[i] - range.highest});
  const double width = range.highest - range.lowest;
  if (!(parallel::global_max(beyond) > k_by_deformation + k_by_deformation_of_range * width)) return false;
  if (parts_.system->limits().hold(now.temperature, range) != HeldNodes::Found::further) return false;
  parts_.system->limits().find(now.temperature);
  return true;
}

}  // namespace solidus::heat
