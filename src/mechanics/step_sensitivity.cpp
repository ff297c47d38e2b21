#include "mechanics/step_sensitivity.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mechanics/loads/loads.hpp"
#include "mechanics/solver/nodal_pressure.hpp"
#include "system/errors.hpp"
#include "system/profile.hpp"

namespace solidus::mechanics {

namespace {

constexpr int k_corrections = 8;          ///< by residuals, where the tangent is not exact
constexpr double k_no_better = 0.5;       ///< residual over that before from which on no correction helps
constexpr double k_measured_each = 1e-5;  ///< accuracy from which on every neighbour's residual is measured
constexpr double k_same_history = 1e-6;   ///< difference of histories, over their size, that is rounding

double norm(const std::vector<double>& v) {
  double sum = 0;
  for (const double value : v) sum += value * value;
  return std::sqrt(sum);
}

/// Whether two histories are equal but for rounding.
bool same(const std::vector<BlockHistory>& a, const std::vector<BlockHistory>& b) {
  double size = 0, difference = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    for (std::size_t i = 0; i < a[k].values.size(); ++i)
      for (int lane = 0; lane < k_lanes; ++lane) {
        size = std::max(size, std::abs(b[k].values[i][lane]));
        difference = std::max(difference, std::abs(a[k].values[i][lane] - b[k].values[i][lane]));
      }
  return difference <= k_same_history * size;
}

/// The state at the unknowns x, with the history of the points there.
MechanicalState finished(MechanicalPhase& phase, const MechanicalState& old, const MechanicalPass& pass,
                         const std::vector<double>& x, StepDeformation& deformation) {
  const MechanicalBodies& bodies = phase.bodies();
  MechanicalState next;
  bodies.finish(old, x, next.history, nullptr, nullptr, nullptr, &deformation);
  next.displacement.assign(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(bodies.n_displacements()));
  next.solid_fraction = bodies.nodal_phases.solid_fraction(fraction_place(pass));
  next.pressure = bodies.pressure ? bodies.pressure->pressure() : old.pressure;
  if (bodies.options.integration == TimeIntegration::two_step) {
    next.before = old.history;
    next.dt_before = pass.dt;
  }
  return next;
}

}  // namespace

/// r at x of the free unknowns, with constraints summed.
std::vector<double> StepSensitivity::residual(MechanicalPhase& phase, const std::vector<double>& x) {
  const MechanicalBodies& bodies = phase.bodies();
  std::vector<double> r(bodies.n_residuals());
  phase.equations().residual(x, r);
  for (std::size_t i = 0; i < bodies.n_forces(); ++i)
    if (bodies.loads->fixed()[i] != 0) r[i] = 0;
  phase.system().matrix().constraints().sum(std::span(r).first(bodies.n_forces()));
  return r;
}

bool StepSensitivity::linearise(const MechanicalState& old, const MechanicalPass& pass,
                                const MechanicalState& now, StepDeformation& deformation) {
  const profile::Part part("sensitivities");
  const MechanicalBodies& bodies = phase_.bodies();
  phase_.equations().begin(old, pass);
  // The end of the run is the place of everything that follows: no iteration leads there again.
  end_.assign(bodies.n_unknowns(), 0.0);
  std::ranges::copy(now.displacement, end_.begin());
  if (bodies.pressure)
    to_unknowns(*bodies.pressure, now.pressure, std::span(end_).subspan(bodies.n_displacements()));
  left_ = residual(phase_, end_);
  phase_.equations().tangent(end_);
  fresh_ = true;
  needed_ = 0;
  return same(finished(phase_, old, pass, end_, deformation).history, now.history);
}

MechanicalState StepSensitivity::follow(MechanicalPhase& neighbour, const MechanicalState& old,
                                        const MechanicalPass& pass, StepDeformation& deformation) {
  const profile::Part part("sensitivities");
  neighbour.equations().begin(old, pass);
  std::vector<double> x = end_;
  neighbour.bodies().loads->prescribe(pass.time, std::span(x).first(neighbour.bodies().n_displacements()));
  double before = HUGE_VAL, at_first = 0;
  // As many corrections as the first neighbour has needed in this step do for the others, without a residual
  // to see it, unless the derivative is to be an exact one.
  for (int k = 0; k < k_corrections && (k == 0 || k != needed_); ++k) {
    std::vector<double> r = residual(neighbour, x);
    for (std::size_t i = 0; i < r.size(); ++i) r[i] -= left_[i];
    const double size = norm(r);
    if (k == 0) at_first = size;
    // Corrections end when the rest is small enough, or when they gain nothing.
    const bool done = size <= accuracy_ * at_first;
    if (k > 0 && done && accuracy_ > k_measured_each) needed_ = k;
    if (done || (k > 0 && size >= k_no_better * before)) break;
    before = size;
    const std::vector<double> step = solve(std::move(r));
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += step[i];
  }
  return finished(neighbour, old, pass, x, deformation);
}

/// K step = −r.
std::vector<double> StepSensitivity::solve(std::vector<double> r) {
  for (double& value : r) value = -value;
  std::vector<double> step(r.size());
  linear::TangentSolver& solver = phase_.system().solver();
  linear::BlockMatrix& matrix = phase_.system().matrix();
  // The matrix is factorised at its first use alone.
  const linear::LinearReport report =
      std::exchange(fresh_, false) ? solver.solve(matrix, r, step, 0) : solver.solve_again(r, step, 0);
  if (!report.converged)
    throw StepRejected("sensitivities: the linear system: " + report.reason, {}, Failure::linear_solver);
  const std::size_t n = phase_.bodies().n_forces();
  for (std::size_t i = 0; i < n; ++i)
    if (matrix.fixed()[i] != 0) step[i] = 0;
  matrix.constraints().share(std::span(step).first(n));
  return step;
}

}  // namespace solidus::mechanics
