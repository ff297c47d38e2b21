#include "heat/step_sensitivity.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "heat/loads/stage_loads.hpp"
#include "heat/thermal_parts.hpp"
#include "material/time_integration.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "system/errors.hpp"
#include "system/profile.hpp"

namespace solidus::heat {

namespace {

using material::k_sdirk_carried;
using material::k_sdirk_share;

constexpr double k_plateau_stiffness =
    1e13;                         ///< times the diagonal: δv = 0 to rounding, without a change of structure
constexpr int k_directions = 60;  ///< of the iteration for what the symmetric matrix lacks
constexpr double k_accuracy = 1e-9;               ///< of a derivative, in the residual of its linear system
constexpr std::size_t k_most_factorised = 20000;  ///< nodes, whose factors stay small in three dimensions too
constexpr int k_corrections = 8;     ///< by residuals, where the tangent of a contribution is not exact
constexpr double k_no_better = 0.5;  ///< residual over that before from which on no correction helps

double dot(std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (std::size_t i = 0; i < b.size(); ++i) sum += a[i] * b[i];
  return parallel::global_sum(sum);
}

void add(double factor, std::span<const double> x, std::span<double> y) {
  for (std::size_t i = 0; i < y.size(); ++i) y[i] += factor * x[i];
}

}  // namespace

StepSensitivity::StepSensitivity(ThermalPhase& phase, bool exact, double accuracy)
    : phase_(phase), exact_(exact), accuracy_(accuracy) {
  // Only with these settings the heat of a node is one known curve of its temperature, along which
  // derivatives are taken.
  if (!phase.parts().nodal() || phase.parts().consistent || phase.parts().printed)
    throw InputError({}, "derivatives are known where nodes hold the heat",
                     "heat.integration = \"closed\" and heat.sensible = \"enthalpy\"");
  if (phase.parts().system->parts().enclosed.any())
    throw InputError({}, "derivatives are not known where surfaces see each other",
                     "radiation = \"ambient\" in all thermal conditions");
  if (phase.parts().system->parts().channels.any())
    throw InputError({}, "derivatives are not known where channels cool", "a case without [[channel]]");
}

void StepSensitivity::advance(const ThermalState& old, const StageFlows& flows, const ThermalState& now,
                              std::span<NeighbourPhase> neighbours) {
  assert(flows.known());
  const profile::Part part("sensitivities");
  // Neighbours are followed in copies: only when all stages have succeeded do their states move on, so that a
  // stage that is rejected leaves them where they were.
  std::vector<Neighbour> moved;
  for (const NeighbourPhase& n : neighbours) moved.push_back({n.phase, &n.state, n.state});
  phase_.parts().solver->begin(true);
  if (flows.share == 1) {
    advance_stage({flows.dt, 0, LoadWindow::backward_euler(flows.time - flows.dt, flows.time)}, old, old, now,
                  moved);
  } else {
    // The stages as solve_two_stages() has taken them: the second extrapolates, or is backward Euler over the
    // rest.
    const ThermalState middle{flows.middle_temperature, flows.middle_enthalpy};
    assert(!middle.temperature.empty());
    advance_stage({k_sdirk_share * flows.dt, 0, first_loads(flows.time, flows.dt)}, old, old, middle, moved);
    advance_stage({flows.last_share * flows.dt, flows.second_order ? k_sdirk_carried : 1.0,
                   last_loads(flows.time, flows.dt, flows.second_order)},
                  old, middle, now, moved);
  }
  for (std::size_t i = 0; i < moved.size(); ++i) neighbours[i].state = std::move(moved[i].before);
  phase_.parts().solver->release();
}

/// Conditions, and limits of conduction, of a stage: those of the run's temperatures for all phases.
/// @param from  the phase's own state at the end of the stage before, from which its deformation gives heat
void StepSensitivity::begin(ThermalPhase& phase, const Stage& stage, const ThermalState& from,
                            const ThermalState& old, const ThermalState& before, const ThermalState& now) {
  phase.begin_stage({stage.dt, stage.carried}, from.temperature);
  // Both phases of a pair have to see the same window of loads and the same limits, else the difference of
  // their residuals would hold jumps of a switch in place of a derivative.
  phase.parts().system->parts().exchanges = true;
  phase.parts().system->set_window(stage.loads);
  phase.limit_conduction(before, old);
  phase.parts().system->limits().find(now.temperature);
}

/// f += F of a stage that ends in `end`.
void StepSensitivity::add_residual(ThermalPhase& phase, const Stage& stage, const ThermalState& old,
                                   const ThermalState& before, const ThermalState& end,
                                   std::vector<double>& f) {
  // The heat content is counted from the start of the stage, of which a second-order stage carries a part of
  // the first one over; all rates are in watts.
  std::vector<double> r(f.size());
  phase.parts().system->residual(end.temperature, r);
  for (std::size_t i = 0; i < f.size(); ++i) {
    const double from = old.enthalpy[i] + stage.carried * (before.enthalpy[i] - old.enthalpy[i]);
    f[i] += r[i] + (end.enthalpy[i] - from) / stage.dt;
  }
}

void StepSensitivity::advance_stage(const Stage& stage, const ThermalState& old, const ThermalState& before,
                                    const ThermalState& now, std::span<Neighbour> neighbours) {
  // The order matters: the system of the run's phase is set up, its residual taken and its matrix assembled
  // at the same state, and each neighbour then uses that one matrix.
  begin(phase_, stage, before, old, before, now);
  const std::size_t n = as_size(phase_.parts().mesh.n_owned_nodes);
  // The residual that the run's own iteration has left is not to be removed by the neighbours.
  std::vector<double> left(n);
  add_residual(phase_, stage, old, before, now, left);
  linearise(stage, now);
  factorised_ = factorise();
  bool first = true;
  int needed = exact_ ? 1 : 0;  // corrections; zero: not known yet
  for (Neighbour& neighbour : neighbours) {
    // The neighbour gets the limits of the run as well, and its own loads at the same times.
    begin(*neighbour.phase, stage, neighbour.before, old, before, now);
    ThermalState end = guess(*neighbour.phase, now);
    double before_it = HUGE_VAL, at_first = 0;
    // Where tangents are not exact, what they have left of the residual is taken up until it is small
    // enough: of one neighbour, and with as many solves of the others unless derivatives are to be exact.
    for (int k = 0; k < k_corrections && (k == 0 || k != needed); ++k) {
      std::vector<double> f(n), step(end.temperature.size());
      add_residual(*neighbour.phase, stage, *neighbour.old, neighbour.before, end, f);
      // Only what the neighbour's residual has more than the run's counts, and rows of prescribed
      // temperatures have none.
      for (std::size_t i = 0; i < n; ++i)
        f[i] = phase_.parts().system->parts().prescribed.fixed()[i] ? 0.0 : f[i] - left[i];
      const double size = std::sqrt(dot(f, f));
      if (k == 0) at_first = size;
      // Corrections end when the rest is small enough, or when they gain nothing: the
      // tangent is then no better than what is left.
      const bool done = size <= accuracy_ * at_first;
      if (k > 0 && done && accuracy_ > k_sensitivity_accuracy) needed = k;
      if (done || (k > 0 && size >= k_no_better * before_it)) break;
      before_it = size;
      // The matrix is prepared at its first use alone; every later neighbour and correction solves with it
      // again.
      solve(f, step, std::exchange(first, false));
      follow(stage, f, step, end);
    }
    neighbour.before = std::move(end);
  }
}

/// The neighbour at the heats of the run, with temperatures that its own curves have there.
ThermalState StepSensitivity::guess(const ThermalPhase& phase, const ThermalState& now) const {
  ThermalState end = now;
  // Heats are kept and temperatures shifted by the difference of the two curves, so that the iteration starts
  // where a changed latent heat or capacity is accounted for already.
  for (Index i = 0; i < phase.parts().mesh.n_owned_nodes; ++i)
    end.temperature[as_size(i)] += phase.parts().storage->temperature(i, now.enthalpy[as_size(i)]) -
                                   phase_.parts().storage->temperature(i, now.enthalpy[as_size(i)]);
  // Prescribed temperatures go in last, since the neighbour may prescribe others, and heat has to stay within
  // the range of its curve at such a temperature.
  phase.parts().ghosts.update(end.temperature, 1);
  phase.parts().system->parts().prescribed.prescribe(end.temperature);
  for (Index i = 0; i < phase.parts().mesh.n_owned_nodes; ++i)
    if (phase.parts().system->parts().prescribed.fixed()[as_size(i)])
      end.enthalpy[as_size(i)] =
          std::clamp(now.enthalpy[as_size(i)], phase.parts().storage->lower(i, end.temperature[as_size(i)]),
                     phase.parts().storage->upper(i, end.temperature[as_size(i)]));
  return end;
}

/// K in the matrix of the run's phase, rows of δv = 0 held.
void StepSensitivity::linearise(const Stage& stage, const ThermalState& now) {
  HeatSystem& system = *phase_.parts().system;
  const NodalEnthalpy& storage = *phase_.parts().storage;
  const NodalPotential& potential = system.parts().elements.nodal();
  const std::size_t n = as_size(phase_.parts().mesh.n_owned_nodes);
  // The unknown is a potential v of the temperature Θ, in which conduction is nearly symmetric. Its slope
  // dv/dΘ turns steps of v into those of Θ; ghosts need it for the rows at seams.
  slope_.assign(now.temperature.size(), 1.0);
  if (!potential.identity()) {
    for (std::size_t i = 0; i < n; ++i) slope_[i] = potential.slope(as_index(i), now.temperature[i]);
    phase_.parts().ghosts.update(slope_, 1);
  }
  system.assemble_symmetric(now.temperature, slope_);
  to_heat_.assign(n, 0.0);
  held_.assign(n, 0);
  // On a plateau the temperature does not change with the heat: the row is held by a large diagonal, which
  // keeps the structure of the matrix, and the heat of that node follows afterwards.
  for (std::size_t i = 0; i < n; ++i) {
    const auto node = as_index(i);
    double& diagonal = *system.matrix().diagonal_block(node);
    to_heat_[i] = storage.slope(node, now.enthalpy[i]) * slope_[i];
    held_[i] = to_heat_[i] == 0.0 || system.parts().prescribed.fixed()[i] ? 1 : 0;
    const double rate =
        to_heat_[i] == 0.0 ? storage.capacity(node, now.temperature[i]) / slope_[i] : 1.0 / to_heat_[i];
    if (to_heat_[i] == 0.0)
      diagonal = k_plateau_stiffness * (std::abs(diagonal) + rate / stage.dt);
    else
      diagonal += rate / stage.dt;
  }
}

/// K δv, zero in rows that are held.
void StepSensitivity::multiply(std::vector<double>& step, std::vector<double>& product) const {
  // Ghosts have to be current: rows of owned nodes reach into neighbouring processes.
  phase_.parts().ghosts.update(step, 1);
  // The matrix stands for its symmetric part alone, and the rest of the tangent is added to the product entry
  // by entry.
  phase_.parts().system->matrix().multiply(step, product);
  for (const UnsymmetricPart::Entry& e : phase_.parts().system->parts().unsymmetric.entries())
    product[as_size(e.row)] += e.value * step[as_size(e.column)];
  for (std::size_t i = 0; i < held_.size(); ++i)
    if (held_[i]) product[i] = 0;
}

/// Factors of K with what the symmetric matrix lacks, where one process has all nodes and few enough of them:
/// each neighbour then costs a forward and a backward substitution.
bool StepSensitivity::factorise() {
  // Factors are computed by one process for all nodes: with ghosts, or with several processes, part of the
  // matrix would be missing.
  const bool small = held_.size() == slope_.size() && held_.size() <= k_most_factorised;
  if (!small || parallel::global_sum(1.0) > 1) return false;
  std::vector<linear::SparseFactors::Entry> further;
  for (const UnsymmetricPart::Entry& e : phase_.parts().system->parts().unsymmetric.entries())
    further.push_back({e.row, e.column, e.value});
  return factors_.factorise(phase_.parts().system->matrix(), further, held_);
}

/// K δv = −f.
/// @param first  the matrix has not been solved with yet
void StepSensitivity::solve(std::span<const double> f, std::vector<double>& step, bool first) {
  if (!factorised_) return iterate(f, step, first);
  // Rows that are held have the diagonal one in the factors, and zero on the right gives them a step of zero.
  std::vector<double> b(held_.size());
  for (std::size_t i = 0; i < b.size(); ++i) b[i] = held_[i] ? 0.0 : -f[i];
  factors_.solve(b, std::span(step).first(b.size()));
  phase_.parts().ghosts.update(step, 1);
}

/// K δv = −f by generalised conjugate residuals (Eisenstat, Elman and Schultz 1983) with the symmetric matrix
/// for preconditioner: the first direction is the solution where nothing is unsymmetric.
/// @param first  the matrix has not been solved with yet
void StepSensitivity::iterate(std::span<const double> f, std::vector<double>& step, bool first) {
  HeatSystem& system = *phase_.parts().system;
  const std::size_t n = held_.size();
  std::vector<double> left(n);
  // The right side starts as the whole residual, from which the share along each direction is taken away.
  for (std::size_t i = 0; i < n; ++i) left[i] = held_[i] ? 0.0 : -f[i];
  const double target = k_accuracy * std::sqrt(dot(left, left));
  // A residual of zero needs no step; only the first call goes on, because it is the one that prepares the
  // solver with the new matrix.
  if (target == 0 && !first) return;
  struct Direction {
    std::vector<double> step, product;  ///< the products are orthonormal
  };
  std::vector<Direction> directions;
  for (int k = 0; k < k_directions; ++k) {
    Direction d{std::vector<double>(step.size()), std::vector<double>(n)};
    const std::span<double> owned = std::span(d.step).first(n);
    // The iteration for the unsymmetric part corrects what the linear solver leaves.
    const linear::LinearReport report = std::exchange(first, false)
                                            ? phase_.parts().solver->solve(system.matrix(), left, owned)
                                            : phase_.parts().solver->solve_again(left, owned, 0);
    // A linear system that does not converge rejects the step: its derivative would be wrong without a sign
    // of it.
    if (!report.converged)
      throw StepRejected("sensitivities: the linear system: " + report.reason, {}, Failure::heat);
    // Directions must not move held rows, or the products would not belong to the steps.
    for (std::size_t i = 0; i < n; ++i)
      if (held_[i]) d.step[i] = 0;
    multiply(d.step, d.product);
    // Each new product is made orthogonal to all others, with the same combination of the steps, so that the
    // best share along it does not disturb those found already.
    for (const Direction& before : directions) {
      const double along = dot(before.product, d.product);
      add(-along, before.step, d.step);
      add(-along, before.product, d.product);
    }
    // A direction of no length adds nothing: the space is used up, and the rest is as small as it becomes.
    const double length = std::sqrt(dot(d.product, d.product));
    if (!(length > 0)) break;
    for (auto* v : {&d.step, &d.product})
      for (double& value : *v) value /= length;
    // The residual is least where its share along the new product is removed.
    const double share = dot(left, d.product);
    add(share, d.step, step);
    add(-share, d.product, left);
    if (std::sqrt(dot(left, left)) <= target) break;
    directions.push_back(std::move(d));
  }
  phase_.parts().ghosts.update(step, 1);
}

/// Moves the end of the stage by δv.
void StepSensitivity::follow(const Stage& stage, std::span<const double> f, std::vector<double>& step,
                             ThermalState& end) const {
  // The products are needed without the rows of plateaus set to zero, for these are the rows that tell how
  // much heat such a node takes up.
  HeatSystem& system = *phase_.parts().system;
  std::vector<double> product(held_.size());
  phase_.parts().system->matrix().multiply(step, product);
  for (const UnsymmetricPart::Entry& e : system.parts().unsymmetric.entries())
    product[as_size(e.row)] += e.value * step[as_size(e.column)];
  for (std::size_t i = 0; i < held_.size(); ++i) {
    // Prescribed nodes have their end already; a node on a plateau takes the heat that the balance leaves at
    // its fixed temperature, all others move along their curves.
    if (system.parts().prescribed.fixed()[i]) continue;
    if (held_[i]) {
      end.enthalpy[i] -= stage.dt * (f[i] + product[i]);
    } else {
      end.enthalpy[i] += step[i] / to_heat_[i];
      end.temperature[i] += step[i] / slope_[i];
    }
  }
  phase_.parts().ghosts.update(end.enthalpy, 1);
  phase_.parts().ghosts.update(end.temperature, 1);
}

}  // namespace solidus::heat
