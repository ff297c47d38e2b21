/// Sweeps of the truncated Newton method: every node takes the heat that balances its own equation.
#include <algorithm>
#include <cmath>

#include "heat/iteration/local_sweeps.hpp"
#include "heat/iteration/truncated_newton.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "system/profile.hpp"

namespace solidus::heat {

namespace {

/// Share of a node's own residual that a visit may leave. Neighbours change it again in the same sweep: a
/// thousandth costs a tenth more time of sweeps and saves no iteration.
constexpr double k_relaxed = 5e-2;
constexpr double k_negligible = 1e-1;  ///< share of the tolerance that nodes which are not relaxed may have
constexpr int k_relaxations = 60;      ///< evaluations of a node's curve in one visit

}  // namespace

/// Solves the equation of one node, F_i + (H − H_i)/Δt + A_ii (v(H) − v_i) = 0, for its H; returns the change
/// of v. The left-hand side rises with H, at 1/Δt at least: Newton's method, within a bracket as soon as
/// there is one. The neighbours wait for the result: what does not depend on the residual is divided first.
double TruncatedNewton::relax(std::size_t i, double residual) {
  if (std::abs(residual) <= progress_.negligible || system_.parts().prescribed.fixed()[i] ||
      (!relaxed_.empty() && relaxed_[i] == 0))
    return 0;
  const auto node = as_index(i);
  const double a = std::max(work_.diagonal[i], 0.0), h0 = of_step_.heat[i], v0 = work_.potential[i],
               rate = of_step_.rate;
  StorageCurve::AtHeat at{of_step_.temperature[i], v0, work_.curve_slope[i]};
  double low = -HUGE_VAL, high = HUGE_VAL, h = h0, defect = residual;
  for (int trial = 0; trial < k_relaxations; ++trial) {
    (defect > 0 ? high : low) = h;
    double next = h - defect * (1.0 / (rate + a * at.slope));
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (!std::isfinite(next) || next == h) break;
    h = next;
    at = curves_.at_heat(node, h);
    defect = residual + (h - h0) * rate + a * (at.potential - v0);
    if (std::abs(defect) <= k_relaxed * std::abs(residual)) break;
  }
  of_step_.heat[i] = h;
  of_step_.temperature[i] = at.temperature;
  work_.potential[i] = at.potential;
  work_.curve_slope[i] = at.slope;
  return at.potential - v0;
}

/// Visits all nodes in rising and then in falling order, with F of the linear A carried on in work_.r. A row
/// has its later columns in either storage: going forward, what a change makes of their residuals is added to
/// them; going backward a row first takes what all changes of later nodes have made of its own. So each way
/// goes through the matrix once.
void TruncatedNewton::sweep() {
  const linear::BlockMatrix& a = system_.matrix();
  const std::span<const std::int64_t> start = a.row_start();
  const std::span<const Index> columns = a.columns();
  const double* values = a.block(0);
  const auto n = work_.r.size();
  const auto for_later = [&](std::size_t i, const auto& take) {
    for (std::int64_t s = start[i]; s < start[i + 1]; ++s)
      if (const auto j = as_size(columns[as_size(s)]); j > i && j < n) take(j, values[s]);
  };
  const auto visit = [&](std::size_t i) {
    const double heat = of_step_.heat[i], change = relax(i, work_.r[i]);
    work_.r[i] += (of_step_.heat[i] - heat) * of_step_.rate + work_.diagonal[i] * change;
    work_.step[i] += change;
    if (change != 0) for_later(i, [&](std::size_t j, double entry) { work_.r[j] += entry * change; });
  };
  std::fill(work_.step.begin(), work_.step.end(), 0.0);
  for (std::size_t i = 0; i < n; ++i) visit(i);
  std::vector<double> forward;
  if (parallel::any_process(n < work_.step.size())) {
    follow_other_processes();
    forward = work_.step;
  }
  for (std::size_t i = n; i-- > 0;) {
    for_later(i, [&](std::size_t j, double entry) { work_.r[i] += entry * work_.step[j]; });
    visit(i);
  }
  if (forward.empty()) return;
  for (std::size_t i = 0; i < n; ++i) work_.step[i] -= forward[i];
  follow_other_processes();
}

/// The changes of other processes' nodes, in place of the magnitudes that stood on the diagonal for them.
void TruncatedNewton::follow_other_processes() {
  ghosts_.update(work_.step, 1);
  const linear::BlockMatrix& a = system_.matrix();
  const std::span<const std::int64_t> start = a.row_start();
  const std::span<const Index> columns = a.columns();
  const double* values = a.block(0);
  for (std::size_t i = 0; i < work_.r.size(); ++i)
    for (std::int64_t s = start[i]; s < start[i + 1]; ++s)
      if (const auto j = as_size(columns[as_size(s)]); j >= work_.r.size())
        work_.r[i] += values[s] * work_.step[j] - std::abs(values[s]) * work_.step[i];
}

/// Finds v and dv/dH of a node at its heat; returns Θ. From then on sweeps and steps carry them along.
double TruncatedNewton::look_up(Index node) {
  const auto i = as_size(node);
  const StorageCurve::AtHeat at = curves_.at_heat(node, of_step_.heat[i]);
  work_.potential[i] = at.potential;
  work_.curve_slope[i] = at.slope;
  return at.temperature;
}

/// The sweeps, with A at the temperatures of now, and F there. What A holds by derivatives only (films and
/// radiation where conductivities vary, nodes of several materials) has bent under the sweeps: a step that
/// starts from the residuals of the linear A points elsewhere, and no length of it brings F down.
/// @param all  every node, however small its residual is
void TruncatedNewton::relax_nodes(bool all) {
  system_.parts().conduction.release_work();
  assemble();
  {
    const profile::Part part("sweeps");
    progress_.negligible =
        all ? 0 : k_negligible * options_.tolerance * sums_.moved / static_cast<double>(mesh_.n_global_nodes);
    if (!progress_.looked_up)
      for (std::size_t i = 0; i < work_.r.size(); ++i) look_up(as_index(i));
    progress_.looked_up = true;
    sweep();
  }
  const double swept = progress_.linear ? relax_locally() : HUGE_VAL;
  ghosts_.update(of_step_.temperature, 1);
  evaluate();
  if (sums_.unbalanced > swept) progress_.linear = false;
}

/// Sweeps on over the nodes where F is concentrated; returns Σ|F_i| before that. Where F is found to be
/// larger afterwards, A tells too little of it: such sweeps are then left out for the rest of the step.
double TruncatedNewton::relax_locally() {
  const profile::Part part("sweeps");
  LocalSweeps local(system_.matrix(), work_.r, system_.parts().prescribed.fixed(), ghosts_);
  progress_.negligible = 0;
  local.run([this](std::size_t i, double residual) {
    const double heat = of_step_.heat[i], change = relax(i, residual);
    return NodeChange{change, (of_step_.heat[i] - heat) * of_step_.rate};
  });
  return local.sum();
}

}  // namespace solidus::heat
