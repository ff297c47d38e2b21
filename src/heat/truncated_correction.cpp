/// The linear systems of the truncated Newton method: with the slopes of tangents, and with those of chords.
#include <algorithm>
#include <cmath>

#include "heat/truncated_newton.hpp"
#include "parallel/parallel.hpp"
#include "system/profile.hpp"

namespace solidus::heat {

namespace {

constexpr double k_plateau_stiffness =
    1e13;                          ///< times the diagonal: δ = 0 to rounding, without a change of structure
constexpr int k_chord_rounds = 8;  ///< linear solves for one such step
constexpr double k_chord_change = 0.1;   ///< change of the heats by a round, over the heats, that ends them
constexpr double k_chord_forcing = 0.1;  ///< of these linear solves, where the step is not worth less
constexpr double k_chord_differs = 1.5;  ///< a chord that is not so much steeper than the tangent is not used
constexpr double k_chord_holds = 1e8;    ///< times the diagonal: no chord is steeper

}  // namespace

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

}  // namespace solidus::heat
