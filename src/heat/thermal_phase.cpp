#include "heat/thermal_phase.hpp"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/errors.hpp"
#include "heat/enthalpy_newton.hpp"
#include "heat/heat_solver.hpp"
#include "heat/heat_system.hpp"
#include "heat/nodal_enthalpy.hpp"
#include "heat/point_storage.hpp"
#include "heat/temperature_system.hpp"
#include "heat/thermal_iteration.hpp"

namespace solidus::heat {

namespace {

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

}  // namespace

ThermalPhase::ThermalPhase(const mesh::Mesh& mesh, AnalysisKind kind,
                           const std::vector<material::Material>& materials, Conditions conditions,
                           HeatOptions options, std::vector<algebra::Contribution*> contributions)
    : mesh_(mesh),
      options_(options),
      materials_(materials),
      contributions_(std::move(contributions)),
      ghosts_(mesh) {
  assert(materials.size() == mesh.bodies.size());
  const bool closed = options_.integration == Integration::closed;
  if (!closed)
    for (material::Material& m : materials_) m = spread_isothermal(std::move(m));
  storage_ = std::make_unique<NodalEnthalpy>(mesh, kind, materials_);
  system_ =
      std::make_unique<HeatSystem>(mesh, kind, materials_, std::move(conditions), closed, contributions_);
  solver_ = std::make_unique<HeatSolver>(
      mesh, options_.solver, options_.symmetric && !options_.exact_conductivity, options_.linear_tolerance);
  if (closed) {
    enthalpy_newton_ = std::make_unique<EnthalpyNewton>(
        mesh, *system_, *storage_, *solver_, ghosts_,
        EnthalpyNewtonOptions{options_.tolerance, options_.max_iterations, options_.exact_conductivity});
  } else {
    for (const mesh::Block& block : mesh.blocks) {
      points_.push_back(
          make_point_storage(mesh, block, kind, materials_[at(block.body)], options_.open_degree));
      points_.back()->bind(system_->matrix());
    }
  }
  temperature_system_ =
      std::make_unique<TemperatureSystem>(mesh, *system_, points_, options_.exact_conductivity);
  reactions_.assign(at(mesh.n_owned_nodes), 0.0);
}

ThermalPhase::~ThermalPhase() = default;

std::unique_ptr<ThermalIteration> ThermalPhase::iteration() {
  return std::make_unique<ThermalIteration>(*this);
}

void ThermalPhase::forget() {
  solver_->forget();
}

ThermalState ThermalPhase::initial_state(std::span<const double> body_temperature) const {
  assert(body_temperature.size() == mesh_.bodies.size());
  ThermalState state;
  state.temperature.resize(mesh_.x.size());
  state.enthalpy.resize(mesh_.x.size());
  for (Index i = 0; i < mesh_.n_owned_nodes; ++i) {
    state.enthalpy[at(i)] = storage_->mixed_heat(i, body_temperature);
    state.temperature[at(i)] = storage_->temperature(i, state.enthalpy[at(i)]);
  }
  ghosts_.update(state.temperature, 1);
  ghosts_.update(state.enthalpy, 1);
  if (options_.integration == Integration::open) state.enthalpy.clear();
  return state;
}

ThermalState ThermalPhase::initial_state_at_nodes(std::span<const double> temperature) const {
  ThermalState state{{temperature.begin(), temperature.end()}, {}};
  if (options_.integration == Integration::open) return state;
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
  if (options_.integration == Integration::closed)
    for (Index i = 0; i < mesh_.n_owned_nodes; ++i)
      if (system_->fixed()[at(i)])
        next.enthalpy[at(i)] = std::clamp(old.enthalpy[at(i)], storage_->lower(i, next.temperature[at(i)]),
                                          storage_->upper(i, next.temperature[at(i)]));
  return next;
}

PhaseReport ThermalPhase::solve(const ThermalState& old, ThermalState& trial, const ThermalPass& pass) {
  const double dt = pass.dt;
  assert(old.temperature.size() == mesh_.x.size() && dt > 0);
  solver_->begin(true);
  ThermalState next = start(pass.iterate != nullptr ? *pass.iterate : old, pass.time);
  PhaseReport report;
  if (options_.integration == Integration::open) {
    for (const auto& block : points_) block->start(old.temperature, dt);
    temperature_system_->use_storage(true);
    report.newton = solve_temperature(next.temperature, pass.newton_steps);
    report.balance = balance(old, next, reactions_, temperature_system_->moved(), dt);
  } else {
    report.newton =
        enthalpy_newton_->solve(old.enthalpy, dt, next.temperature, next.enthalpy, pass.newton_steps);
    require(report.newton, pass.newton_steps, enthalpy_newton_->residual(), next.temperature);
    report.balance = balance(old, next, enthalpy_newton_->residual(), enthalpy_newton_->moved(), dt);
  }
  trial = std::move(next);
  return report;
}

HeatBalance ThermalPhase::balance(const ThermalState& old, const ThermalState& next,
                                  std::span<const double> residual, double moved, double dt) {
  keep_reactions(residual);
  HeatBalance balance = measure(dt);
  double sums[2] = {0, 0};
  if (options_.integration == Integration::open) {
    for (const auto& block : points_) {
      sums[0] += block->stored(next.temperature);
      sums[1] += block->latent(old.temperature, next.temperature);
    }
  } else {
    for (Index i = 0; i < mesh_.n_owned_nodes; ++i) {
      const std::size_t n = at(i);
      sums[0] += next.enthalpy[n] - old.enthalpy[n];
      sums[1] += storage_->latent(i, next.enthalpy[n], next.temperature[n]) -
                 storage_->latent(i, old.enthalpy[n], old.temperature[n]);
    }
  }
  balance.stored = algebra::global_sum(sums[0]);
  balance.latent = algebra::global_sum(sums[1]);
  balance.sensible = balance.stored - balance.latent;
  balance.exchanged = moved * dt;
  return balance;
}

PhaseReport ThermalPhase::solve_steady(const ThermalState& start, ThermalState& trial, double time) {
  assert(start.temperature.size() == mesh_.x.size());
  system_->set_time(time);
  solver_->begin(false);
  std::vector<double> temperature = start.temperature;
  system_->prescribe(temperature);
  temperature_system_->use_storage(false);
  PhaseReport report;
  report.newton = solve_temperature(temperature);
  report.balance = measure(1.0);
  report.balance.exchanged = temperature_system_->moved();
  trial = initial_state_at_nodes(temperature);
  return report;
}

algebra::NewtonReport ThermalPhase::solve_temperature(std::span<double> temperature) {
  std::vector<double> r(reactions_.size());
  temperature_system_->residual(temperature, r);
  temperature_system_->tangent();
  algebra::NewtonOptions newton;
  newton.tolerance = options_.tolerance;
  newton.absolute_tolerance = temperature_system_->round_off();
  newton.max_iterations = options_.max_iterations;
  const algebra::NewtonReport report =
      algebra::newton(*temperature_system_, solver_->strong(), ghosts_, 1, temperature, newton);
  temperature_system_->residual(temperature, r);
  require(report, r, temperature);
  keep_reactions(r);
  return report;
}

void ThermalPhase::keep_reactions(std::span<const double> residual) {
  for (std::size_t i = 0; i < reactions_.size(); ++i) reactions_[i] = system_->fixed()[i] ? residual[i] : 0.0;
}

/// Heat through conditions and contributions at the last residual.
HeatBalance ThermalPhase::measure(double dt) const {
  HeatBalance balance;
  for (const auto& [name, power] : system_->reaction_powers(reactions_))
    balance.conditions.push_back({name, power * dt});
  for (const auto& [name, power] : system_->powers()) balance.conditions.push_back({name, power * dt});
  for (double power : system_->contribution_powers()) balance.contributions.push_back(power * dt);
  return balance;
}

void ThermalPhase::require(const algebra::NewtonReport& report, std::span<const double> residual,
                           std::span<const double> temperature) const {
  if (report.converged) return;
  struct {
    double value;
    int rank;
  } worst{-1.0, 0}, winner{};
  MPI_Comm_rank(PETSC_COMM_WORLD, &worst.rank);
  std::size_t node = 0;
  for (std::size_t i = 0; i < residual.size(); ++i) {
    const double size = std::isfinite(residual[i]) ? std::abs(residual[i]) : HUGE_VAL;
    if (system_->fixed()[i] || size <= worst.value) continue;
    worst.value = size;
    node = i;
  }
  MPI_Allreduce(&worst, &winner, 1, MPI_DOUBLE_INT, MPI_MAXLOC, PETSC_COMM_WORLD);
  char text[200] = {};
  if (winner.rank == worst.rank && !residual.empty()) {
    const mesh::Point& p = mesh_.x[node];
    const auto end = fmt::format_to_n(
        text, sizeof text - 1, "node {} at ({:.6g}, {:.6g}, {:.6g}) m: {:.6g} K, unbalanced heat {:.4g} W",
        mesh_.input_node[node], p[0], p[1], p[2], temperature[node], residual[node]);
    *end.out = '\0';
  }
  MPI_Bcast(text, sizeof text, MPI_CHAR, winner.rank, PETSC_COMM_WORLD);
  throw StepRejected("heat: " + report.reason, text);
}

double ThermalPhase::heat_at(const ThermalState& state, Index node) const {
  return state.enthalpy.empty() ? storage_->upper(node, state.temperature[at(node)])
                                : state.enthalpy[at(node)];
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
  return algebra::global_sum(solid) / algebra::global_sum(volume);
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
  volume = algebra::global_sum(volume);
  solid = algebra::global_sum(solid);
  return volume > 0 ? solid / volume : 1.0;
}

double ThermalPhase::mean_temperature(const ThermalState& state, int body) const {
  double sum = 0, volume = 0;
  for (Index i = 0; i < mesh_.n_owned_nodes; ++i) {
    const double v = storage_->volume(i, body);
    volume += v;
    sum += v * state.temperature[at(i)];
  }
  return algebra::global_sum(sum) / algebra::global_sum(volume);
}

std::size_t ThermalPhase::bytes() const {
  std::size_t total = storage_->bytes() + system_->bytes();
  for (const auto& block : points_) total += block->bytes();
  return total;
}

double ThermalPhase::seconds_solver() const {
  return solver_->seconds();
}

}  // namespace solidus::heat
