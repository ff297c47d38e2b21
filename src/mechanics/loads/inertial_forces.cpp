/// begin() prepares the constant part of the force from the state at t_n, force() adds what depends on the
/// displacement, conclude() makes the motion of t_{n+1} and the work of the step.
#include "mechanics/loads/inertial_forces.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"

namespace solidus::mechanics {

InertialForces::InertialForces(const mesh::Mesh& mesh, AnalysisKind kind, int components,
                               std::span<const double> density, DynamicsOptions options)
    : components_(components),
      n_owned_(as_size(mesh.n_owned_nodes * components)),
      options_(std::move(options)),
      mass_(mesh, kind, density, options_.mass),
      constant_(n_owned_),
      increment_(mesh.x.size() * as_size(components)) {
  initial_velocity_.assign(increment_.size(), 0.0);
  if (options_.initial_velocity.empty()) return;
  assert(options_.initial_velocity.size() == mesh.bodies.size());
  set_initial_velocity(mesh, kind, density);
}

void InertialForces::set_initial_velocity(const mesh::Mesh& mesh, AnalysisKind kind,
                                          std::span<const double> density) {
  // A node of several bodies gets the mean of their velocities, weighted by their lumped masses, so that the
  // momentum is that of the bodies.
  const auto n = as_size(components_);
  std::vector<double> mass(n_owned_ / n, 0.0), of_body(mass.size());
  const std::vector<double> ones(mesh.x.size(), 1.0);
  for (std::size_t b = 0; b < density.size(); ++b) {
    std::vector<double> alone(density.size(), 0.0);
    alone[b] = density[b];
    MassMatrix(mesh, kind, alone, MassKind::lumped).multiply(ones, 1, of_body);
    for (std::size_t node = 0; node < mass.size(); ++node) {
      mass[node] += of_body[node];
      for (std::size_t i = 0; i < n; ++i)
        initial_velocity_[node * n + i] += of_body[node] * options_.initial_velocity[b][i];
    }
  }
  for (std::size_t node = 0; node < mass.size(); ++node)
    for (std::size_t i = 0; i < n && mass[node] > 0; ++i) initial_velocity_[node * n + i] /= mass[node];
}

void InertialForces::begin(const MechanicalState& old, double dt) {
  assert(old.velocity.size() == increment_.size() && old.acceleration.size() == increment_.size());
  // The part of the inertial force that does not depend on the displacement of the step is computed once.
  const Motion& m = options_.motion;
  old_ = &old;
  dt_ = dt;
  for (std::size_t i = 0; i < increment_.size(); ++i)
    increment_[i] = (1 - m.alpha_m) * m.acceleration(0.0, old.velocity[i], old.acceleration[i], dt) +
                    m.alpha_m * old.acceleration[i];
  mass_.multiply(increment_, components_, constant_);
  // Integrators that evaluate forces within the step take the forces of the start into it.
  if (m.alpha_f > 0)
    for (std::size_t i = 0; i < n_owned_; ++i)
      constant_[i] = (constant_[i] + m.alpha_f * old.net_force[i]) / (1 - m.alpha_f);

  // What rounding of the displacements makes of inertia is the scale below which a residual says nothing.
  for (std::size_t i = 0; i < increment_.size(); ++i) increment_[i] = std::abs(old.displacement[i]);
  std::vector<double> scale(n_owned_);
  mass_.multiply(increment_, components_, scale);
  double squares = 0;
  for (const double s : scale) squares += s * s;
  round_off_ = std::numeric_limits<double>::epsilon() * slope() * std::sqrt(parallel::global_sum(squares));
}

void InertialForces::force(std::span<const double> x, std::span<double> j) const {
  for (std::size_t i = 0; i < increment_.size(); ++i) increment_[i] = x[i] - old_->displacement[i];
  mass_.multiply(increment_, components_, j);
  const double factor = slope();
  for (std::size_t i = 0; i < n_owned_; ++i) j[i] = factor * j[i] + constant_[i];
}

void InertialForces::add_tangent(linear::BlockMatrix& matrix) const {
  mass_.add_to(matrix, slope());
}

MotionWork InertialForces::conclude(std::span<const double> x, std::span<const double> net,
                                    std::span<const double> load, std::span<const char> fixed,
                                    MechanicalState& next) const {
  const Motion& m = options_.motion;
  const MechanicalState& old = *old_;
  // First acceleration and velocity at the end of the step follow from the displacement by the integrator.
  next.velocity.resize(increment_.size());
  next.acceleration.resize(increment_.size());
  for (std::size_t i = 0; i < increment_.size(); ++i) {
    const double v = old.velocity[i], a = old.acceleration[i];
    next.acceleration[i] = m.acceleration(x[i] - old.displacement[i], v, a, dt_);
    next.velocity[i] = m.velocity(v, a, next.acceleration[i], dt_);
    increment_[i] = next.velocity[i] - v;
  }
  // Then the work of the step is divided: what loads have done, what became kinetic energy, what supports
  // have done at prescribed displacements, and what the integrator takes out of the motion.
  std::vector<double> impulse(n_owned_), j(n_owned_);
  mass_.multiply(increment_, components_, impulse);
  // The work share w weighs the forces of the end against those of the start (one for backward Euler, a half
  // for all others).
  const double w = m.work_share;
  const bool remembers = m.remembers();
  // Integrators that evaluate forces within the step need the forces of the start too, and keep those of the
  // end for the next step.
  if (remembers) force(x, j);
  MotionWork work;
  for (std::size_t i = 0; i < n_owned_; ++i) {
    const double increment = x[i] - old.displacement[i];
    const double mean_velocity = 0.5 * (old.velocity[i] + next.velocity[i]), rate = impulse[i] / dt_;
    const double old_net = remembers ? old.net_force[i] : 0.0, old_load = remembers ? old.load[i] : 0.0;
    work.external += (w * load[i] + (1 - w) * old_load) * increment;
    work.kinetic += mean_velocity * impulse[i];
    work.numerical += (increment / dt_ - mean_velocity) * impulse[i];
    if (fixed[i] != 0)
      work.support += (w * net[i] + (1 - w) * old_net + rate) * increment;
    else if (remembers)
      work.numerical +=
          ((1 - m.alpha_f) * j[i] - m.alpha_f * old_net - rate - (w - 1 + m.alpha_f) * (net[i] - old_net)) *
          increment;
  }
  if (remembers) {
    next.net_force.assign(increment_.size(), 0.0);
    next.load.assign(increment_.size(), 0.0);
    std::copy(net.begin(), net.end(), next.net_force.begin());
    std::copy(load.begin(), load.end(), next.load.begin());
  }
  return work;
}

std::size_t InertialForces::bytes() const {
  return mass_.bytes() + (constant_.capacity() + increment_.capacity()) * sizeof(double);
}

}  // namespace solidus::mechanics
