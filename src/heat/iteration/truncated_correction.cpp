/// The linear systems of the truncated Newton method: with the slopes of tangents, and with those of chords.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "heat/iteration/truncated_newton.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "system/profile.hpp"

namespace solidus::heat {

namespace {

constexpr double k_plateau_stiffness =
    1e13;                          ///< times the diagonal: δ = 0 to rounding, without a change of structure
constexpr int k_chord_rounds = 8;  ///< linear solves for one such step
constexpr double k_chord_change = 0.1;    ///< change of the heats by a round, over the heats, that ends them
constexpr double k_chord_forcing = 0.01;  ///< of these linear solves, where the step is not worth less
constexpr double k_chord_differs = 1.5;  ///< a chord that is not so much steeper than the tangent is not used
constexpr double k_kink = 10;  ///< slope of a chord over the tangent's from which on a node stops the others
constexpr double k_chord_holds = 1e8;  ///< times the diagonal: no chord is steeper
constexpr int k_refinements = 8;       ///< directions at most
constexpr double k_refined = 1e-2;  ///< residual of the linear system, over its right-hand side, that will do
constexpr double k_refining = 0.1;  ///< of the systems that find their directions

}  // namespace

/// (D + A) δ = −F, δ in work_.step with its ghosts and A δ in work_.product.
/// @param chords  D of each node in place of the tangent's where it is not zero; infinite: the node is held.
///                Empty: none
linear::LinearReport TruncatedNewton::correct(double forcing, std::span<const float> chords) {
  linear::BlockMatrix& a = system_.matrix();
  const NodalPotential& potential = system_.parts().elements.nodal();
  const auto n = work_.r.size();
  std::vector<char> held(n);
  const bool alone = n == work_.step.size();  // work_.diagonal is that of A then
  std::vector<double> of_a(alone ? 0 : n);
  {
    const profile::Part part("assembly");
    for (std::size_t i = 0; i < n; ++i) {
      const auto node = as_index(i);
      double& diagonal = *a.diagonal_block(node);
      if (!alone) of_a[i] = diagonal;
      double stiffness = chords.empty() ? 0.0 : static_cast<double>(chords[i]);
      if (stiffness == 0)
        stiffness = work_.curve_slope[i] == 0.0 ? HUGE_VAL : 1.0 / (of_step_.dt * work_.curve_slope[i]);
      held[i] = std::isinf(stiffness) || system_.parts().prescribed.fixed()[i] ? 1 : 0;
      if (std::isinf(stiffness))
        diagonal = k_plateau_stiffness *
                   (std::abs(diagonal) + storage_.capacity(node, of_step_.temperature[i]) /
                                             (of_step_.dt * potential.slope(node, of_step_.temperature[i])));
      else
        diagonal += stiffness;
      // A held node has no equation here: its residual must not set the scale of the linear solver.
      work_.product[i] = held[i] ? 0.0 : -work_.r[i];
    }
  }
  system_.parts().conduction.release_work();
  linear::LinearReport report = solver_.solve(a, work_.product, std::span(work_.step).first(n), forcing);
  for (std::size_t i = 0; i < n; ++i)
    if (held[i]) work_.step[i] = 0;
  ghosts_.update(work_.step, 1);
  const bool unsymmetric = parallel::any_process(!system_.parts().unsymmetric.entries().empty());
  if (report.converged && unsymmetric) report.iterations += refine(held, forcing);
  for (std::size_t i = 0; i < n; ++i) *a.diagonal_block(as_index(i)) = alone ? work_.diagonal[i] : of_a[i];
  if (!report.converged) return report;
  multiply_exactly(work_.step, work_.product, {});
  return report;
}

/// product = (D + A + what A lacks of the derivative) step, without the rows that are held.
void TruncatedNewton::multiply_exactly(std::span<double> step, std::span<double> product,
                                       std::span<const char> held) {
  system_.matrix().multiply(step, product);
  for (const UnsymmetricPart::Entry& e : system_.parts().unsymmetric.entries())
    product[as_size(e.row)] += e.value * step[as_size(e.column)];
  for (std::size_t i = 0; i < held.size(); ++i)
    if (held[i]) product[i] = 0;
}

/// Improves work_.step, which solves the symmetric system with the right-hand side in work_.product, to a
/// solution of that with the derivative itself, by generalised conjugate residuals (S. C. Eisenstat, H. C.
/// Elman and M. H. Schultz, SIAM J. Numer. Anal. 20 (1983) 345): each direction solves the symmetric system
/// for the residual that is left. Returns the linear iterations.
int TruncatedNewton::refine(std::span<const char> held, double forcing) {
  const std::size_t n = work_.r.size();
  const auto dot = [n](std::span<const double> a, std::span<const double> b) {
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) sum += a[i] * b[i];
    return parallel::global_sum(sum);
  };
  const auto add = [](double factor, const std::vector<double>& x, std::span<double> y) {
    for (std::size_t i = 0; i < y.size(); ++i) y[i] += factor * x[i];
  };
  // The residual of the derivative itself after the step of the symmetric system.
  std::vector<double> left(n);
  multiply_exactly(work_.step, left, held);
  for (std::size_t i = 0; i < n; ++i) left[i] = work_.product[i] - left[i];
  // Nothing is gained by refining below what the outer iteration asks for.
  const double target = std::max(forcing, k_refined) * std::sqrt(dot(work_.product, work_.product));
  struct Direction {
    std::vector<double> step, product;  ///< the products are orthonormal
  };
  std::vector<Direction> directions;
  int iterations = 0;
  // Each further direction is one solution of the symmetric system, whose preconditioner is at
  // hand.
  for (int k = 0; k < k_refinements && std::sqrt(dot(left, left)) > target; ++k) {
    Direction d{std::vector<double>(work_.step.size()), std::vector<double>(n)};
    const linear::LinearReport report = solver_.solve_again(left, std::span(d.step).first(n), k_refining);
    iterations += report.iterations;
    if (!report.converged) break;
    for (std::size_t i = 0; i < n; ++i)
      if (held[i]) d.step[i] = 0;
    ghosts_.update(d.step, 1);
    multiply_exactly(d.step, d.product, held);
    // Its image is made orthogonal to those before, and the direction with it, so that the residual
    // falls along each one separately.
    for (const Direction& before : directions) {
      const double along = dot(before.product, d.product);
      add(-along, before.step, d.step);
      add(-along, before.product, d.product);
    }
    const double length = std::sqrt(dot(d.product, d.product));
    if (!(length > 0)) break;
    for (auto* v : {&d.step, &d.product})
      for (double& value : *v) value /= length;
    // The share is the projection of the residual that is left.
    const double share = dot(left, d.product);
    add(share, d.step, work_.step);
    add(-share, d.product, left);
    directions.push_back(std::move(d));
  }
  return iterations;
}

