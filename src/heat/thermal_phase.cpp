#include "heat/thermal_phase.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <stdexcept>

#include "heat/consistent_heat.hpp"
#include "heat/extrapolation_guard.hpp"
#include "heat/heat_solver.hpp"
#include "heat/heat_spread.hpp"
#include "heat/heat_system.hpp"
#include "heat/nodal_enthalpy.hpp"
#include "heat/point_storage.hpp"
#include "heat/printed_heat.hpp"
#include "heat/temperature_system.hpp"
#include "heat/thermal_iteration.hpp"
#include "heat/truncated_newton.hpp"
#include "heat/worst_node.hpp"
#include "material/time_integration.hpp"
#include "system/errors.hpp"
#include "system/log.hpp"

namespace solidus::heat {

namespace {

using material::k_sdirk_carried;
using material::k_sdirk_share;

constexpr int k_one_component[] = {1};
constexpr double k_counted_from = 293.15;  ///< heat contents [K]

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

/// A pass of so many Newton steps has taken them.
bool may_end(const linear::NewtonReport& report, int newton_steps) {
  return newton_steps > 0 && report.out_of_iterations;
}

/// Of the steady state: how often the limits of conduction are found anew, and the change of flows by them,
/// over the heat moved, that stays out.
constexpr int k_steady_revisions = 20;
constexpr double k_limit_change = 1e-6;

void add_iterations(linear::NewtonReport& report, linear::NewtonReport last) {
  last.iterations += report.iterations;
  last.linear_iterations += report.linear_iterations;
  report = std::move(last);
}

/// Adds the last stage: total = last + carried × first, of all that counts in joules.
void add_stage(PhaseReport& report, double carried, PhaseReport& last) {
  HeatBalance& first = report.balance;
  HeatBalance& sum = last.balance;
  sum.stored += carried * first.stored;
  sum.exchanged += carried * first.exchanged;
  sum.entropy_in += carried * first.entropy_in;
  for (std::size_t i = 0; i < sum.conditions.size(); ++i)
    sum.conditions[i].heat += carried * first.conditions[i].heat;
  for (std::size_t i = 0; i < sum.contributions.size(); ++i)
    sum.contributions[i] += carried * first.contributions[i];
  last.newton.iterations += report.newton.iterations;
  last.newton.linear_iterations += report.newton.linear_iterations;
  last.hardest = std::max(last.hardest, report.hardest);
  report = std::move(last);
}

}  // namespace

ThermalPhase::ThermalPhase(const mesh::Mesh& mesh, AnalysisKind kind,
                           const std::vector<material::Material>& materials, const Conditions& conditions,
                           HeatOptions options, std::vector<linear::Contribution*> contributions)
    : mesh_(mesh),
      kind_(kind),
      options_(options),
      materials_(materials),
      contributions_(std::move(contributions)),
      ghosts_(mesh) {
  assert(materials.size() == mesh.bodies.size());
  const bool closed = options_.integration == Integration::closed;
  storage_ = std::make_unique<NodalEnthalpy>(mesh, kind, materials_);
  const bool nodal = closed || storage_->has_plateaus();
  std::vector<char> kept, others;
  for (int body = 0; body < static_cast<int>(materials_.size()); ++body) {
    kept.push_back(at_nodes(body));
    others.push_back(!at_nodes(body));
  }
  if (nodal && std::count(others.begin(), others.end(), 1) > 0) {
    at_nodes_ = std::make_unique<NodalEnthalpy>(*storage_);
    at_nodes_->keep_bodies(kept);
    NodalEnthalpy of_others = *storage_;
    of_others.keep_bodies(others);
    consistent_ = std::make_unique<ConsistentHeat>(mesh, points_, std::move(of_others));
  }
  if (nodal && options_.sensible != SensibleForm::enthalpy) {
    printed_ = std::make_unique<PrintedHeat>(at_nodes_ ? *at_nodes_ : *storage_, options_.sensible);
    contributions_.push_back(printed_.get());
  }
  if (consistent_) contributions_.push_back(consistent_.get());
  system_ = std::make_unique<HeatSystem>(
      mesh, kind, materials_, conditions, closed, contributions_,
      options_.alone ? HeatSolver::storage_for(mesh, options_.solver, options_.symmetric)
                     : linear::BlockMatrix::Storage::whole);
  solver_ =
      std::make_unique<HeatSolver>(mesh, options_.solver, options_.symmetric, options_.linear_tolerance);
  if (nodal) {
    std::vector<char> relaxed;
    const auto one = [](const material::Material&) { return 1.0; };
    if (at_nodes_)
      for (Index i = 0; i < mesh.n_owned_nodes; ++i)
        relaxed.push_back(at_nodes_->sum(i, one) == storage_->sum(i, one) ? 1 : 0);
    truncated_newton_ = std::make_unique<TruncatedNewton>(
        mesh, *system_, *storage_, *solver_, ghosts_,
        TruncatedNewtonOptions{options_.tolerance > 0 ? options_.tolerance : k_nodal_tolerance,
                               options_.max_iterations},
        std::move(relaxed));
  }
  for (const mesh::Block& block : mesh.blocks) {
    if (at_nodes(block.body)) continue;
    points_.push_back(store_at_points(block));
    points_.back()->bind(system_->matrix());
  }
  temperature_system_ = std::make_unique<TemperatureSystem>(mesh, *system_, ghosts_, points_);
  spread_ = std::make_unique<HeatSpread>(*system_, *storage_, ghosts_);
  reactions_.assign(at(mesh.n_owned_nodes), 0.0);
}

ThermalPhase::~ThermalPhase() = default;

std::unique_ptr<PointStorage> ThermalPhase::store_at_points(const mesh::Block& block) const {
  return make_point_storage(mesh_, block, kind_, materials_[at(block.body)], options_.sensible,
                            options_.open_degree);
}

bool ThermalPhase::at_nodes(int body) const {
  return options_.integration == Integration::closed || materials_[at(body)].changes_isothermally();
}

std::unique_ptr<ThermalIteration> ThermalPhase::iteration() {
  return std::make_unique<ThermalIteration>(*this);
}

CarriedHeat ThermalPhase::set_conditions(const Conditions& conditions, ThermalState* state,
                                         const std::function<double(Index, int)>& fresh) {
  const linear::ActiveSet before = system_->active(), now(mesh_, conditions.absent_bodies);
  for (int body = 0; body < static_cast<int>(materials_.size()); ++body)
    if (now.body(body) && !before.body(body) && !fresh)
      throw std::invalid_argument("a body that comes back needs its heat");
  if (!system_->set_conditions(conditions)) {
    solver_->forget();
    return {};
  }
  CarriedHeat carried;
  if (state != nullptr) carried.away = take_out(now, *state);
  change_bodies(before);
  if (state != nullptr && fresh) carried.along = put_in(before, fresh, *state);
  solver_->reset();
  return carried;
}

const linear::ActiveSet& ThermalPhase::active() const {
  return system_->active();
}

/// Takes the heat of the bodies that are not there out of the nodes that hold it.
double ThermalPhase::take_out(const linear::ActiveSet& active, ThermalState& state) const {
  double carried = 0;
  for (Index i = 0; i < mesh_.n_owned_nodes; ++i) {
    const double heat = heat_at(state, i), cold = storage_->upper(i, k_counted_from);
    const double left = storage_->held_by(active, i, heat, state.temperature[at(i)]);
    carried += heat - left - (cold - storage_->held_by(active, i, cold, k_counted_from));
    if (!state.enthalpy.empty()) state.enthalpy[at(i)] = left;
  }
  if (options_.integration == Integration::closed) ghosts_.update(state.enthalpy, 1);
  return parallel::global_sum(carried);
}

/// Adds the heat of bodies that have come back to their nodes, whose temperatures follow; other nodes keep
/// theirs to the last bit.
double ThermalPhase::put_in(const linear::ActiveSet& before, const std::function<double(Index, int)>& fresh,
                            ThermalState& state) const {
  double carried = 0;
  for (Index i = 0; i < mesh_.n_owned_nodes; ++i) {
    bool any = false;
    double kept = 0;  // with the open rule the heat of bodies that were there follows from the temperature
    const double heat = storage_->sum_of_bodies(i, [&](int body) {
      if (before.body(body)) {
        kept += storage_->volume(i, body) * storage_->body_enthalpy(body, state.temperature[at(i)]);
        return 0.0;
      }
      any = true;
      return fresh(i, body);
    });
    if (!any) continue;
    carried += heat - storage_->sum_of_bodies(i, [&](int body) {
      return before.body(body) ? 0.0 : storage_->body_enthalpy(body, k_counted_from);
    });
    const double all = heat + (state.enthalpy.empty() ? kept : state.enthalpy[at(i)]);
    if (!state.enthalpy.empty()) state.enthalpy[at(i)] = all;
    state.temperature[at(i)] = storage_->temperature(i, all);
  }
  ghosts_.update(state.temperature, 1);
  if (nodal()) ghosts_.update(state.enthalpy, 1);
  return parallel::global_sum(carried);
}

double ThermalPhase::heat_content(const ThermalState& state) const {
  double content = 0;
  for (Index i = 0; i < mesh_.n_owned_nodes; ++i)
    content += heat_at(state, i) - storage_->upper(i, k_counted_from);
  return parallel::global_sum(content);
}

void ThermalPhase::change_bodies(const linear::ActiveSet& before) {
  const linear::ActiveSet& now = system_->active();
  storage_->set_active(now);
  if (at_nodes_) at_nodes_->set_active(now);
  if (consistent_) consistent_->set_active(now);
  if (options_.integration == Integration::closed) return;
  std::vector<std::unique_ptr<PointStorage>> left;
  auto points = points_.begin();
  for (const mesh::Block& block : mesh_.blocks) {
    if (at_nodes(block.body)) continue;
    std::unique_ptr<PointStorage> had = before.body(block.body) ? std::move(*points++) : nullptr;
    if (now.body(block.body)) left.push_back(had ? std::move(had) : store_at_points(block));
  }
  points_ = std::move(left);
  for (const auto& block : points_) block->bind(system_->matrix());
  temperature_system_ = std::make_unique<TemperatureSystem>(mesh_, *system_, ghosts_, points_);
}

bool ThermalPhase::follow_graph() {
  if (!system_->follow_graph()) return false;
  for (const auto& block : points_) block->bind(system_->matrix());
  solver_->reset();
  return true;
}

void ThermalPhase::forget() {
  solver_->forget();
}

ThermalState ThermalPhase::initial_state(std::span<const double> body_temperature) const {
  assert(body_temperature.size() == mesh_.bodies.size());
  std::vector<double> enthalpy;
  for (std::size_t b = 0; b < body_temperature.size(); ++b)
    enthalpy.push_back(storage_->body_enthalpy(static_cast<int>(b), body_temperature[b]));
  return initial_state_of([&](Index, int body) { return enthalpy[at(body)]; });
}

ThermalState ThermalPhase::initial_state_of(const std::function<double(Index, int)>& enthalpy) const {
  ThermalState state;
  state.temperature.resize(mesh_.x.size());
  state.enthalpy.resize(mesh_.x.size());
  for (Index i = 0; i < mesh_.n_owned_nodes; ++i) {
    state.enthalpy[at(i)] = storage_->sum_of_bodies(i, [&](int body) { return enthalpy(i, body); });
    state.temperature[at(i)] = storage_->temperature(i, state.enthalpy[at(i)]);
  }
  ghosts_.update(state.temperature, 1);
  ghosts_.update(state.enthalpy, 1);
  if (!nodal()) state.enthalpy.clear();
  return state;
}

ThermalState ThermalPhase::initial_state_at_nodes(std::span<const double> temperature) const {
  ThermalState state{{temperature.begin(), temperature.end()}, {}};
  if (!nodal()) return state;
  state.enthalpy.resize(mesh_.x.size());
  for (Index i = 0; i < mesh_.n_owned_nodes; ++i)
    state.enthalpy[at(i)] = storage_->upper(i, temperature[at(i)]);
  ghosts_.update(state.enthalpy, 1);
  return state;
}

ThermalState ThermalPhase::start(const ThermalState& old, double time) {
  system_->set_time(time);
  ThermalState next{old.temperature, old.enthalpy};
  system_->prescribe(next.temperature);
  if (nodal())
    for (Index i = 0; i < mesh_.n_owned_nodes; ++i)
      next.enthalpy[at(i)] = std::clamp(old.enthalpy[at(i)], storage_->lower(i, next.temperature[at(i)]),
                                        storage_->upper(i, next.temperature[at(i)]));
  return next;
}

void ThermalPhase::begin_burning(const BurningState& state, double begin, double end) {
  system_->set_burning(state, begin, end);
}

BurningState ThermalPhase::burnt(const BurningState& state, const ThermalState& before,
                                 const ThermalState& after, double begin, double end) const {
  if (state.lit.empty() || system_->ignition().empty()) return state;
  return burn(state, system_->ignition(), before.temperature, after.temperature, begin, end);
}

PhaseReport ThermalPhase::solve(const ThermalState& old, ThermalState& trial, const ThermalPass& pass) {
  assert(old.temperature.size() == mesh_.x.size() && pass.dt > 0);
  follow_graph();
  solver_->begin(true);
  system_->exchange(!pass.adiabatic);
  ThermalState next;
  PhaseReport report;
  // An adiabatic pass keeps the known flow of the step.
  if (!pass.adiabatic) flows_ = {};
  const bool flows = nodal() && !pass.adiabatic;
  if (pass.stepping == ThermalStepping::sdirk2) {
    report = solve_two_stages(old, pass, next);
  } else {
    report = solve_stage(old, old, {pass.dt}, pass, next);
    if (flows) flows_.last = flow(old, next, {pass.dt});
  }
  if (!pass.adiabatic) flows_.dt = flows ? pass.dt : 0;
  trial = std::move(next);
  return report;
}

/// SDIRK2; its second stage is backward Euler over the rest of the step where H* is no place to start from.
PhaseReport ThermalPhase::solve_two_stages(const ThermalState& old, const ThermalPass& pass,
                                           ThermalState& next) {
  const linear::Stage first{k_sdirk_share * pass.dt, 0}, extrapolated{first.dt, k_sdirk_carried},
      rest{pass.dt - first.dt, 1};
  const bool flows = nodal() && !pass.adiabatic;
  ThermalState middle;
  PhaseReport report = solve_stage(
      old, old, first, {pass.time - pass.dt + first.dt, pass.dt, pass.iterate, pass.newton_steps}, middle);
  if (flows) flows_.first = flow(old, middle, first);
  std::optional<ExtrapolationGuard> guard;
  bool second_order = true;
  if (flows && pass.within_range && options_.integration == Integration::closed) {
    TemperatureRange around = system_->surroundings();
    system_->set_time(pass.time);
    const TemperatureRange at_end = system_->surroundings();
    around = {std::min(around.lowest, at_end.lowest), std::max(around.highest, at_end.highest)};
    guard.emplace(*system_, *storage_, old, middle);
    second_order = !guard->leaves_range(around);
  }
  const ThermalPass to_end{pass.time, pass.dt, pass.iterate, pass.newton_steps};
  PhaseReport last = solve_stage(old, middle, second_order ? extrapolated : rest, to_end, next);
  if (second_order && guard && guard->turns_back(next, ghosts_)) {
    second_order = false;
    begin_stage(first, old.temperature);
    PhaseReport again = solve_stage(old, middle, rest, to_end, next);
    again.newton.iterations += last.newton.iterations;
    again.newton.linear_iterations += last.newton.linear_iterations;
    again.hardest = std::max(again.hardest, last.hardest);
    last = std::move(again);
  }
  if (!second_order)
    logging::debug("heat: the step to t = {:g} s would overshoot; it is of first order", pass.time);
  const linear::Stage& stage = second_order ? extrapolated : rest;
  if (flows) flows_.last = flow(stage_start(old, middle, stage), next, stage);
  flows_.second_order = second_order;
  flows_.share = k_sdirk_share;
  flows_.last_share = stage.dt / pass.dt;
  add_stage(report, stage.carried, last);
  set_latent(report.balance, old, next);
  return report;
}

/// H* of a stage: H_n + carried (H − H_n) with the H of `before`.
ThermalState ThermalPhase::stage_start(const ThermalState& old, const ThermalState& before,
                                       const linear::Stage& stage) {
  ThermalState from = old;
  if (stage.carried != 0)
    for (std::size_t i = 0; i < from.enthalpy.size(); ++i)
      from.enthalpy[i] += stage.carried * (before.enthalpy[i] - old.enthalpy[i]);
  return from;
}

// Computes the heat flow into the nodes: the heat that they have taken up, less that from contributions that
// store heat.
std::vector<double> ThermalPhase::flow(const ThermalState& from, const ThermalState& next,
                                       const linear::Stage& stage) const {
  std::vector<double> flow(reactions_.size());
  for (std::size_t i = 0; i < flow.size(); ++i) flow[i] = (next.enthalpy[i] - from.enthalpy[i]) / stage.dt;
  const std::span<const double> stored = system_->stored_by_contributions();
  for (std::size_t i = 0; i < stored.size(); ++i) flow[i] += stored[i];
  return flow;
}

std::vector<double> ThermalPhase::last_flow() const {
  std::vector<double> flow = flows_.last;
  flow.resize(mesh_.x.size());
  ghosts_.update(flow, 1);
  return flow;
}

std::vector<double> ThermalPhase::time_error(const ThermalState& now, std::span<const double> flow_before) {
  system_->exchange(true);  // an adiabatic pass may have been the last one
  return (*spread_)(heat::time_error(flows_, flow_before), now.temperature, flows_.last_share * flows_.dt);
}

std::vector<double> ThermalPhase::change_in_kelvin(const ThermalState& a, const ThermalState& b) const {
  std::vector<double> heat(reactions_.size());
  for (std::size_t i = 0; i < heat.size(); ++i) heat[i] = b.enthalpy[i] - a.enthalpy[i];
  return spread_->at_once(heat, b.temperature);
}

/// From H* = H_n + carried (H − H_n) with the H of `before`, which is the state at t_n in the first stage.
PhaseReport ThermalPhase::solve_stage(const ThermalState& old, const ThermalState& before,
                                      const linear::Stage& stage, const ThermalPass& pass,
                                      ThermalState& next) {
  begin_stage(stage, before.temperature);
  next = start(pass.iterate != nullptr ? *pass.iterate : before, pass.time);
  PhaseReport report;
  if (!nodal()) {
    for (const auto& block : points_) {
      block->start(old.temperature, stage.dt);
      if (stage.carried != 0) block->extrapolate(before.temperature, stage.carried);
    }
    temperature_system_->use_storage(true);
    report.newton = solve_temperature(next.temperature, pass.newton_steps);
    report.hardest = report.newton.iterations;
    report.balance = balance(old, next, reactions_, temperature_system_->moved(), stage.dt);
    return report;
  }
  const ThermalState from = stage_start(old, before, stage);
  // H* itself lies so far ahead at a front that the iteration begins half way to it.
  if (stage.carried != 0 && pass.iterate == nullptr)
    start_from(stage_start(old, before, {stage.dt, 0.5 * (1 + stage.carried)}).enthalpy, next);
  const TemperatureRange range = limit_conduction(before, old);
  report.newton = truncated_newton_->solve(from.enthalpy, stage.dt, next.temperature, next.enthalpy, range,
                                           pass.newton_steps);
  report.hardest = report.newton.iterations;
  require_positive(next.temperature);
  if (!may_end(report.newton, pass.newton_steps))
    require(report.newton, truncated_newton_->residual(), next.temperature);
  book(truncated_newton_->residual(), stage.dt, next.enthalpy);
  report.balance = balance(from, next, truncated_newton_->residual(), truncated_newton_->moved(), stage.dt);
  return report;
}

/// Limits conduction for a stage from `before`, with the prescribed temperatures of the time set; returns the
/// range of its temperatures, of those at t_n and of those around.
TemperatureRange ThermalPhase::limit_conduction(const ThermalState& before, const ThermalState& old) {
  system_->limit(options_.bounds);
  system_->release_nodes();  // the limits follow from the state alone
  std::vector<double> temperature = before.temperature;
  system_->prescribe(temperature);
  system_->find_limits(temperature);
  TemperatureRange range = system_->ambient_range();
  for (std::size_t i = 0; i < reactions_.size(); ++i) {
    range.lowest = std::min({range.lowest, temperature[i], old.temperature[i]});
    range.highest = std::max({range.highest, temperature[i], old.temperature[i]});
  }
  return {parallel::global_min(range.lowest), parallel::global_max(range.highest)};
}

/// Starts the iteration from heats instead of temperatures, where it is free.
void ThermalPhase::start_from(std::span<const double> heat, ThermalState& next) const {
  for (std::size_t i = 0; i < reactions_.size(); ++i) {
    if (system_->fixed()[i]) continue;
    next.enthalpy[i] = heat[i];
    next.temperature[i] = storage_->temperature(static_cast<Index>(i), heat[i]);
  }
  ghosts_.update(next.enthalpy, 1);
  ghosts_.update(next.temperature, 1);
}

TemperatureRange ThermalPhase::ambient_range(bool with_contributions) const {
  return system_->ambient_range(with_contributions);
}

void ThermalPhase::book(std::span<const double> residual, double dt, std::span<double> heat) const {
  for (std::size_t i = 0; i < residual.size(); ++i)
    if (!system_->fixed()[i]) heat[i] -= dt * residual[i];
  ghosts_.update(heat, 1);
}

void ThermalPhase::begin_stage(const linear::Stage& stage, std::span<const double> before) {
  for (linear::Contribution* contribution : contributions_) contribution->begin_stage(stage, before);
}

HeatBalance ThermalPhase::balance(const ThermalState& old, const ThermalState& next,
                                  std::span<const double> residual, double moved, double dt) {
  keep_reactions(residual);
  HeatBalance balance = measure(next.temperature, dt);
  double stored = 0;
  if (nodal()) {
    for (std::size_t i = 0; i < reactions_.size(); ++i) stored += next.enthalpy[i] - old.enthalpy[i];
    if (consistent_) stored += consistent_->stored(next.temperature);
  } else {
    for (const auto& block : points_) stored += block->stored(next.temperature);
  }
  balance.stored = parallel::global_sum(stored);
  set_latent(balance, old, next);
  balance.exchanged = moved * dt;
  return balance;
}

/// Splits the stored heat.
void ThermalPhase::set_latent(HeatBalance& balance, const ThermalState& old, const ThermalState& next) const {
  double latent = 0;
  if (!nodal()) {
    for (const auto& block : points_) latent += block->latent(old.temperature, next.temperature);
  } else {
    if (consistent_) latent += consistent_->latent(old.temperature, next.temperature);
    for (Index i = 0; i < mesh_.n_owned_nodes; ++i)
      latent += storage_->latent(i, next.enthalpy[at(i)], next.temperature[at(i)]) -
                storage_->latent(i, old.enthalpy[at(i)], old.temperature[at(i)]);
  }
  balance.latent = parallel::global_sum(latent);
  balance.sensible = balance.stored - balance.latent;
}

PhaseReport ThermalPhase::solve_steady(const ThermalState& start, ThermalState& trial, double time) {
  assert(start.temperature.size() == mesh_.x.size());
  follow_graph();
  system_->set_time(time);
  system_->exchange(true);
  solver_->begin(false);
  std::vector<double> temperature = start.temperature;
  system_->prescribe(temperature);
  temperature_system_->use_storage(false);
  if (consistent_) consistent_->use(false);
  PhaseReport report;
  const TemperatureRange range = limit_conduction({temperature, {}}, start);
  system_->clear_limits();  // a linear field, say, needs none
  report.newton = solve_temperature(temperature);
  const double moved = temperature_system_->moved();
  for (int i = 0; i < k_steady_revisions && system_->find_limits(temperature, k_limit_change * moved); ++i)
    add_iterations(report.newton, solve_temperature(temperature));
  for (int i = 0;
       i < k_steady_revisions && system_->hold_nodes(temperature, range) == ConductionLimiter::Held::further;
       ++i) {
    system_->find_limits(temperature);
    add_iterations(report.newton, solve_temperature(temperature));
  }
  report.balance = measure(temperature, 1.0);
  report.balance.exchanged = temperature_system_->moved();
  trial = initial_state_at_nodes(temperature);
  return report;
}

linear::NewtonReport ThermalPhase::solve_temperature(std::span<double> temperature, int newton_steps) {
  std::vector<double> r(reactions_.size());
  temperature_system_->residual(temperature, r);
  temperature_system_->tangent();
  linear::NewtonOptions newton;
  newton.tolerance = options_.tolerance > 0 ? options_.tolerance : k_point_tolerance;
  newton.inexact = false;  // an iteration costs as much as 25 of the linear solver, which takes as many
  newton.absolute_tolerance = temperature_system_->round_off();
  newton.max_iterations = newton_steps > 0 ? newton_steps : options_.max_iterations;
  const linear::NewtonReport report =
      linear::newton(*temperature_system_, *temperature_system_->solver(solver_->strong()), ghosts_,
                     k_one_component, temperature, newton);
  temperature_system_->residual(temperature, r);
  require_positive(temperature);
  if (!may_end(report, newton_steps)) require(report, r, temperature);
  keep_reactions(r);
  return report;
}

void ThermalPhase::keep_reactions(std::span<const double> residual) {
  for (std::size_t i = 0; i < reactions_.size(); ++i) reactions_[i] = system_->fixed()[i] ? residual[i] : 0.0;
}

/// Heat through conditions and contributions at the last residual.
HeatBalance ThermalPhase::measure(std::span<const double> temperature, double dt) const {
  HeatBalance balance;
  double entropy = system_->entropy_power(temperature);
  for (std::size_t i = 0; i < reactions_.size(); ++i) entropy += reactions_[i] / temperature[i];
  balance.entropy_in = parallel::global_sum(entropy) * dt;
  for (const auto& [name, power] : system_->reaction_powers(reactions_))
    balance.conditions.push_back({name, power * dt});
  for (const auto& [name, power] : system_->powers()) balance.conditions.push_back({name, power * dt});
  for (double power : system_->contribution_powers()) balance.contributions.push_back(power * dt);
  if (consistent_) balance.contributions.pop_back();  // no heat, but stored in another place
  if (printed_) balance.contributions.pop_back();     // no heat, but what a printed form loses
  return balance;
}

void ThermalPhase::require(const linear::NewtonReport& report, std::span<const double> residual,
                           std::span<const double> temperature) const {
  if (report.converged) return;
  WorstNode worst;
  for (std::size_t i = 0; i < residual.size(); ++i)
    if (!system_->fixed()[i]) worst.look(i, std::abs(residual[i]));
  throw StepRejected("heat: " + report.reason, worst.text(mesh_, temperature, residual));
}

void ThermalPhase::require_positive(std::span<const double> temperature) const {
  WorstNode coldest;
  for (std::size_t i = 0; i < reactions_.size(); ++i) coldest.look(i, -temperature[i]);
  const double lowest = -parallel::global_max(coldest.size);
  if (lowest > 0) return;
  throw StepRejected(std::isfinite(lowest) ? fmt::format("heat: the temperature falls to {:.4g} K", lowest)
                                           : "heat: the temperature is not a number",
                     coldest.text(mesh_, temperature, {}));
}

double ThermalPhase::heat_at(const ThermalState& state, Index node) const {
  return state.enthalpy.empty() ? storage_->upper(node, state.temperature[at(node)])
                                : state.enthalpy[at(node)];
}

std::vector<double> ThermalPhase::plateau_share(const ThermalState& state) const {
  if (!storage_->has_plateaus()) return {};
  std::vector<double> share(mesh_.x.size());
  for (Index i = 0; i < mesh_.n_owned_nodes; ++i)
    share[at(i)] = storage_->plateau_share(i, heat_at(state, i), state.temperature[at(i)]);
  ghosts_.update(share, 1);
  return share;
}

std::vector<double> ThermalPhase::solid_fraction(const ThermalState& state) const {
  std::vector<double> fraction(mesh_.x.size());
  for (Index i = 0; i < mesh_.n_owned_nodes; ++i)
    fraction[at(i)] = storage_->solid_fraction(i, heat_at(state, i), state.temperature[at(i)]);
  ghosts_.update(fraction, 1);
  return fraction;
}

double ThermalPhase::mean_solid_fraction(const ThermalState& state, int body) const {
  double solid = 0, volume = 0;
  for (Index i = 0; i < mesh_.n_owned_nodes; ++i) {
    volume += storage_->volume(i, body);
    solid += storage_->solid_volume(i, body, heat_at(state, i), state.temperature[at(i)]);
  }
  return parallel::global_sum(solid) / parallel::global_sum(volume);
}

double ThermalPhase::mean_solid_fraction(const ThermalState& state) const {
  double solid = 0, volume = 0;
  for (std::size_t b = 0; b < materials_.size(); ++b) {
    const auto body = static_cast<int>(b);
    if (!storage_->can_melt(body)) continue;
    for (Index i = 0; i < mesh_.n_owned_nodes; ++i) {
      volume += storage_->volume(i, body);
      solid += storage_->solid_volume(i, body, heat_at(state, i), state.temperature[at(i)]);
    }
  }
  volume = parallel::global_sum(volume);
  solid = parallel::global_sum(solid);
  return volume > 0 ? solid / volume : 1.0;
}

EntropyChange ThermalPhase::entropy_change(const ThermalState& from, const ThermalState& to) const {
  EntropyChange sum;
  const auto add = [&sum](const EntropyChange& part) {
    sum.change += part.change;
    sum.magnitude += part.magnitude;
  };
  if (!nodal()) {
    for (const auto& block : points_) add(block->entropy_change(from.temperature, to.temperature));
  } else {
    if (consistent_) add(consistent_->entropy_change(from.temperature, to.temperature));
    for (Index i = 0; i < mesh_.n_owned_nodes; ++i) {
      const double before = storage_->entropy(i, from.enthalpy[at(i)], from.temperature[at(i)]);
      const double after = storage_->entropy(i, to.enthalpy[at(i)], to.temperature[at(i)]);
      add({after - before, std::abs(before)});
    }
  }
  return {parallel::global_sum(sum.change), parallel::global_sum(sum.magnitude)};
}

double ThermalPhase::enthalpy(const ThermalState& state) const {
  double sum = 0;
  if (!nodal()) {
    for (const auto& block : points_) sum += block->enthalpy(state.temperature);
  } else {
    for (Index i = 0; i < mesh_.n_owned_nodes; ++i) sum += state.enthalpy[at(i)];
    if (consistent_) sum += consistent_->enthalpy(state.temperature);
  }
  return parallel::global_sum(sum);
}

double ThermalPhase::mean_temperature(const ThermalState& state, int body) const {
  double sum = 0, volume = 0;
  for (Index i = 0; i < mesh_.n_owned_nodes; ++i) {
    const double v = storage_->volume(i, body);
    volume += v;
    sum += v * state.temperature[at(i)];
  }
  return parallel::global_sum(sum) / parallel::global_sum(volume);
}

std::size_t ThermalPhase::bytes() const {
  std::size_t total = storage_->bytes() + system_->bytes();
  for (const auto& block : points_) total += block->bytes();
  if (at_nodes_) total += at_nodes_->bytes();
  if (consistent_) total += consistent_->bytes();
  return total;
}

double ThermalPhase::seconds_solver() const {
  return solver_->seconds();
}

}  // namespace solidus::heat
