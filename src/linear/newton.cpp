/// One iteration: test, tangent or chord, linear solve within a tolerance, line search. What decides
/// between them is measured, never assumed.
#include "linear/newton.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "linear/forcing.hpp"
#include "linear/interruption.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::linear {

namespace {

// A body that is plastic all through has next to no stiffness: its full step can be a hundred times too long.
constexpr double k_smallest_step = 1e-3;  ///< of the line search
constexpr int k_line_search_trials = 12;  ///< residuals after the full step
/// A full Newton step that contracts the residual by ρ to r₁ has used up the tangent's error F'' e₀ once: a
/// second step with the same tangent leaves 2ρ r₁ to leading order. It is taken where five times that is
/// enough.
constexpr double k_chord_residual = 10;
/// The loosest linear solve. Forces say little of the error of a shell that flows or of melt beneath it,
/// which have next to no stiffness: with 0.1, as is usual, the steps were far off along those directions,
/// although the residual was small, and carried other points across the yield surface (decision 0038).
constexpr double k_loosest = 1e-3;
/// A residual so far below the goal ends the iteration whatever the size of its steps: what moves under such
/// forces has no place of its own.
constexpr double k_no_force = 1e-3;
/// Where forces are so many times what counts as rounding, a start out of balance is not taken as it is: the
/// rounding of a stiff body may be more than the tolerance allows, and a step would leave far less. Neither
/// is the end of a step that has left this share of the residual before it, where a tolerance below the usual
/// one is asked for. Rounding itself does not fall.
constexpr double k_forces = 1e3, k_falls = 0.1;

double dot(std::span<const double> a, std::span<const double> b) {
  double s = 0;
  for (std::size_t i = 0; i < a.size(); ++i) s += a[i] * b[i];
  return parallel::global_sum(s);
}

/// One solve: the vectors and the data shared by the iteration and its line search.
class Iteration {
 public:
  Iteration(NonlinearSystem& system, TangentSolver& solver, const parallel::GhostExchange& ghosts,
            std::span<const int> components, std::span<double> x, const NewtonOptions& options)
      : system_(system), solver_(solver), ghosts_(ghosts), components_(components), x_(x), options_(options) {
    work_.start.resize(x.size());
    work_.local_step.resize(x.size());
    // Lengths of the residual and of the step by the owned entries of all fields.
    std::size_t n = 0;
    for (const int of_field : components) n += owned(of_field);
    n_first_ = owned(components.front());
    work_.r.resize(n);
    work_.step.resize(n);
  }

  NewtonReport run();

 private:
  std::size_t owned(int components) const { return as_size(ghosts_.n_owned_nodes()) * as_size(components); }
  void evaluate();
  void constrain();
  /// The step on local nodes, ghosts included, from that on owned ones.
  void spread_step();
  /// The norm that ends the iteration.
  double goal() const { return std::max(options_.tolerance * reference_, options_.absolute_tolerance); }
  bool balanced() const { return norm_ <= goal(); }
  /// @param may_go_on  a residual that meets the goal as rounding alone does not do yet where it falls
  bool converged(bool may_go_on) const;
  bool takes_effort() const;
  bool chord_converges(double norm_before) const {
    return norm_ * (k_chord_residual * norm_ / norm_before) <= goal();
  }
  /// d·r of the step, which is turned round where it leads uphill (NewtonOptions::descends).
  double descend();
  void measure_next_step(double alpha, double norm_before);
  double measured() const { return reference_ > 0 ? norm_ / reference_ : norm_; }
  /// x = start + alpha × step and the residual there; returns step · r.
  double slope_at(double alpha);
  double search(double slope);
  bool ends(NewtonReport& report) const;
  LinearReport find_direction(BlockMatrix* tangent, double forcing);
  void go_back();
  static NewtonReport without_direction(bool solved, const LinearReport& linear, NewtonReport report);

  struct Work {
    std::vector<double> r, step;            ///< on owned nodes
    std::vector<double> start, local_step;  ///< on local nodes
  };

