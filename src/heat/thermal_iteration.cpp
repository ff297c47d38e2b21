/// The stages and checks of a thermal step as single calls, for a caller that solves displacements along
/// with it.
#include "heat/thermal_iteration.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "heat/iteration/enthalpy_newton.hpp"
#include "heat/iteration/extrapolation_guard.hpp"
#include "heat/iteration/heat_system.hpp"
#include "heat/iteration/temperature_system.hpp"
#include "heat/storage/consistent_heat.hpp"
#include "heat/storage/point_storage.hpp"
#include "heat/storage/printed_heat.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "system/errors.hpp"

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

ThermalIteration::ThermalIteration(ThermalPhase& phase) : phase_(phase) {}

ThermalIteration::~ThermalIteration() = default;

double ThermalIteration::tolerance() const {
  const double given = phase_.options_.tolerance;
  return given > 0 ? given : nodal() ? k_nodal_tolerance : k_point_tolerance;
}

void ThermalIteration::begin(const ThermalState& old, double dt, const LoadWindow& loads) {
  guard_.reset();
  begin_stage(old, old, 0.0, dt, loads);
}

void ThermalIteration::begin_stage(const ThermalState& old, const ThermalState& stage, double factor,
                                   double dt, const LoadWindow& loads) {
  // An iteration within the coupled Newton method begins a stage: contributions learn the stage, and the
  // limits of conduction are found for it.
  old_ = &old;
  dt_ = dt;
  phase_.system_->parts().exchanges = true;
  if (phase_.printed_) phase_.printed_->begin_stage({dt, factor}, old.temperature);
  if (phase_.consistent_) {
    phase_.consistent_->begin_stage({dt}, old.temperature);
    if (factor != 0) phase_.consistent_->begin_stage({dt, factor}, stage.temperature);
  }
  now_ = phase_.start(stage, loads);
  range_ = phase_.limit_conduction(stage, old).range;
  at_start_ = range_of(old.temperature, stage.temperature);
  // With heat at the nodes the heat that the stage starts from is extrapolated through the stage before.
  if (nodal()) {
    stored_from_ = old.enthalpy;
    for (std::size_t i = 0; i < stored_from_.size(); ++i)
      stored_from_[i] += factor * (stage.enthalpy[i] - old.enthalpy[i]);
    newton_ = std::make_unique<EnthalpyNewton>(phase_.mesh_, *phase_.system_, *phase_.storage_,
                                               phase_.ghosts_, tolerance());
    newton_->begin(stored_from_, dt, now_.enthalpy);
    // Otherwise points store their heat, which they extrapolate themselves.
  } else {
    for (const auto& block : phase_.points_) {
      block->start(old.temperature, dt);
      if (factor != 0) block->extrapolate(stage.temperature, factor);
    }
    phase_.temperature_system_->use_storage(true);
    residual_.resize(as_size(phase_.mesh_.n_owned_nodes));
  }
}

void ThermalIteration::restart(const ThermalState& state) {
  now_ = state;
  if (nodal()) newton_->begin(stored_from_, dt_, now_.enthalpy);
}

bool ThermalIteration::may_extrapolate(const ThermalState& old, const ThermalState& stage,
                                       const LoadWindow& loads) {
  if (!nodal()) return true;
  TemperatureRange around = phase_.system_->limits().surroundings();  // at the end of the first stage
  phase_.system_->set_window(loads);
  // The range of surroundings over the whole step, with some room for deformation.
  const TemperatureRange at_end = phase_.system_->limits().surroundings();
  around = {std::min({around.lowest, at_end.lowest, at_start_.lowest}),
            std::max({around.highest, at_end.highest, at_start_.highest})};
  const double by_deformation =
      k_by_deformation + k_by_deformation_of_range * (around.highest - around.lowest);
  allowed_ = {around.lowest - by_deformation, around.highest + by_deformation};
  guard_ = std::make_unique<ExtrapolationGuard>(*phase_.system_, *phase_.storage_, old, stage);
  return !guard_->extrapolates_too_far(around);
}

bool ThermalIteration::overshoots(const ThermalState& next) const {
  return guard_ && (guard_->overshoots(next, allowed_) || guard_->turns_back(next, phase_.ghosts_));
}