/// The slopes D = ΔH/(Δt δ) of the chords of the nodes' curves over the steps of now, where the tangents are
/// less steep or there are none; zero elsewhere.
void TruncatedNewton::find_chords(std::span<float> chords) const {
  const NodalPotential& potential = system_.parts().elements.nodal();
  for (std::size_t i = 0; i < work_.r.size(); ++i) {
    chords[i] = 0;
    if (system_.parts().prescribed.fixed()[i] || work_.step[i] == 0) continue;
    const auto node = as_index(i);
    const double slope = storage_.point(node, of_step_.heat[i]).slope,
                 c = potential.slope(node, of_step_.temperature[i]);
    const double v = potential.value(node, of_step_.temperature[i]) + work_.step[i];
    const double t = potential.temperature(node, v, of_step_.temperature[i]);
    const double end = work_.step[i] < 0 ? storage_.upper(node, t) : storage_.lower(node, t);
    const double chord = (end - of_step_.heat[i]) / (of_step_.dt * work_.step[i]);
    if (slope > 0 && chord <= k_chord_differs / (of_step_.dt * slope * c)) continue;
    const double usual =
        work_.diagonal[i] + storage_.capacity(node, of_step_.temperature[i]) / (of_step_.dt * c);
    // A step within rounding of the plateau's temperature has a chord of either sign. So steep a chord holds
    // the node but lets a later round see which way it wants to go.
    chords[i] =
        static_cast<float>(chord > 0 ? std::min(chord, k_chord_holds * usual) : k_chord_holds * usual);
  }
}

