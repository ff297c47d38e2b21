#include "heat/truncated_newton.hpp"

#include <algorithm>
#include <cmath>

#include "heat/local_sweeps.hpp"
#include "heat/plateau_watch.hpp"
#include "linear/forcing.hpp"
#include "parallel/parallel.hpp"
#include "system/profile.hpp"

namespace solidus::heat {

namespace {

constexpr double k_round_off = 2e-15;  ///< of heat contents and of conductance × temperature
constexpr double k_plateau_stiffness =
    1e13;                           ///< times the diagonal: δ = 0 to rounding, without a change of structure
constexpr double k_relaxed = 1e-3;  ///< share of a node's own residual after a sweep
constexpr double k_negligible = 1e-1;   ///< share of the tolerance that nodes which are not relaxed may have
constexpr int k_relaxations = 60;       ///< evaluations of a node's curve in one visit
constexpr double k_accept_rise = 0.5;   ///< the full step stands if E rises behind it by at most this share
constexpr double k_accept_slope = 0.1;  ///< a shortened step ends where the slope of E is this share
constexpr int k_search_trials = 20;
constexpr double k_limit_change = 1e-2;  ///< of flows by new limits, over the heat moved, that stays out
constexpr int k_revisions = 1;           ///< of limits by flows
constexpr int k_holds = 20;              ///< and by temperatures out of range
constexpr int k_idle = 4;  ///< such revisions that find no further nodes: what the tolerance has left goes
constexpr double k_short = 0.2;          ///< length of a step below which it is found anew by chords
constexpr int k_chord_rounds = 8;        ///< linear solves for one such step
constexpr double k_chord_change = 0.1;   ///< change of the heats by a round, over the heats, that ends them
constexpr double k_chord_forcing = 0.1;  ///< of these linear solves, where the step is not worth less
constexpr double k_chord_differs = 1.5;  ///< a chord that is not so much steeper than the tangent is not used
constexpr double k_chord_holds = 1e8;    ///< times the diagonal: no chord is steeper
constexpr double k_chord_worth = 0.5;    ///< share of the residual left up to which chords are used again

}  // namespace

TruncatedNewton::TruncatedNewton(const mesh::Mesh& mesh, HeatSystem& system, const NodalEnthalpy& storage,
                                 HeatSolver& solver, const parallel::GhostExchange& ghosts,
                                 TruncatedNewtonOptions options, std::vector<char> relaxed)
    : mesh_(mesh),
      system_(system),
      storage_(storage),
      solver_(solver),
      ghosts_(ghosts),
      options_(options),
      relaxed_(std::move(relaxed)) {
  const auto n = static_cast<std::size_t>(mesh.n_owned_nodes);
  for (auto* v : {&r_, &diagonal_, &product_, &b_, &from_heat_, &from_temperature_, &from_}) v->resize(n);
  step_.resize(mesh.x.size());
  slope_.assign(mesh.x.size(), 1.0);
}

void TruncatedNewton::evaluate() {
  const profile::Part part("residual");
  double moved = system_.residual(temperature_, r_), norm = 0, contents = 0;
  const std::vector<char>& fixed = system_.fixed();
  for (std::size_t i = 0; i < r_.size(); ++i) {
    const double stored = (heat_[i] - old_heat_[i]) / dt_;
    r_[i] += stored;
    moved += std::abs(stored);
    contents += std::abs(heat_[i]) / dt_;
    (fixed[i] ? moved : norm) += std::abs(r_[i]);
  }
  norm_ = parallel::global_sum(norm);
  moved_ = 0.5 * parallel::global_sum(moved);  // what enters somewhere is stored or leaves somewhere else
  round_off_ = k_round_off * (parallel::global_sum(contents) + conductance_);
}

/// A at the temperatures of now.
void TruncatedNewton::assemble() {
  const profile::Part part("assembly");
  const NodalPotential& potential = system_.potential();
  if (!potential.identity()) {
    for (std::size_t i = 0; i < r_.size(); ++i)
      slope_[i] = potential.slope(static_cast<Index>(i), temperature_[i]);
    ghosts_.update(slope_, 1);
  }
  system_.assemble_symmetric(temperature_, slope_);
  linear::BlockMatrix& a = system_.matrix();
  double conductance = 0;
  for (std::size_t i = 0; i < r_.size(); ++i) {
    diagonal_[i] = *a.diagonal_block(static_cast<Index>(i));
    conductance += std::abs(diagonal_[i] * slope_[i] * temperature_[i]);
  }
  conductance_ = parallel::global_sum(conductance);
  if (r_.size() == mesh_.x.size()) return;
  const std::span<const std::int64_t> start = a.row_start();
  const std::span<const Index> columns = a.columns();
  const double* values = a.block(0);
  for (std::size_t i = 0; i < r_.size(); ++i)
    for (std::int64_t s = start[i]; s < start[i + 1]; ++s)
      if (columns[static_cast<std::size_t>(s)] >= mesh_.n_owned_nodes) diagonal_[i] += std::abs(values[s]);
}

/// Solves the equation of one node, F_i + (H − H_i)/Δt + A_ii (v(H) − v_i) = 0, for its H; returns the change
/// of v. The left-hand side rises with H, at 1/Δt at least: Newton's method, within a bracket as soon as
/// there is one.
double TruncatedNewton::relax(std::size_t i, double residual) {
  if (std::abs(residual) <= negligible_ || system_.fixed()[i] || (!relaxed_.empty() && relaxed_[i] == 0))
    return 0;
  const auto node = static_cast<Index>(i);
  const NodalPotential& potential = system_.potential();
  const double a = std::max(diagonal_[i], 0.0), h0 = heat_[i], v0 = potential.value(node, temperature_[i]);
  NodalEnthalpy::Point at = storage_.point(node, h0);
  double low = -HUGE_VAL, high = HUGE_VAL, h = h0, v = v0, defect = residual;
  for (int trial = 0; trial < k_relaxations; ++trial) {
    (defect > 0 ? high : low) = h;
    const double slope =
        1.0 / dt_ + (at.slope > 0 ? a * at.slope * potential.slope(node, at.temperature) : 0.0);
    double next = h - defect / slope;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (!std::isfinite(next) || next == h) break;
    h = next;
    at = storage_.point(node, h);
    v = potential.value(node, at.temperature);
    defect = residual + (h - h0) / dt_ + a * (v - v0);
    if (std::abs(defect) <= k_relaxed * std::abs(residual)) break;
  }
  const double t = at.temperature;
  heat_[i] = h;
  temperature_[i] = t;
  return v - v0;
}

void TruncatedNewton::sweep(Order order) {
  const linear::BlockMatrix& a = system_.matrix();
  const std::span<const std::int64_t> start = a.row_start();
  const std::span<const Index> columns = a.columns();
  const double* values = a.block(0);
  const auto n = r_.size();
  for (std::size_t i = 0; i < n; ++i) from_heat_[i] = heat_[i];
  // A row has its later columns in either storage: going forward they take what a change makes of their
  // residuals, going backward the row takes what theirs have made.
  if (order == Order::forward) {
    std::copy(r_.begin(), r_.end(), b_.begin());
    for (std::size_t i = 0; i < n; ++i) {
      const double change = step_[i] = relax(i, b_[i]);
      if (change == 0) continue;
      for (std::int64_t s = start[i]; s < start[i + 1]; ++s) {
        const auto j = static_cast<std::size_t>(columns[static_cast<std::size_t>(s)]);
        if (j > i && j < n) b_[j] += values[s] * change;
      }
    }
  } else {
    for (std::size_t i = n; i-- > 0;) {
      double residual = r_[i];
      for (std::int64_t s = start[i]; s < start[i + 1]; ++s) {
        const auto j = static_cast<std::size_t>(columns[static_cast<std::size_t>(s)]);
        if (j > i && j < n) residual += values[s] * step_[j];
      }
      step_[i] = relax(i, residual);
    }
  }
  follow(step_);
}

void TruncatedNewton::follow(std::span<double> step) {
  ghosts_.update(step, 1);
  system_.matrix().multiply(step, product_);
  for (std::size_t i = 0; i < r_.size(); ++i) r_[i] += (heat_[i] - from_heat_[i]) / dt_ + product_[i];
}

/// (D + A) δ = −F, δ in step_ with its ghosts and A δ in product_.
/// @param chords  D of each node in place of the tangent's where it is not zero; infinite: the node is held.
///                Empty: none
linear::LinearReport TruncatedNewton::correct(double forcing, std::span<const double> chords) {
  linear::BlockMatrix& a = system_.matrix();
  const auto n = r_.size();
  const NodalPotential& potential = system_.potential();
  std::vector<char> held(n);
  std::vector<double> of_a(n);  // its diagonal, without D
  {
    const profile::Part part("assembly");
    for (std::size_t i = 0; i < n; ++i) {
      const auto node = static_cast<Index>(i);
      double& diagonal = *a.diagonal_block(node);
      of_a[i] = diagonal;
      double stiffness = chords.empty() ? 0.0 : chords[i];
      if (stiffness == 0) {
        const double slope = storage_.point(node, heat_[i]).slope;
        stiffness = slope == 0.0 ? HUGE_VAL : 1.0 / (dt_ * slope * potential.slope(node, temperature_[i]));
      }
      held[i] = std::isinf(stiffness) || system_.fixed()[i] ? 1 : 0;
      if (std::isinf(stiffness))
        diagonal = k_plateau_stiffness *
                   (std::abs(diagonal) + storage_.capacity(node, temperature_[i]) / (dt_ * slope_[i]));
      else
        diagonal += stiffness;
      // A held node has no equation here: its residual must not set the scale of the linear solver.
      b_[i] = held[i] ? 0.0 : -r_[i];
    }
  }
  const linear::LinearReport report = solver_.solve(a, b_, std::span(step_).first(n), forcing);
  for (std::size_t i = 0; i < n; ++i) {
    *a.diagonal_block(static_cast<Index>(i)) = of_a[i];
    if (held[i]) step_[i] = 0;
  }
  if (!report.converged) return report;
  ghosts_.update(step_, 1);
  a.multiply(step_, product_);
  return report;
}

/// The slopes D = ΔH/(Δt δ) of the chords of the nodes' curves over the steps of now, where the tangents are
/// less steep or there are none; zero elsewhere.
void TruncatedNewton::find_chords(std::span<double> chords) const {
  const NodalPotential& potential = system_.potential();
  for (std::size_t i = 0; i < r_.size(); ++i) {
    chords[i] = 0;
    if (system_.fixed()[i] || step_[i] == 0) continue;
    const auto node = static_cast<Index>(i);
    const double slope = storage_.point(node, heat_[i]).slope, c = potential.slope(node, temperature_[i]);
    const double v = potential.value(node, temperature_[i]) + step_[i];
    const double t = potential.temperature(node, v, temperature_[i]);
    const double end = step_[i] < 0 ? storage_.upper(node, t) : storage_.lower(node, t);
    const double chord = (end - heat_[i]) / (dt_ * step_[i]);
    if (slope > 0 && chord <= k_chord_differs / (dt_ * slope * c)) continue;
    const double usual = diagonal_[i] + storage_.capacity(node, temperature_[i]) / (dt_ * c);
    // A step within rounding of the plateau's temperature has a chord of either sign. So steep a chord holds
    // the node but lets a later round see which way it wants to go.
    chords[i] = chord > 0 ? std::min(chord, k_chord_holds * usual) : k_chord_holds * usual;
  }
}

/// Solves (D + A) δ = −F with D the slope of the chord of each node's curve over δ itself, by repetition. It
/// begins without plateaus: their nodes have the capacity of their temperature.
linear::LinearReport TruncatedNewton::correct_by_chords(double forcing) {
  const NodalPotential& potential = system_.potential();
  std::vector<double> chords(r_.size()), before(r_.size());
  for (std::size_t i = 0; i < r_.size(); ++i) {
    const auto node = static_cast<Index>(i);
    if (storage_.point(node, heat_[i]).slope == 0)
      chords[i] = storage_.capacity(node, temperature_[i]) / (dt_ * potential.slope(node, temperature_[i]));
  }
  linear::LinearReport report;
  int iterations = 0;
  for (int round = 0; round < k_chord_rounds; ++round) {
    if (round > 0) find_chords(chords);
    std::copy_n(step_.begin(), before.size(), before.begin());
    report = correct(std::max(forcing, k_chord_forcing), chords);
    report.iterations = iterations += report.iterations;
    if (!report.converged || round == 0) {
      if (!report.converged) break;
      continue;
    }
    double change = 0, all = 0;
    for (std::size_t i = 0; i < r_.size(); ++i) {
      const auto node = static_cast<Index>(i);
      const double slope = storage_.point(node, heat_[i]).slope;
      const double d = chords[i] > 0 && std::isfinite(chords[i]) ? chords[i]
                       : slope > 0                               ? 1.0 / (dt_ * slope)
                                                                 : 0.0;
      change += d * std::abs(step_[i] - before[i]);
      all += d * std::abs(step_[i]);
    }
    if (parallel::global_sum(change) <= k_chord_change * parallel::global_sum(all)) break;
  }
  return report;
}

/// Takes the nodes to v + α δ from where the search begins.
void TruncatedNewton::move(double alpha) {
  const NodalPotential& potential = system_.potential();
  for (std::size_t i = 0; i < r_.size(); ++i) {
    if (step_[i] == 0) continue;
    const auto node = static_cast<Index>(i);
    const double t = potential.temperature(node, from_[i] + alpha * step_[i], from_temperature_[i]);
    temperature_[i] = t;
    heat_[i] = step_[i] < 0 ? storage_.upper(node, t) : storage_.lower(node, t);
  }
}

/// The same, and dE/dα there for the A of now.
double TruncatedNewton::linear_slope(double alpha) {
  move(alpha);
  double sum = 0;
  for (std::size_t i = 0; i < r_.size(); ++i)
    if (step_[i] != 0) sum += step_[i] * (r_[i] + (heat_[i] - from_heat_[i]) / dt_ + alpha * product_[i]);
  return parallel::global_sum(sum);
}

/// The same for F itself, which is evaluated.
double TruncatedNewton::true_slope(double alpha) {
  move(alpha);
  ghosts_.update(temperature_, 1);
  evaluate();
  return slope_along_step();
}

double TruncatedNewton::slope_along_step() const {
  double sum = 0;
  for (std::size_t i = 0; i < r_.size(); ++i) sum += step_[i] * r_[i];
  return parallel::global_sum(sum);
}

/// Goes to the least E along δ, to a tenth of its slope at the start; leaves F there.
/// @param short_too  false: a short step is not taken; nothing has changed then but what the next step writes
/// @return whether the step was taken
bool TruncatedNewton::search(bool short_too) {
  const profile::Part part("line search");
  const NodalPotential& potential = system_.potential();
  for (std::size_t i = 0; i < r_.size(); ++i) {
    from_heat_[i] = heat_[i];
    from_temperature_[i] = temperature_[i];
    from_[i] = potential.value(static_cast<Index>(i), temperature_[i]);
  }
  const double start = slope_along_step();
  const double alpha = minimise(start, 1.0, &TruncatedNewton::linear_slope);
  if (alpha < k_short && !short_too) {
    for (std::size_t i = 0; i < r_.size(); ++i) {
      heat_[i] = from_heat_[i];
      temperature_[i] = from_temperature_[i];
    }
    return false;
  }
  // A holds the terms that are not linear in v by their derivatives only: the step must be checked with F
  // itself.
  const double slope = true_slope(alpha);
  if (start < 0 && !(slope <= -k_accept_rise * start)) minimise(start, alpha, &TruncatedNewton::true_slope);
  return true;
}

/// @param start   dE/dα at zero
/// @param longest  α that is tried first
double TruncatedNewton::minimise(double start, double longest, double (TruncatedNewton::*slope_at)(double)) {
  double low = 0, low_slope = start, high = longest, high_slope = (this->*slope_at)(longest), alpha = longest;
  if (!(start < 0) || high_slope <= -k_accept_rise * start) return longest;
  int side = 0;
  for (int trial = 0; trial < k_search_trials; ++trial) {
    // The Illinois rule, kept inside the bracket.
    alpha = std::isfinite(high_slope) ? (low * high_slope - high * low_slope) / (high_slope - low_slope)
                                      : 0.5 * (low + high);
    alpha = std::clamp(alpha, low + 0.05 * (high - low), high - 0.05 * (high - low));
    const double slope = (this->*slope_at)(alpha);
    if (std::abs(slope) <= -k_accept_slope * start) break;
    if (slope < 0) {
      low = alpha;
      low_slope = slope;
      if (side == 1) high_slope *= 0.5;
      side = 1;
    } else {
      high = alpha;
      high_slope = slope;
      if (side == -1) low_slope *= 0.5;
      side = -1;
    }
  }
  return alpha;
}

/// The sweeps, with A at the temperatures of now, and F there. What A holds by derivatives only (films and
/// radiation where conductivities vary, nodes of several materials) has bent under the sweeps: a step that
/// starts from the residuals of the linear A points elsewhere, and no length of it brings F down.
/// @param all  every node, however small its residual is
void TruncatedNewton::relax_nodes(bool all) {
  assemble();
  {
    const profile::Part part("sweeps");
    negligible_ =
        all ? 0 : k_negligible * options_.tolerance * moved_ / static_cast<double>(mesh_.n_global_nodes);
    sweep(Order::forward);
    sweep(Order::backward);
  }
  const double swept = linear_ ? relax_locally() : HUGE_VAL;
  ghosts_.update(temperature_, 1);
  evaluate();
  if (norm_ > swept) linear_ = false;
}

/// Sweeps on over the nodes where F is concentrated; returns Σ|F_i| before that. Where F is found to be
/// larger afterwards, A tells too little of it: such sweeps are then left out for the rest of the step.
double TruncatedNewton::relax_locally() {
  const profile::Part part("sweeps");
  LocalSweeps local(system_.matrix(), r_, system_.fixed());
  negligible_ = 0;
  local.run([this](std::size_t i, double residual) {
    const double heat = heat_[i], change = relax(i, residual);
    return NodeChange{change, (heat_[i] - heat) / dt_};
  });
  return local.sum();
}

/// Looks at the limits of conduction at the temperatures reached. Returns whether the iteration has to go on
/// with others: when flows change too much, and then when temperatures are out of range.
bool TruncatedNewton::revise_limits(const TemperatureRange& range) {
  if (revisions_ < k_revisions && system_.find_limits(temperature_, k_limit_change * moved_)) {
    ++revisions_;
    return true;
  }
  if (revisions_ >= k_revisions + k_holds) return false;
  using Held = ConductionLimiter::Held;
  const Held held = system_.hold_nodes(temperature_, range);
  if (held == Held::none || (held == Held::as_before && ++idle_ > k_idle)) return false;
  revisions_ = std::max(revisions_, k_revisions) + 1;
  system_.find_limits(temperature_);
  return true;
}

linear::NewtonReport TruncatedNewton::solve(std::span<const double> old_heat, double dt,
                                            std::span<double> temperature, std::span<double> heat,
                                            const TemperatureRange& range, int newton_steps) {
  old_heat_ = old_heat;
  heat_ = heat;
  temperature_ = temperature;
  dt_ = dt;
  conductance_ = 0;
  revisions_ = idle_ = 0;
  linear_ = true;
  PlateauWatch watch(mesh_, storage_, system_.matrix());
  watch.passed_in_depth(heat_, temperature_);
  bool by_chords = false;
  double norm_before = 0;
  const int most = newton_steps > 0 ? newton_steps : options_.max_iterations;
  linear::Forcing forcing(true);
  linear::NewtonReport report;
  bool revised = false;
  evaluate();
  while (true) {
    report.residuals.push_back(moved_ > 0 ? norm_ / moved_ : norm_);
    if (std::isfinite(norm_) && (!converged() || revised)) relax_nodes(revised);
    revised = false;
    if (!std::isfinite(norm_)) {
      report.reason = "the residual is not a number";
      break;
    }
    if (converged()) {
      report.residuals.back() = moved_ > 0 ? norm_ / moved_ : norm_;
      report.converged = true;
      if (newton_steps > 0 || !revise_limits(range)) break;
      report.converged = false;
      revised = true;
      evaluate();
      continue;
    }
    if (report.iterations == most) {
      evaluate();
      report.out_of_iterations = true;
      report.reason = "no convergence in " + std::to_string(most) + " iterations";
      break;
    }
    ++report.iterations;
    const double to = forcing.next(norm_, options_.tolerance * moved_ / norm_);
    const bool in_depth = watch.passed_in_depth(heat_, temperature_);
    const bool may_use_chords =
        storage_.has_plateaus() && !(by_chords && norm_ > k_chord_worth * norm_before);
    norm_before = norm_;
    by_chords = may_use_chords && in_depth;
    linear::LinearReport linear = by_chords ? correct_by_chords(to) : correct(to);
    report.linear_iterations += linear.iterations;
    if (linear.converged && !search(by_chords || !may_use_chords)) {
      by_chords = true;
      linear = correct_by_chords(to);
      report.linear_iterations += linear.iterations;
      if (linear.converged) search(true);
    }
    if (!linear.converged) {
      report.reason = "linear solver: " + linear.reason;
      break;
    }
  }
  ghosts_.update(heat, 1);
  return report;
}

}  // namespace solidus::heat