void ThermalIteration::evaluate() {
  if (nodal()) {
    newton_->evaluate(now_.temperature);
    unbalanced_ = newton_->sums().unbalanced;
    return;
  }
  phase_.temperature_system_->residual(now_.temperature, residual_);
  double sum = 0;
  for (std::size_t i = 0; i < residual_.size(); ++i)
    if (!phase_.system_->parts().prescribed.fixed()[i]) sum += std::abs(residual_[i]);
  unbalanced_ = parallel::global_sum(sum);
}

bool ThermalIteration::revise_limits() {
  const TemperatureRange range = phase_.system_->limits().closed(range_, at_start_, now_.temperature);
  double beyond = 0;
  for (std::size_t i = 0; i < as_size(phase_.mesh_.n_owned_nodes); ++i)
    beyond = std::max({beyond, range.lowest - now_.temperature[i], now_.temperature[i] - range.highest});
  const double width = range.highest - range.lowest;
  if (!(parallel::global_max(beyond) > k_by_deformation + k_by_deformation_of_range * width)) return false;
  if (phase_.system_->limits().hold(now_.temperature, range) != HeldNodes::Found::further) return false;
  phase_.system_->limits().find(now_.temperature);
  return true;
}

std::span<const double> ThermalIteration::residual() const {
  return nodal() ? newton_->residual() : std::span<const double>(residual_);
}

double ThermalIteration::moved() const {
  return nodal() ? newton_->sums().moved : phase_.temperature_system_->moved();
}

bool ThermalIteration::converged() const {
  if (nodal()) return newton_->converged();
  return unbalanced_ <= tolerance() * moved() ||
         unbalanced_ <= phase_.temperature_system_->round_off(now_.temperature);
}

linear::BlockMatrix& ThermalIteration::matrix() {
  return phase_.system_->matrix();
}

linear::BlockMatrix& ThermalIteration::assemble(int iteration) {
  if (nodal()) {
    newton_->adapt_tilt(iteration, now_.temperature);
    newton_->assemble(now_.temperature);
    return phase_.system_->matrix();
  }
  rhs_.resize(residual_.size());
  for (std::size_t i = 0; i < rhs_.size(); ++i)
    rhs_[i] = phase_.system_->parts().prescribed.fixed()[i] ? 0.0 : -residual_[i];
  return phase_.temperature_system_->exact_tangent(now_.temperature);
}

std::span<const double> ThermalIteration::right_hand_side() const {
  return nodal() ? newton_->right_hand_side() : std::span<const double>(rhs_);
}

void ThermalIteration::set_direction(std::span<double> step_t, std::span<const double> further) {
  start_ = now_;
  if (nodal()) {
    newton_->hold(step_t.first(residual().size()));
    phase_.ghosts_.update(step_t, 1);
    newton_->enthalpy_step(step_t, further);
    return;
  }
  for (std::size_t i = 0; i < residual_.size(); ++i)
    if (phase_.system_->parts().prescribed.fixed()[i]) step_t[i] = 0;
  phase_.ghosts_.update(step_t, 1);
  step_.assign(step_t.begin(), step_t.end());
}

void ThermalIteration::move(double alpha) {
  if (nodal()) {
    newton_->move(start_.enthalpy, alpha, now_.temperature);
    phase_.ghosts_.update(now_.temperature, 1);
    return;
  }
  for (std::size_t i = 0; i < step_.size(); ++i)
    now_.temperature[i] = start_.temperature[i] + alpha * step_[i];
}

HeatBalance ThermalIteration::conclude(ThermalState& trial) {
  phase_.require_positive(now_.temperature);
  if (nodal()) phase_.book(residual(), dt_, now_.enthalpy);
  const ThermalState from{old_->temperature, stored_from_};
  HeatBalance balance = phase_.balance(from, now_, residual(), moved(), dt_);
  phase_.set_latent(balance, from, now_);
  trial = now_;
  return balance;
}

void ThermalIteration::reject(const std::string& reason) const {
  linear::NewtonReport report;
  report.reason = reason;
  phase_.require(report, residual(), now_.temperature);
  throw StepRejected("heat: " + reason, {}, Failure::heat);  // require() has thrown
}

}  // namespace solidus::heat