/// Solves (D + A) δ = −F with D the slope of the chord of each node's curve over δ itself, by repetition. It
/// begins without plateaus: their nodes have the capacity of their temperature.
linear::LinearReport TruncatedNewton::correct_by_chords(double forcing) {
  const NodalPotential& potential = system_.parts().elements.nodal();
  // Nodes on a plateau have slope zero, their chord would be infinite: they begin with the capacity
  // of their temperature.
  std::vector<float> chords(work_.r.size()), before(work_.r.size());
  for (std::size_t i = 0; i < work_.r.size(); ++i) {
    const auto node = as_index(i);
    if (storage_.point(node, of_step_.heat[i]).slope == 0)
      chords[i] = static_cast<float>(storage_.capacity(node, of_step_.temperature[i]) /
                                     (of_step_.dt * potential.slope(node, of_step_.temperature[i])));
  }
  // A chord depends on the step that it gives, so both are repeated until the heat that they store
  // changes little.
  linear::LinearReport report;
  int iterations = 0;
  for (int round = 0; round < k_chord_rounds; ++round) {
    if (round > 0) find_chords(chords);
    std::transform(work_.step.begin(), work_.step.begin() + static_cast<std::ptrdiff_t>(before.size()),
                   before.begin(), [](double step) { return static_cast<float>(step); });
    report = correct(std::max(forcing, k_chord_forcing), chords);
    report.iterations = iterations += report.iterations;
    if (!report.converged || round == 0) {
      if (!report.converged) break;
      continue;
    }
    // Changes count in heat (chord times step), summed over all nodes.
    double change = 0, all = 0;
    for (std::size_t i = 0; i < work_.r.size(); ++i) {
      const auto node = as_index(i);
      const double slope = storage_.point(node, of_step_.heat[i]).slope;
      const double d = chords[i] > 0 && std::isfinite(chords[i]) ? static_cast<double>(chords[i])
                       : slope > 0                               ? 1.0 / (of_step_.dt * slope)
                                                                 : 0.0;
      change += d * std::abs(work_.step[i] - static_cast<double>(before[i]));
      all += d * std::abs(work_.step[i]);
    }
    if (parallel::global_sum(change) <= k_chord_change * parallel::global_sum(all)) break;
  }
  return report;
}

/// The tangents' step once more, where the line search cut it short, with those nodes held that pass a
/// plateau or a bend within the first part of the step. A node that has come close to the end of a plateau
/// and is driven on to it would stop all others there; what it lacks is left to the sweeps.
linear::LinearReport TruncatedNewton::correct_beside_kinks(double forcing) {
  std::vector<float> chords(work_.r.size());
  for (std::size_t i = 0; i < work_.r.size(); ++i) {
    if (work_.step[i] == 0 || work_.curve_slope[i] == 0) continue;
    const double part = k_stuck_step * work_.step[i];
    const StorageCurve::AtPotential at =
        curves_.at_potential(as_index(i), work_.potential[i] + part, of_step_.temperature[i]);
    const double end = work_.step[i] < 0 ? at.upper : at.lower;
    if ((end - of_step_.heat[i]) / part > k_kink / work_.curve_slope[i]) chords[i] = HUGE_VALF;
  }
  return correct(forcing, chords);
}

}  // namespace solidus::heat
