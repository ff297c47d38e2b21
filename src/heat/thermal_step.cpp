/// A step of the thermal phase in one or two stages, and the error in time that its flows tell.
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <optional>

#include "heat/iteration/extrapolation_guard.hpp"
#include "heat/iteration/heat_exchange.hpp"
#include "heat/loads/stage_loads.hpp"
#include "heat/thermal_parts.hpp"
#include "heat/thermal_phase.hpp"
#include "material/time_integration.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "system/errors.hpp"
#include "system/log.hpp"

namespace solidus::heat {

namespace {

/// Share of the range of temperatures by which the end of a step may leave it where the caller takes part of
/// that back: deformation of the whole step acts before both stages (coupling/double_pass.hpp).
constexpr double k_far_overshoot = 0.01;

using material::k_sdirk_carried;
using material::k_sdirk_share;

/// Adds the last stage: total = last + carried × first, of all that counts in joules.
void add_stage(ThermalReport& report, double carried, ThermalReport& last) {
  // Stages after the first are extrapolated from it, so that the first counts with the share
  // `carried` (decision 0016).
  HeatBalance& first = report.balance;
  HeatBalance& sum = last.balance;
  sum.stored += carried * first.stored;
  sum.exchanged += carried * first.exchanged;
  sum.entropy_in += carried * first.entropy_in;
  for (std::size_t i = 0; i < sum.conditions.size(); ++i)
    sum.conditions[i].heat += carried * first.conditions[i].heat;
  for (std::size_t i = 0; i < sum.contributions.size(); ++i)
    sum.contributions[i] += carried * first.contributions[i];
  for (std::size_t i = 0; i < last.channels.size(); ++i)
    last.channels[i].heat += carried * report.channels[i].heat;
  last.newton.add_solves(report.newton);
  last.hardest = std::max(last.hardest, report.hardest);
  report = std::move(last);
}

/// The pass of one of two stages, to the end of the step.
ThermalPass part_of(const ThermalPass& pass, const LoadWindow& loads) {
  return {.time = pass.time,
          .dt = pass.dt,
          .iterate = pass.iterate,
          .newton_steps = pass.newton_steps,
          .loads = loads};
}

/// Adds what an attempt has cost to the report of the one that followed.
void add_effort(const ThermalReport& before, ThermalReport& report) {
  report.newton.add_solves(before.newton);
  report.hardest = std::max(report.hardest, before.hardest);
}

/// The range of surroundings at the present loads and at those of another window, which are set.
TemperatureRange surroundings_to(const LoadWindow& window, HeatSystem& system) {
  const TemperatureRange now = system.limits().surroundings();
  system.set_window(window);
  const TemperatureRange at_end = system.limits().surroundings();
  return {std::min(now.lowest, at_end.lowest), std::max(now.highest, at_end.highest)};
}

void keep_middle(ThermalState& middle, StageFlows& flows) {
  flows.middle_temperature = std::move(middle.temperature);
  flows.middle_enthalpy = std::move(middle.enthalpy);
}

}  // namespace

ThermalReport ThermalPhase::solve(const ThermalState& old, ThermalState& trial, const ThermalPass& pass) {
  assert(old.temperature.size() == parts_->mesh.x.size() && pass.dt > 0);
  // Contact may have changed the graph. An adiabatic pass exchanges nothing: the nodes only take what
  // deformation has warmed.
  parts_->follow_graph();
  parts_->solver->begin(true);
  parts_->system->parts().exchanges = !pass.adiabatic;
  ThermalState next;
  ThermalReport report;
  const bool flows = parts_->nodal() && !pass.adiabatic;
  // A step has one stage or two. The flow at its end is kept for the error estimate of the next one.
  if (pass.stepping == ThermalStepping::sdirk2) {
    report = solve_two_stages(old, pass, next);
  } else {
    report = solve_stage(old, old, {pass.dt}, pass, next);
    if (flows) report.flows.last = flow(old, next, {pass.dt});
  }
  set_latent(report.balance, old, next);
  if (flows) {
    report.flows.time = pass.time;
    report.flows.dt = pass.dt;
  }
  trial = std::move(next);
  return report;
}

/// SDIRK2; its second stage is backward Euler over the rest of the step where SDIRK2 would overshoot.
ThermalReport ThermalPhase::solve_two_stages(const ThermalState& old, const ThermalPass& pass,
                                             ThermalState& next) {
  // SDIRK2 has two stages with one coefficient; its second one starts from H_n + carried (H_1 −
  // H_n).
  const linear::RungeKuttaStage first{k_sdirk_share * pass.dt, 0}, extrapolated{first.dt, k_sdirk_carried},
      rest{pass.dt - first.dt, 1};
  // Flows of the stages are kept for estimates of the error in time.
  const bool flows = parts_->nodal() && !pass.adiabatic;
  // The first stage, backward Euler over its share of the step.
  ThermalState middle;
  ThermalPass to_middle = part_of(pass, first_loads(pass.time, pass.dt));
  to_middle.time = pass.time - pass.dt + first.dt;
  ThermalReport report = solve_stage(old, old, first, to_middle, middle);
  StageFlows stage_flows;
  stage_flows.share = k_sdirk_share;
  if (flows) stage_flows.first = flow(old, middle, first);
  std::optional<ExtrapolationGuard> guard;
  TemperatureRange around;
  bool second_order = true;
  // By the closed rule extrapolation is watched: the range of surroundings over both stages bounds what it
  // may lead to.
  if (flows && parts_->options.integration == HeatIntegration::closed) {
    around = surroundings_to(last_loads(pass.time, pass.dt, true), *parts_->system);
    guard.emplace(*parts_->system, *parts_->storage, old, middle);
    second_order = !pass.within_range || !guard->extrapolates_too_far(around);
  }
  // The second stage takes the means of loads over its own part of the step.
  ThermalPass to_end = part_of(pass, last_loads(pass.time, pass.dt, second_order));
  ThermalReport last = solve_stage(old, middle, second_order ? extrapolated : rest, to_end, next);
  // Afterwards the temperatures themselves tell; then the second stage is solved again, as backward Euler.
  const auto overshoots = [&] {
    if (!pass.within_range) return guard->overshoots(next, around, k_far_overshoot);
    return guard->overshoots(next, around) || guard->turns_back(next, parts_->ghosts);
  };
  if (second_order && guard && overshoots()) {
    second_order = false;
    to_end.loads = last_loads(pass.time, pass.dt, false);
    // The history of the first stage is built again, because the second one has overwritten it.
    begin_stage(first, old.temperature);
    add_effort(std::exchange(last, solve_stage(old, middle, rest, to_end, next)), last);
  }
  if (!second_order)
    logging::debug("heat: the step to t = {:g} s would overshoot; it is of first order", pass.time);
  const linear::RungeKuttaStage& stage = second_order ? extrapolated : rest;
  if (flows) stage_flows.last = flow(stage_start(old, middle, stage), next, stage);
  stage_flows.second_order = second_order;
  stage_flows.last_share = stage.dt / pass.dt;
  if (flows && parts_->keeps_stages) keep_middle(middle, stage_flows);
  // Sums of both stages are the step's.
  add_stage(report, stage.carried, last);
  report.flows = std::move(stage_flows);
  return report;
}

/// From H* = H_n + carried (H − H_n) with the H of `before`, which is the state at t_n in the first stage.
ThermalReport ThermalPhase::solve_stage(const ThermalState& old, const ThermalState& before,
                                        const linear::RungeKuttaStage& stage, const ThermalPass& pass,
                                        ThermalState& next) {
  begin_stage(stage, before.temperature);
  // H* itself lies so far ahead at a front that the iteration begins half way to it.
  const bool half_way = parts_->nodal() && stage.carried != 0 && pass.iterate == nullptr;
  next = start(pass.iterate != nullptr ? *pass.iterate : before, pass.window(), !half_way);
  ThermalReport report;
  if (!parts_->nodal()) {
    // By the open rule points keep the heats; the unknown is temperature.
    for (const auto& block : parts_->points) {
      block->start(old.temperature, stage.dt);
      if (stage.carried != 0) block->extrapolate(before.temperature, stage.carried);
    }
    parts_->temperature_system->use_storage(true);
    std::vector<double> residual(as_size(parts_->mesh.n_owned_nodes));
    report.newton = solve_temperature(next.temperature, residual, pass.newton_steps);
    report.hardest = report.newton.effort;
    report.balance = balance(old, next, residual, parts_->temperature_system->moved(), stage.dt);
    return report;
  }
  // The sources of a stage: nodal heats H* from which it stores.
  std::vector<double> from = stage_start(old, before, stage).enthalpy;
  if (half_way) start_from(stage_start(old, before, {stage.dt, 0.5 * (1 + stage.carried)}).enthalpy, next);
  std::vector<double> changed = solve_balance(from, stage.dt, before, old, pass, next, report);
  report.hardest = report.newton.effort;
  std::vector<double> residual = parts_->truncated_newton->take_residual();
  require_positive(next.temperature);
  // After the iteration what is left of the residual is booked into the nodal heats, so that the
  // balance is exact whatever the tolerance.
  if (!may_end(report.newton, pass.newton_steps)) require(report.newton, residual, next.temperature);
  book(residual, stage.dt, next.enthalpy);
  if (!changed.empty()) book_exchange(changed, stage.dt, next.enthalpy, residual);
  report.balance = balance({old.temperature, std::move(from)}, next, residual,
                           parts_->truncated_newton->moved(), stage.dt);
  if (!pass.adiabatic) report.channels = channel_readings(stage.dt);
  return report;
}

/// Solves the balance of a stage from H* of `from`. Where surfaces see each other, what falls on them follows
/// from the temperatures that it makes, and so does the fluid of channels: both are found by fixed-point
/// iteration. Returns what the last iteration's exchange brings the nodes beyond the one that they were
/// solved with, [owned node] [W]; empty where there is none of it.
std::vector<double> ThermalPhase::solve_balance(const std::vector<double>& from, double dt,
                                                const ThermalState& before, const ThermalState& old,
                                                const ThermalPass& pass, ThermalState& next,
                                                ThermalReport& report) {
  HeatParts& parts = parts_->system->parts();
  const bool follows = (parts.enclosed.any() || parts.channels.any()) && !pass.adiabatic;
  std::vector<double> changed(follows ? as_size(parts_->mesh.n_owned_nodes) : 0);
  if (follows) begin_exchange(parts_->system->parts(), next.temperature);
  for (int iteration = 1; iteration <= k_most_radiation_iterations; ++iteration) {
    // Each one starts from the temperatures of the one before; Newton's iterations of all count together.
    const ConductionBounds bounds = limit_conduction(before, old, pass.keeps_limits);
    const linear::NewtonReport newton_before = std::move(report.newton);
    report.newton =
        parts_->truncated_newton->solve(from, dt, next.temperature, next.enthalpy, bounds, pass.newton_steps);
    if (iteration > 1) report.newton.add_solves(newton_before);
    if (!follows) return changed;
    require_positive(next.temperature);
    if (follow_exchange(parts_->system->parts(), next.temperature, k_settled_radiation, k_settled_fluid,
                        changed))
      return changed;
  }
  reject_exchange(k_settled_radiation, k_settled_fluid);
}

/// Adds the last iteration's difference in what surfaces and channels exchange to the heats, so that all of
/// it adds up to zero with what left through the opening. Where the temperature is prescribed, what holds it
/// takes the difference.
void ThermalPhase::book_exchange(std::span<const double> changed, double dt, std::span<double> heat,
                                 std::span<double> residual) const {
  for (std::size_t i = 0; i < changed.size(); ++i)
    if (parts_->system->parts().prescribed.fixed()[i])
      residual[i] -= changed[i];
    else
      heat[i] += dt * changed[i];
  parts_->ghosts.update(heat, 1);
}

/// H* of a stage: H_n + carried (H − H_n) with the H of `before`.
ThermalState ThermalPhase::stage_start(const ThermalState& old, const ThermalState& before,
                                       const linear::RungeKuttaStage& stage) {
  ThermalState from = old;
  if (stage.carried != 0)
    for (std::size_t i = 0; i < from.enthalpy.size(); ++i)
      from.enthalpy[i] += stage.carried * (before.enthalpy[i] - old.enthalpy[i]);
  return from;
}

// Computes the heat flow into the nodes: the heat that they have taken up, less that from contributions that
// store heat.
std::vector<double> ThermalPhase::flow(const ThermalState& from, const ThermalState& next,
                                       const linear::RungeKuttaStage& stage) const {
  std::vector<double> flow(as_size(parts_->mesh.n_owned_nodes));
  for (std::size_t i = 0; i < flow.size(); ++i) flow[i] = (next.enthalpy[i] - from.enthalpy[i]) / stage.dt;
  const std::span<const double> stored = parts_->system->parts().contributions.stored();
  for (std::size_t i = 0; i < stored.size(); ++i) flow[i] += stored[i];
  return flow;
}

ThermalState ThermalPhase::start(const ThermalState& old, const LoadWindow& loads, bool all) {
  parts_->system->set_window(loads);
  ThermalState next{old.temperature, old.enthalpy};
  parts_->system->parts().prescribed.prescribe(next.temperature);
  if (parts_->nodal())
    for (Index i = 0; i < parts_->mesh.n_owned_nodes; ++i)
      if (all || parts_->system->parts().prescribed.fixed()[as_size(i)])
        next.enthalpy[as_size(i)] =
            std::clamp(old.enthalpy[as_size(i)], parts_->storage->lower(i, next.temperature[as_size(i)]),
                       parts_->storage->upper(i, next.temperature[as_size(i)]));
  return next;
}

/// Starts the iteration from heats instead of temperatures, where it is free.
void ThermalPhase::start_from(std::span<const double> heat, ThermalState& next) const {
  for (std::size_t i = 0; i < as_size(parts_->mesh.n_owned_nodes); ++i) {
    if (parts_->system->parts().prescribed.fixed()[i]) continue;
    next.enthalpy[i] = heat[i];
    next.temperature[i] = parts_->storage->temperature(as_index(i), heat[i]);
  }
  parts_->ghosts.update(next.enthalpy, 1);
  parts_->ghosts.update(next.temperature, 1);
}

/// Limits conduction for a stage from `before`, with the prescribed temperatures of the time set; returns the
/// range of its temperatures, of those at t_n and of those around.
ConductionBounds ThermalPhase::limit_conduction(const ThermalState& before, const ThermalState& old,
                                                bool keep) {
  std::vector<double> temperature = before.temperature;
  parts_->system->parts().prescribed.prescribe(temperature);
  if (!keep) {
    parts_->system->limits().use(parts_->options.bounds);
    parts_->system->limits().release();  // the limits follow from the state alone
    parts_->system->limits().find(temperature);
  }
  TemperatureRange start;
  for (std::size_t i = 0; i < as_size(parts_->mesh.n_owned_nodes); ++i) {
    start.lowest = std::min({start.lowest, temperature[i], old.temperature[i]});
    start.highest = std::max({start.highest, temperature[i], old.temperature[i]});
  }
  start = {parallel::global_min(start.lowest), parallel::global_max(start.highest)};
  const TemperatureRange around = parts_->system->limits().ambient();
  return {{std::min(start.lowest, around.lowest), std::max(start.highest, around.highest)}, start, keep};
}

void ThermalPhase::begin_stage(const linear::RungeKuttaStage& stage, std::span<const double> before) {
  for (linear::Contribution* contribution : parts_->contributions) contribution->begin_stage(stage, before);
}

void ThermalPhase::book(std::span<const double> residual, double dt, std::span<double> heat) const {
  for (std::size_t i = 0; i < residual.size(); ++i)
    if (!parts_->system->parts().prescribed.fixed()[i]) heat[i] -= dt * residual[i];
  parts_->ghosts.update(heat, 1);
}

std::vector<double> flow_at_end(const ThermalPhase& phase, const StageFlows& flows) {
  std::vector<double> flow = flows.last;
  flow.resize(phase.parts().mesh.x.size());
  phase.parts().ghosts.update(flow, 1);
  return flow;
}

std::vector<double> time_error(ThermalPhase& phase, const ThermalState& now, const StageFlows& flows,
                               std::span<const double> flow_before) {
  phase.parts().system->parts().exchanges = true;
  phase.parts().system->set_window(LoadWindow::over(flows.time - flows.last_share * flows.dt, flows.time));
  return (*phase.parts().spread)(heat::time_error(flows, flow_before), now.temperature,
                                 flows.last_share * flows.dt);
}

std::vector<double> change_in_kelvin(const ThermalPhase& phase, const ThermalState& a,
                                     const ThermalState& b) {
  std::vector<double> heat(as_size(phase.parts().mesh.n_owned_nodes));
  for (std::size_t i = 0; i < heat.size(); ++i) heat[i] = b.enthalpy[i] - a.enthalpy[i];
  return phase.parts().spread->at_once(heat, b.temperature);
}

}  // namespace solidus::heat
