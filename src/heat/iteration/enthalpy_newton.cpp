/// The steps of one iteration in the order of their calls: residual, tangent by enthalpy, the step by
/// temperatures, the change of the enthalpies along it.
#include "heat/iteration/enthalpy_newton.hpp"

#include <algorithm>
#include <cmath>

#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "system/profile.hpp"

namespace solidus::heat {

namespace {

constexpr double k_round_off = 2e-15;  ///< of heat contents and of conductance × temperature
constexpr double k_plateau_stiffness =
    1e13;  ///< times the diagonal: δΘ = 0 to rounding, without a change of structure

constexpr int k_plain = 6;                ///< iterations before plateaus are tilted
constexpr double k_tilt = 1.0;            ///< temperature difference over a tilted plateau [K]
constexpr double k_tilted_enough = 1e-2;  ///< residual over the heat moved at which the tilt goes
constexpr int k_tilted_at_most = 8;       ///< iterations with one tilt
constexpr double k_less_tilt = 0.3, k_least_tilt = 2e-3;  ///< its fall, and where it ends [K]

}  // namespace

EnthalpyNewton::EnthalpyNewton(const mesh::Mesh& mesh, HeatSystem& system, const NodalEnthalpy& storage,
                               const parallel::GhostExchange& ghosts, double tolerance)
    : system_(system), storage_(storage), ghosts_(ghosts), tolerance_(tolerance) {
  const auto n = as_size(mesh.n_owned_nodes);
  for (auto* v : {&r_, &b_, &step_h_, &inverse_}) v->resize(n);
  plateaus_.per_latent.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double latent = storage_.latent_capacity(as_index(i));
    plateaus_.per_latent[i] = latent > 0 ? 1.0 / latent : 0.0;
  }
  plateaus_.any = parallel::any_process(storage.has_plateaus());
}

void EnthalpyNewton::evaluate(std::span<const double> temperature) {
  const profile::Part part("residual");
  double moved = system_.residual(temperature, r_), norm = 0, contents = 0;
  const std::vector<char>& fixed = system_.parts().prescribed.fixed();
  // Stored heat joins the flows; at prescribed temperatures the residual is a reaction, elsewhere it must
  // vanish.
  for (std::size_t i = 0; i < r_.size(); ++i) {
    const double stored = (heat_[i] - old_heat_[i]) / dt_;
    r_[i] += stored;
    moved += std::abs(stored);
    contents += std::abs(heat_[i]) / dt_;
    (fixed[i] ? moved : norm) += std::abs(r_[i]);
  }
  sums_.unbalanced = parallel::global_sum(norm);
  sums_.moved =
      0.5 * parallel::global_sum(moved);  // what enters somewhere is stored or leaves somewhere else
  sums_.round_off = k_round_off * (parallel::global_sum(contents) + sums_.conductance);
}

/// The temperature at an enthalpy; a tilted plateau rises by a small slope, so that it has an inverse.
double EnthalpyNewton::temperature_of(std::size_t i, double heat) const {
  const double t = storage_.temperature(as_index(i), heat);
  return plateaus_.tilt > 0 ? t + tilt(i) * (heat - old_heat_[i]) : t;
}

/// Sets or removes the tilt of the plateaus, and updates all that depends on it.
void EnthalpyNewton::set_tilt(double tilt, std::span<double> temperature) {
  plateaus_.tilt = tilt;
  for (std::size_t i = 0; i < r_.size(); ++i)
    if (!system_.parts().prescribed.fixed()[i]) temperature[i] = temperature_of(i, heat_[i]);
  ghosts_.update(temperature, 1);
  evaluate(temperature);
}

/// The residual is small compared with the heat that moves, or has reached rounding. With a tilt the
/// equations are not yet those of the step.
bool EnthalpyNewton::converged() const {
  if (plateaus_.tilt > 0) return false;
  return sums_.unbalanced <= tolerance_ * sums_.moved || sums_.unbalanced <= sums_.round_off;
}

/// J + D; nodes on a plateau are held.
void EnthalpyNewton::assemble(std::span<const double> temperature) {
  const profile::Part part("assembly");
  system_.assemble(temperature);
  double conductance = 0;
  for (std::size_t i = 0; i < r_.size(); ++i) {
    const auto node = as_index(i);
    double& diagonal = *system_.matrix().diagonal_block(node);
    conductance += std::abs(diagonal * temperature[i]);
    inverse_[i] = storage_.slope(node, heat_[i]) + tilt(i);
    const bool held = inverse_[i] == 0.0;
    const double capacity = held ? storage_.capacity(node, temperature[i]) : 1.0 / inverse_[i];
    if (held)
      diagonal = k_plateau_stiffness * (std::abs(diagonal) + capacity / dt_);
    else
      diagonal += capacity / dt_;
    // A held node has no equation here: its residual must not set the scale of the linear solver.
    b_[i] = held || system_.parts().prescribed.fixed()[i] ? 0.0 : -r_[i];
  }
  sums_.conductance = parallel::global_sum(conductance);
}

/// Temperatures of nodes on a plateau and of prescribed ones do not change in this iteration.
void EnthalpyNewton::hold(std::span<double> step_t) const {
  for (std::size_t i = 0; i < step_t.size(); ++i)
    if (inverse_[i] == 0.0 || system_.parts().prescribed.fixed()[i]) step_t[i] = 0.0;
}

/// The change of enthalpy that belongs to a step of temperatures: by the slope of the table, and for nodes on
/// a plateau by what the balance of their heat leaves.
void EnthalpyNewton::enthalpy_step(std::span<const double> step_t, std::span<const double> further) {
  system_.matrix().multiply(step_t, step_h_);
  for (std::size_t i = 0; i < r_.size(); ++i) {
    const double change = step_h_[i] + (further.empty() ? 0.0 : further[i]);
    if (system_.parts().prescribed.fixed()[i])
      step_h_[i] = 0;
    else
      step_h_[i] = inverse_[i] == 0.0 ? -dt_ * (r_[i] + change) : step_t[i] / inverse_[i];
  }
}

/// Enthalpies go a part alpha of the step; temperatures follow from them, so that both agree at every node.
void EnthalpyNewton::move(std::span<const double> start, double alpha, std::span<double> temperature) {
  for (std::size_t i = 0; i < r_.size(); ++i) {
    if (system_.parts().prescribed.fixed()[i]) continue;
    heat_[i] = start[i] + alpha * step_h_[i];
    temperature[i] = temperature_of(i, heat_[i]);
  }
}

/// Plateaus are tilted when the plain iteration takes long; the tilt falls each time that the tilted
/// equations are nearly solved, and goes at its least value.
void EnthalpyNewton::adapt_tilt(int iteration, std::span<double> temperature) {
  if (plateaus_.any && iteration == k_plain) {
    set_tilt(k_tilt, temperature);
    plateaus_.tilted = 0;
  } else if (plateaus_.tilt > 0 &&
             (sums_.unbalanced <= k_tilted_enough * sums_.moved || ++plateaus_.tilted == k_tilted_at_most)) {
    set_tilt(plateaus_.tilt > k_least_tilt ? k_less_tilt * plateaus_.tilt : 0.0, temperature);
    plateaus_.tilted = 0;
  }
}

void EnthalpyNewton::begin(std::span<const double> old_heat, double dt, std::span<double> heat) {
  old_heat_ = old_heat;
  heat_ = heat;
  dt_ = dt;
  sums_.conductance = 0;
  plateaus_.tilt = 0;
  plateaus_.tilted = 0;
}

}  // namespace solidus::heat