  NonlinearSystem& system_;
  TangentSolver& solver_;
  const parallel::GhostExchange& ghosts_;
  std::span<const int> components_;
  std::size_t n_first_ = 0;  ///< owned entries of the first field
  std::span<double> x_;
  const NewtonOptions& options_;
  Work work_;
  const std::vector<char>* fixed_ = nullptr;
  const MultiPointConstraints* constraints_ = nullptr;
  double norm_ = 0, reference_ = 0;
  bool stepped_ = false;  ///< a step has been taken
  bool falls_ = false;    ///< the last step has left k_falls of the residual before it
  double next_step_ = std::numeric_limits<double>::infinity();  ///< its estimated relative size
};

bool Iteration::converged(bool may_go_on) const {
  const bool forced = reference_ > k_forces * options_.absolute_tolerance;
  const bool goes_on = may_go_on && falls_ && options_.tolerance < options_.effort_tolerance;
  if ((!stepped_ || goes_on) && forced && norm_ > options_.tolerance * reference_) return false;
  if (options_.step_tolerance <= 0 || norm_ <= options_.absolute_tolerance) return balanced();
  if (!std::isfinite(next_step_)) return false;  // no step has been taken
  return balanced() && (next_step_ <= options_.step_tolerance || norm_ <= k_no_force * goal());
}

/// Whether the iteration would go on with the tolerances down to which its effort counts.
bool Iteration::takes_effort() const {
  const double goal = std::max(std::max(options_.tolerance, options_.effort_tolerance) * reference_,
                               options_.absolute_tolerance);
  if (norm_ > goal) return true;
  if (options_.step_tolerance <= 0 || norm_ <= k_no_force * goal) return false;
  return !(next_step_ <= std::max(options_.step_tolerance, options_.effort_step_tolerance));
}

void Iteration::measure_next_step(double alpha, double norm_before) {
  if (options_.step_tolerance <= 0) return;
  for (double& value : work_.local_step) value *= alpha;
  const double contraction = alpha == 1 && norm_before > 0 ? std::min(1.0, norm_ / norm_before) : 1.0;
  next_step_ = contraction * system_.relative_step(x_, work_.local_step);
}

void Iteration::evaluate() {
  reference_ = system_.residual(x_, work_.r);
  if (fixed_) constrain();
}

/// Reduces the residual to the free unknowns: zero where prescribed, the sum over the members of a
/// constraint.
void Iteration::constrain() {
  for (std::size_t i = 0; i < n_first_ && i < fixed_->size(); ++i)
    if ((*fixed_)[i]) work_.r[i] = 0;
  constraints_->sum(std::span(work_.r).first(n_first_));
  norm_ = std::sqrt(dot(work_.r, work_.r));
}

void Iteration::spread_step() {
  std::size_t from = 0, to = 0;
  const std::size_t n_nodes = x_.size() / as_size(std::accumulate(components_.begin(), components_.end(), 0));
  // Field by field from the owned unknowns to the local ones, with ghosts.
  for (const int components : components_) {
    const std::size_t n_owned = owned(components), n = n_nodes * as_size(components);
    std::copy_n(work_.step.begin() + static_cast<std::ptrdiff_t>(from), n_owned,
                work_.local_step.begin() + static_cast<std::ptrdiff_t>(to));
    ghosts_.update(std::span(work_.local_step).subspan(to, n), components);
    from += n_owned;
    to += n;
  }
}

// Where a body has no stiffness but what pressures give it as they turn with their faces, which may be
// negative, Newton's direction leads to the maximum of the energy, and the line search, which looks for a
// change of sign, goes with it.
double Iteration::descend() {
  const double slope = dot(work_.step, work_.r);
  if (!options_.descends || !(slope > 0)) return slope;
  for (double& value : work_.step) value = -value;
  for (double& value : work_.local_step) value = -value;
  return -slope;
}

double Iteration::slope_at(double alpha) {
  for (std::size_t i = 0; i < x_.size(); ++i) x_[i] = work_.start[i] + alpha * work_.local_step[i];
  evaluate();
  return dot(work_.step, work_.r);
}

/// Finds alpha with |s(alpha)| <= line_search_slope |s(0)|, s(alpha) = d · r(x + alpha d): the full step if
/// it will do, else the root between a bracket by the Illinois rule. Leaves x and the residual at the alpha
/// it returns.
double Iteration::search(double slope) {
  const double enough = options_.line_search_slope * std::abs(slope);
  double trial = slope_at(1.0);
  // The same sign means that the energy still falls at the full step: no reason to shorten it.
  const auto good = [&](double s) { return std::isfinite(s) && (std::abs(s) <= enough || balanced()); };
  if (good(trial) || (std::isfinite(trial) && trial * slope > 0)) return 1.0;

  double low = 0, low_slope = slope, high = 1, high_slope = trial;
  double best = 1, best_slope = trial, alpha = 1;
  int side = 0;
  for (int k = 0; k < k_line_search_trials; ++k) {
    alpha = std::isfinite(high_slope) ? (low * high_slope - high * low_slope) / (high_slope - low_slope)
                                      : 0.5 * (low + high);
    // Stay inside the bracket: far overshoots make the secant creep.
    alpha = std::clamp(alpha, low + 0.1 * (high - low), high - 0.1 * (high - low));
    alpha = std::max(alpha, k_smallest_step);
    trial = slope_at(alpha);
    if (std::isfinite(trial) && (!std::isfinite(best_slope) || std::abs(trial) < std::abs(best_slope))) {
      best = alpha;
      best_slope = trial;
    }
    if (good(trial) || alpha <= k_smallest_step) break;
    if (std::isfinite(trial) && trial * low_slope > 0) {
      low = alpha;
      low_slope = trial;
      if (side == 1 && std::isfinite(high_slope)) high_slope *= 0.5;
      side = 1;
    } else {
      high = alpha;
      high_slope = trial;
      if (side == -1) low_slope *= 0.5;
      side = -1;
    }
  }
  if (alpha != best) slope_at(best);
  return best;
}

/// Whether the iteration ends where it is; the report then says how.
bool Iteration::ends(NewtonReport& report) const {
  if (!std::isfinite(norm_)) {
    report.reason = "the residual is not a number";
    return true;
  }
  if (converged(report.iterations < options_.max_iterations)) {
    report.converged = true;
    return true;
  }
  if (report.iterations == options_.max_iterations) {
    report.out_of_iterations = true;
    report.reason = "no convergence in " + std::to_string(options_.max_iterations) + " iterations";
    return true;
  }
  return false;
}

/// Solves for the step, which is spread where that has succeeded.
/// @param tangent  null: the factors of the round before serve again
LinearReport Iteration::find_direction(BlockMatrix* tangent, double forcing) {
  for (double& value : work_.r) value = -value;
  LinearReport linear = tangent == nullptr ? solver_.solve_again(work_.r, work_.step, forcing)
                                           : solver_.solve(*tangent, work_.r, work_.step, forcing);
  for (double& value : work_.r) value = -value;
  if (!linear.converged) return linear;
  // Prescribed entries do not move, followers move with their leaders.
  for (std::size_t i = 0; i < n_first_ && i < fixed_->size(); ++i)
    if ((*fixed_)[i]) work_.step[i] = 0;
  constraints_->share(std::span(work_.step).first(n_first_));
  spread_step();
  return linear;
}

/// Back to where the last search has started.
void Iteration::go_back() {
  std::copy(work_.start.begin(), work_.start.end(), x_.begin());
  evaluate();
}

/// The iteration ends for want of a direction, which is no failure of a solution.
NewtonReport Iteration::without_direction(bool solved, const LinearReport& linear, NewtonReport report) {
  report.converged = solved;
  if (solved) return report;
  report.no_direction = true;
  report.reason = "linear solver: " + linear.reason;
  return report;
}

NewtonReport Iteration::run() {
  NewtonReport report;
  // The first residual and tangent; what is fixed and tied is known with them.
  evaluate();
  BlockMatrix* tangent = &system_.tangent(x_);  // knows what is fixed, and serves the first solve
  fixed_ = &tangent->fixed();
  constraints_ = &tangent->constraints();
  constrain();
  report.began_balanced = balanced();
  bool chord = false;
  Forcing forcing(options_.inexact, k_loosest);
  while (true) {
    // Each round: test, direction, search along it, and whether the tangent may be used once more.
    check_interruption();
    report.residuals.push_back(measured());
    if (ends(report)) return report;
    // Beyond here such a solution only gets better: nothing that follows makes it a failure.
    const bool solved = stepped_ && converged(false);
    // A chord uses the factors of the round before.
    if (!tangent && !chord) tangent = &system_.tangent(x_);
    // The tolerance of the linear solve follows the convergence (Eisenstat and Walker).
    const LinearReport linear =
        find_direction(chord ? nullptr : tangent, forcing.next(norm_, goal() / norm_));
    tangent = nullptr;
    ++report.iterations;
    if (takes_effort()) ++report.effort;
    report.linear_iterations += linear.iterations;
    if (!linear.converged) return without_direction(solved, linear, std::move(report));
    // The search starts from x, to which it may have to go back.
    const double norm_before = norm_;
    double alpha = 1;
    std::copy(x_.begin(), x_.end(), work_.start.begin());
    if (options_.line_search) {
      alpha = search(descend());
      if (chord && !(norm_ < norm_before)) {
        // The tangent before does not serve here, where a contact that it knew has opened: back, for a new
        // one.
        go_back();
        chord = false;
        continue;
      }
      if (solved && !(norm_ < norm_before)) {
        go_back();
        report.converged = true;
        return report;
      }
      system_.accept(x_, work_.local_step, alpha);
    } else {
      for (std::size_t i = 0; i < x_.size(); ++i) x_[i] += work_.local_step[i];
      system_.accept(x_, work_.local_step, 1.0);
      evaluate();
    }
    // What this round has brought decides about the next one: whether the step is expected to
    // converge, and whether a chord would.
    stepped_ = true;
    falls_ = options_.line_search && norm_ <= k_falls * norm_before;
    measure_next_step(alpha, norm_before);
    chord = options_.chords && !chord && alpha == 1.0 && chord_converges(norm_before);
  }
}

}  // namespace

NewtonReport newton(NonlinearSystem& system, TangentSolver& solver, const parallel::GhostExchange& ghosts,
                    std::span<const int> components, std::span<double> x, const NewtonOptions& options) {
  return Iteration(system, solver, ghosts, components, x, options).run();
}

}  // namespace solidus::linear
