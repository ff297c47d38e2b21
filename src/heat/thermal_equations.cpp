/// Both rules of storage have their own unknowns; which one holds is asked of the parts in every step.
#include "heat/thermal_equations.hpp"

#include <cmath>

#include "heat/iteration/enthalpy_newton.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"

namespace solidus::heat {

ThermalEquations::ThermalEquations(ThermalParts& parts, ThermalState& now) : parts_(parts), now_(now) {}

ThermalEquations::~ThermalEquations() = default;

double ThermalEquations::tolerance() const {
  const double given = parts_.options.tolerance;
  return given > 0 ? given : parts_.nodal() ? k_nodal_tolerance : k_point_tolerance;
}

void ThermalEquations::begin(std::span<const double> stored_from, double dt) {
  stored_from_ = stored_from;
  dt_ = dt;
  if (!parts_.nodal()) {
    residual_.resize(as_size(parts_.mesh.n_owned_nodes));
    return;
  }
  newton_ = std::make_unique<EnthalpyNewton>(parts_.mesh, *parts_.system, *parts_.storage, parts_.ghosts,
                                             tolerance());
  restart();
}

void ThermalEquations::restart() {
  if (parts_.nodal()) newton_->begin(stored_from_, dt_, now_.enthalpy);
}

void ThermalEquations::evaluate() {
  if (parts_.nodal()) {
    newton_->evaluate(now_.temperature);
    unbalanced_ = newton_->sums().unbalanced;
    return;
  }
  parts_.temperature_system->residual(now_.temperature, residual_);
  double sum = 0;
  for (std::size_t i = 0; i < residual_.size(); ++i)
    if (!parts_.system->parts().prescribed.fixed()[i]) sum += std::abs(residual_[i]);
  unbalanced_ = parallel::global_sum(sum);
}

std::span<const double> ThermalEquations::residual() const {
  return parts_.nodal() ? newton_->residual() : std::span<const double>(residual_);
}

HeatImbalance ThermalEquations::imbalance() const {
  return {unbalanced_, moved(), tolerance()};
}

double ThermalEquations::moved() const {
  return parts_.nodal() ? newton_->sums().moved : parts_.temperature_system->moved();
}

bool ThermalEquations::converged() const {
  if (parts_.nodal()) return newton_->converged();
  return unbalanced_ <= tolerance() * moved() ||
         unbalanced_ <= parts_.temperature_system->round_off(now_.temperature);
}

linear::BlockMatrix& ThermalEquations::assemble(int iteration) {
  if (parts_.nodal()) {
    newton_->adapt_tilt(iteration, now_.temperature);
    newton_->assemble(now_.temperature);
    return parts_.system->matrix();
  }
  rhs_.resize(residual_.size());
  for (std::size_t i = 0; i < rhs_.size(); ++i)
    rhs_[i] = parts_.system->parts().prescribed.fixed()[i] ? 0.0 : -residual_[i];
  return parts_.temperature_system->exact_tangent(now_.temperature);
}

std::span<const double> ThermalEquations::right_hand_side() const {
  return parts_.nodal() ? newton_->right_hand_side() : std::span<const double>(rhs_);
}

void ThermalEquations::set_direction(std::span<double> step_t, std::span<const double> further) {
  start_ = now_;
  if (parts_.nodal()) {
    newton_->hold(step_t.first(residual().size()));
    parts_.ghosts.update(step_t, 1);
    newton_->enthalpy_step(step_t, further);
    return;
  }
  for (std::size_t i = 0; i < residual_.size(); ++i)
    if (parts_.system->parts().prescribed.fixed()[i]) step_t[i] = 0;
  parts_.ghosts.update(step_t, 1);
  step_.assign(step_t.begin(), step_t.end());
}

void ThermalEquations::move(double alpha) {
  if (parts_.nodal()) {
    newton_->move(start_.enthalpy, alpha, now_.temperature);
    parts_.ghosts.update(now_.temperature, 1);
    return;
  }
  for (std::size_t i = 0; i < step_.size(); ++i)
    now_.temperature[i] = start_.temperature[i] + alpha * step_[i];
}

}  // namespace solidus::heat
