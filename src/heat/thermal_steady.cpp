/// Newton's iteration of the thermal phase in the temperatures, the steady state by it, and what is refused
/// as a solution.
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "heat/iteration/heat_exchange.hpp"
#include "heat/iteration/heat_rejected.hpp"
#include "heat/iteration/worst_node.hpp"
#include "heat/thermal_parts.hpp"
#include "heat/thermal_phase.hpp"
#include "linear/newton.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "system/errors.hpp"

namespace solidus::heat {

namespace {

constexpr int k_one_component[] = {1};

/// In the steady state the limits of conduction are found again so often at most; a change of flows by them
/// of this share of the heat moved stays out.
constexpr int k_steady_revisions = 20;
constexpr double k_limit_change = 1e-6;

void add_iterations(linear::NewtonReport& report, linear::NewtonReport last) {
  last.add_solves(report);
  report = std::move(last);
}

}  // namespace

ThermalReport ThermalPhase::solve_steady(const ThermalState& start, ThermalState& trial, double time) {
  // A steady state has no storage. The first solution is without limits of conduction, since smooth fields
  // need none.
  assert(start.temperature.size() == parts_->mesh.x.size());
  parts_->follow_graph();
  parts_->system->set_window(LoadWindow::at(time));
  parts_->system->parts().exchanges = true;
  parts_->solver->begin(false);
  std::vector<double> temperature = start.temperature;
  parts_->system->parts().prescribed.prescribe(temperature);
  parts_->temperature_system->use_storage(false);
  if (parts_->consistent) parts_->consistent->use(false);
  ThermalReport report;
  std::vector<double> residual(as_size(parts_->mesh.n_owned_nodes));
  const TemperatureRange range = limit_conduction({temperature, {}}, start).range;
  parts_->system->limits().clear();  // a linear field, say, needs none
  report.newton = solve_steady_balance(temperature, residual);
  const double moved = parts_->temperature_system->moved();
  // Limits are then found and the system solved again until they stay, and nodes that leave the range lose
  // their share.
  for (int i = 0;
       i < k_steady_revisions && parts_->system->limits().find(temperature, k_limit_change * moved); ++i)
    add_iterations(report.newton, solve_steady_balance(temperature, residual));
  for (int i = 0; i < k_steady_revisions &&
                  parts_->system->limits().hold(temperature, range) == HeldNodes::Found::further;
       ++i) {
    parts_->system->limits().find(temperature);
    add_iterations(report.newton, solve_steady_balance(temperature, residual));
  }
  // The balance is that of the last residual.
  report.balance = measure(temperature, residual, 1.0);
  report.balance.exchanged = parts_->temperature_system->moved();
  report.channels = channel_readings(1.0);
  trial = states_.initial_at_nodes(temperature);
  return report;
}

/// The solution of the steady balance, with what surfaces that see each other radiate and the fluid of
/// channels by fixed-point iteration.
linear::NewtonReport ThermalPhase::solve_steady_balance(std::span<double> temperature, std::span<double> r) {
  HeatParts& parts = parts_->system->parts();
  if (!parts.enclosed.any() && !parts.channels.any()) return solve_temperature(temperature, r);
  begin_exchange(parts_->system->parts(), temperature);
  linear::NewtonReport report;
  std::vector<double> left(r.size());
  for (int iteration = 1; iteration <= k_most_radiation_iterations; ++iteration) {
    linear::NewtonReport last = solve_temperature(temperature, r);
    if (iteration > 1)
      add_iterations(report, std::move(last));
    else
      report = std::move(last);
    if (follow_exchange(parts_->system->parts(), temperature, k_settled_steady_radiation,
                        k_settled_steady_fluid, left))
      return report;
  }
  reject_exchange(k_settled_steady_radiation, k_settled_steady_fluid);
}

void ThermalPhase::reject_exchange(double tolerance, double tolerance_of_fluid) {
  throw StepRejected(
      parts_->system->parts().channels.any()
          ? fmt::format(
                "heat: the fluid of the channels has not settled to {:g} K, or radiation to {:g} K, in "
                "{} iterations",
                tolerance_of_fluid, tolerance, k_most_radiation_iterations)
          : fmt::format(
                "heat: what surfaces radiate to each other has not settled to {:g} K in {} iterations",
                tolerance, k_most_radiation_iterations),
      {}, Failure::heat);
}

linear::NewtonReport ThermalPhase::solve_temperature(std::span<double> temperature, std::span<double> r,
                                                     int newton_steps) {
  // The tolerance is that of the open rule; the linear systems are solved far, because an iteration costs as
  // much as many of theirs.
  parts_->temperature_system->residual(temperature, r);
  parts_->temperature_system->tangent(temperature);
  linear::NewtonOptions newton;
  newton.tolerance = parts_->options.tolerance > 0 ? parts_->options.tolerance : k_point_tolerance;
  newton.effort_tolerance = k_point_tolerance;
  newton.inexact = false;  // an iteration costs as much as 25 of the linear solver, which takes as many
  newton.absolute_tolerance = parts_->temperature_system->round_off(temperature);
  newton.max_iterations = newton_steps > 0 ? newton_steps : parts_->options.max_iterations;
  const linear::NewtonReport report = linear::newton(
      *parts_->temperature_system, *parts_->temperature_system->solver(parts_->solver->strong()),
      parts_->ghosts, k_one_component, temperature, newton);
  // The residual is evaluated once more at the solution, since the report of the balance is made of it.
  parts_->temperature_system->residual(temperature, r);
  require_positive(temperature);
  if (!may_end(report, newton_steps)) require(report, r, temperature);
  return report;
}

void ThermalPhase::require(const linear::NewtonReport& report, std::span<const double> residual,
                           std::span<const double> temperature) const {
  if (report.converged) return;
  WorstNode worst;
  for (std::size_t i = 0; i < residual.size(); ++i)
    if (!parts_->system->parts().prescribed.fixed()[i]) worst.look(i, std::abs(residual[i]));
  throw HeatRejected("heat: " + report.reason, worst.text(parts_->mesh, temperature, residual), Failure::heat,
                     temperature, worst.owned());
}

void ThermalPhase::require_positive(std::span<const double> temperature) const {
  WorstNode coldest;
  for (std::size_t i = 0; i < as_size(parts_->mesh.n_owned_nodes); ++i) coldest.look(i, -temperature[i]);
  const double lowest = -parallel::global_max(coldest.size);
  if (lowest > 0) return;
  throw HeatRejected(std::isfinite(lowest) ? fmt::format("heat: the temperature falls to {:.4g} K", lowest)
                                           : "heat: the temperature is not a number",
                     coldest.text(parts_->mesh, temperature, {}), Failure::temperature, temperature,
                     coldest.owned());
}

}  // namespace solidus::heat
