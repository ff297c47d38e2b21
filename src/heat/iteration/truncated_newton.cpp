/// Each iteration smooths by nodal sweeps, which can cross any kink, then corrects by a linear solve
/// without the nodes on a plateau, and searches along the correction.
#include "heat/iteration/truncated_newton.hpp"

#include <algorithm>
#include <cmath>

#include "heat/storage/plateau_watch.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "system/profile.hpp"

namespace solidus::heat {

namespace {

constexpr double k_round_off = 2e-15;    ///< of heat contents and of conductance × temperature
constexpr double k_limit_change = 1e-2;  ///< of flows by new limits, over the heat moved, that stays out
constexpr int k_revisions = 1;           ///< of limits by flows
constexpr int k_holds = 20;              ///< and by temperatures out of range
constexpr int k_idle = 4;  ///< such revisions that find no further nodes: what the tolerance has left goes
constexpr double k_nearly = 1e-2;      ///< residual over the heat moved where the solution is nearly known
constexpr double k_strictest = 1e-4;   ///< forcing term there, whatever the tolerance
constexpr double k_chord_worth = 0.5;  ///< share of the residual left up to which chords are used again
constexpr double k_loosest = 0.1;      ///< forcing term of the inexact linear solves

}  // namespace

TruncatedNewton::TruncatedNewton(const mesh::Mesh& mesh, HeatSystem& system, const NodalEnthalpy& storage,
                                 HeatSolver& solver, const parallel::GhostExchange& ghosts,
                                 TruncatedNewtonOptions options, std::vector<char> relaxed)
    : mesh_(mesh),
      system_(system),
      storage_(storage),
      curves_(storage, system),
      solver_(solver),
      ghosts_(ghosts),
      options_(options),
      relaxed_(std::move(relaxed)) {}

void TruncatedNewton::allocate() {
  work_.r.resize(as_size(mesh_.n_owned_nodes));
  for (auto* v : {&work_.diagonal, &work_.product, &work_.potential, &work_.curve_slope})
    v->resize(work_.r.size());
  work_.step.resize(mesh_.x.size());
}

void TruncatedNewton::release() {
  for (auto* v : {&work_.diagonal, &work_.product, &work_.potential, &work_.curve_slope, &work_.step})
    std::vector<double>().swap(*v);
  solver_.release();
  system_.parts().conduction.release_work();
}

void TruncatedNewton::evaluate() {
  const profile::Part part("residual");
  double moved = system_.residual(of_step_.temperature, work_.r), norm = 0, contents = 0;
  const std::vector<char>& fixed = system_.parts().prescribed.fixed();
  // Stored heat joins the flows; at prescribed temperatures the residual is a reaction, elsewhere it must
  // vanish.
  for (std::size_t i = 0; i < work_.r.size(); ++i) {
    const double stored = (of_step_.heat[i] - of_step_.old_heat[i]) / of_step_.dt;
    work_.r[i] += stored;
    moved += std::abs(stored);
    contents += std::abs(of_step_.heat[i]) / of_step_.dt;
    (fixed[i] ? moved : norm) += std::abs(work_.r[i]);
  }
  sums_.unbalanced = parallel::global_sum(norm);
  sums_.moved =
      0.5 * parallel::global_sum(moved);  // what enters somewhere is stored or leaves somewhere else
  sums_.round_off = k_round_off * (parallel::global_sum(contents) + sums_.conductance);
}

/// A at the temperatures of now.
void TruncatedNewton::assemble() {
  const profile::Part part("assembly");
  const NodalPotential& potential = system_.parts().elements.nodal();
  std::vector<double> slope(mesh_.x.size(), 1.0);  // c = dv/dΘ
  if (!potential.identity()) {
    for (std::size_t i = 0; i < work_.r.size(); ++i)
      slope[i] = potential.slope(as_index(i), of_step_.temperature[i]);
    ghosts_.update(slope, 1);
  }
  system_.assemble_symmetric(of_step_.temperature, slope);
  linear::BlockMatrix& a = system_.matrix();
  // Σ |A_ii Θ_i|: the scale against which rounding of the residual is judged.
  double conductance = 0;
  for (std::size_t i = 0; i < work_.r.size(); ++i) {
    work_.diagonal[i] = *a.diagonal_block(as_index(i));
    conductance += std::abs(work_.diagonal[i] * slope[i] * of_step_.temperature[i]);
  }
  sums_.conductance = parallel::global_sum(conductance);
  // With one process the rows are complete; otherwise couplings to ghosts are noted.
  if (work_.r.size() == mesh_.x.size()) return;
  const std::span<const std::int64_t> start = a.row_start();
  const std::span<const Index> columns = a.columns();
  const double* values = a.block(0);
  for (std::size_t i = 0; i < work_.r.size(); ++i)
    for (std::int64_t s = start[i]; s < start[i + 1]; ++s)
      if (columns[as_size(s)] >= mesh_.n_owned_nodes) work_.diagonal[i] += std::abs(values[s]);
}

/// Looks at the limits of conduction at the temperatures reached. Returns whether the iteration has to go on
/// with others: when flows change too much, and then when temperatures are out of range.
bool TruncatedNewton::revise_limits(const ConductionBounds& bounds) {
  if (!bounds.kept && progress_.revisions < k_revisions &&
      system_.limits().find(of_step_.temperature, k_limit_change * sums_.moved)) {
    ++progress_.revisions;
    return true;
  }
  if (progress_.revisions >= k_revisions + k_holds) return false;
  using Held = HeldNodes::Found;
  const Held held = system_.limits().hold(
      of_step_.temperature, system_.limits().closed(bounds.range, bounds.start, of_step_.temperature));
  if (held == Held::none || (held == Held::as_before && ++progress_.idle > k_idle)) return false;
  progress_.revisions = std::max(progress_.revisions, k_revisions) + 1;
  system_.limits().find(of_step_.temperature);
  return true;
}

/// The tolerance of the next linear system. Near the solution the sweeps take nearly all that tangents have
/// left at the front, so that what the linear solver leaves would cost one more iteration: there it goes on
/// to what ends the iteration.
double TruncatedNewton::forcing_term(linear::Forcing& forcing) const {
  const double goal = options_.tolerance * sums_.moved / sums_.unbalanced,
               usual = forcing.next(sums_.unbalanced, goal);
  return sums_.unbalanced <= k_nearly * sums_.moved ? std::min(usual, std::max(goal, k_strictest)) : usual;
}

/// The iteration of a step begins, whose data are kept for its duration, so that its parts need no arguments
/// of their own.
void TruncatedNewton::begin() {
  sums_.conductance = 0;
  progress_.revisions = progress_.idle = 0;
  progress_.linear = true;
  progress_.looked_up = false;
  allocate();
}

/// A linear correction and the search along it.
/// @param by_chords  whether it is one by chords; told of the one that was taken at last
/// @param may_use_chords  whether another one may be
linear::LinearReport TruncatedNewton::step(double to, bool& by_chords, bool may_use_chords,
                                           linear::NewtonReport& report) {
  linear::LinearReport linear = by_chords ? correct_by_chords(to) : correct(to);
  report.linear_iterations += linear.iterations;
  solver_.release();  // sweeps have copies of their own
  // A step that the search cuts short has met kinks of the curves: another correction is tried,
  // by chords or away from the kinks.
  if (linear.converged && !search(by_chords ? 0 : may_use_chords ? k_short_step : k_stuck_step)) {
    by_chords = may_use_chords;
    linear = by_chords ? correct_by_chords(to) : correct_beside_kinks(to);
    solver_.release();
    report.linear_iterations += linear.iterations;
    if (linear.converged) search(0);
  }
  return linear;
}

linear::NewtonReport TruncatedNewton::solve(std::span<const double> old_heat, double dt,
                                            std::span<double> temperature, std::span<double> heat,
                                            const ConductionBounds& bounds, int newton_steps) {
  of_step_ = {.dt = dt, .rate = 1.0 / dt, .old_heat = old_heat, .heat = heat, .temperature = temperature};
  begin();
  // Whether the front has passed nodes in depth says if chords are worth trying.
  PlateauWatch watch(mesh_, storage_, system_.matrix(), ghosts_);
  watch.passed_in_depth(of_step_.heat, of_step_.temperature);
  bool by_chords = false;
  double norm_before = 0;
  const int most = newton_steps > 0 ? newton_steps : options_.max_iterations;
  linear::Forcing forcing(true, k_loosest);
  linear::NewtonReport report;
  bool revised = false, looked_ahead = false;
  // Every round: nonlinear sweeps, a test of convergence, and a linear correction with a search
  // along it.
  evaluate();
  while (true) {
    report.residuals.push_back(sums_.moved > 0 ? sums_.unbalanced / sums_.moved : sums_.unbalanced);
    if (std::isfinite(sums_.unbalanced) && (!converged() || revised)) relax_nodes(revised);
    revised = false;
    if (!std::isfinite(sums_.unbalanced)) {
      report.reason = "the residual is not a number";
      break;
    }
    // At convergence the limits of conduction are found again; if that changes flows, the iteration
    // goes on.
    if (converged()) {
      report.residuals.back() = sums_.moved > 0 ? sums_.unbalanced / sums_.moved : sums_.unbalanced;
      report.converged = true;
      if (newton_steps > 0 || !revise_limits(bounds)) break;
      report.converged = false;
      revised = true;
      evaluate();
      continue;
    }
    // Limits that are found again where the solution is nearly known need hardly be looked at again at its
    // end.
    if (!looked_ahead && newton_steps == 0 && sums_.unbalanced <= k_nearly * sums_.moved) {
      looked_ahead = true;
      revised = revise_limits(bounds);
      if (revised) {
        evaluate();
        continue;
      }
    }
    if (report.iterations == most) {
      evaluate();
      report.out_of_iterations = true;
      report.reason = "no convergence in " + std::to_string(most) + " iterations";
      break;
    }
    ++report.iterations;
    if (sums_.unbalanced > std::max(options_.tolerance, options_.effort_tolerance) * sums_.moved)
      ++report.effort;
    // The linear solver's tolerance follows the nonlinear convergence (Eisenstat and Walker).
    const double to = forcing_term(forcing);
    const bool in_depth = watch.passed_in_depth(of_step_.heat, of_step_.temperature);
    // Chords were no help last time if the residual has not fallen by k_chord_worth: then Newton's
    // step again.
    const bool may_use_chords =
        storage_.has_plateaus() && !(by_chords && sums_.unbalanced > k_chord_worth * norm_before);
    norm_before = sums_.unbalanced;
    by_chords = may_use_chords && in_depth;
    const linear::LinearReport linear = step(to, by_chords, may_use_chords, report);
    if (!linear.converged) {
      report.reason = "linear solver: " + linear.reason;
      break;
    }
  }
  ghosts_.update(heat, 1);
  release();
  return report;
}

}  // namespace solidus::heat
