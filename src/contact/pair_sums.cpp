/// Sums of a contact pair over a step: work, forces, energies.
#include <petscsys.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "contact/heat_term.hpp"
#include "contact/pair.hpp"
#include "contact/rotation.hpp"
#include "parallel/parallel.hpp"

namespace solidus::contact {

namespace {

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

/// Forces of a state on the master, in the current configuration.
Point force_on_master(const PointMotion& motion, const PointState& state, double pressure) {
  return add_scaled(times(motion.push, state.traction), pressure, motion.normal);
}

}  // namespace

PointState ContactPair::at_start(std::size_t point) const {
  PointState start = step_.from[point];
  if (!start_traction_.empty()) start.traction = start_traction_[point];
  return start;
}

std::vector<double> ContactPair::increment() const {
  std::vector<double> increment = displacement_;
  for (std::size_t i = 0; i < increment.size(); ++i) increment[i] -= step_.displacement[i];
  return increment;
}

double ContactPair::force_times_increment(End end, std::span<const double> increment) {
  const bool start = end == End::start;
  configuration_->place(start ? step_.begun : time_, start ? step_.displacement : displacement_,
                        ContactKinematics::Points::own);
  const auto n = static_cast<std::size_t>(components_);
  double work = 0;
  for (Index p = 0; p < kinematics_->n_points(); ++p) {
    if (!kinematics_->particle(p).counted) continue;
    const PointState state = start ? at_start(at(p)) : now_.points[at(p)];
    if (state.balance_pressure == 0 && state.status == PointStatus::open) continue;
    const PointMotion motion = kinematics_->motion(p, state, ContactKinematics::Asked::motion);
    const Point force = force_on_master(motion, state, state.balance_pressure);
    for (std::size_t b = 0; b < motion.nodes.size(); ++b)
      for (std::size_t i = 0; i < n; ++i)
        work += motion.weight * motion.share[b] * force[i] * increment[at(motion.nodes[b]) * n + i];
  }
  return work;
}

double ContactPair::force_times_relative_way(End end, std::span<const double> increment) {
  const bool start = end == End::start;
  configuration_->place(start ? step_.begun : time_, start ? step_.displacement : displacement_,
                        ContactKinematics::Points::own);
  const auto n = static_cast<std::size_t>(components_);
  double work = 0;
  for (Index p = 0; p < kinematics_->n_points(); ++p) {
    const ContactKinematics::Particle particle = kinematics_->particle(p);
    const PointState from = at_start(at(p)), &to = now_.points[at(p)];
    if (!particle.counted || from.anchored == to.anchored) continue;
    const PointState& state = start ? from : to;
    if (!state.anchored || (state.balance_pressure == 0 && state.status == PointStatus::open)) continue;
    const PointMotion motion = kinematics_->motion(p, state, ContactKinematics::Asked::motion);
    const Point force = force_on_master(motion, state, state.balance_pressure);
    Point way = scale(-1, kinematics_->master_way(p, step_.begun, time_));
    for (std::size_t b = 0; b < particle.nodes.size(); ++b)
      for (std::size_t i = 0; i < n; ++i)
        way[i] += particle.share[b] * increment[at(particle.nodes[b]) * n + i];
    work += motion.weight * dot(force, way);
  }
  return work;
}

double ContactPair::work(double share) {
  const std::vector<double> increment = this->increment();
  double work = 0;
  if (share != 1) work += (1 - share) * force_times_increment(End::start, increment);
  if (share != 0) work += share * force_times_increment(End::finish, increment);
  configuration_->place(time_, displacement_, ContactKinematics::Points::own);
  return parallel::global_sum(work);
}

double ContactPair::rigid_work(double share) {
  if (!spec_.rigid_master) return 0;
  const std::vector<double> increment = this->increment();
  double work_and_rigid_work = 0;
  if (share != 1) work_and_rigid_work += (1 - share) * force_times_relative_way(End::start, increment);
  if (share != 0) work_and_rigid_work += share * force_times_relative_way(End::finish, increment);
  configuration_->place(time_, displacement_, ContactKinematics::Points::own);
  for (Index p = 0; p < kinematics_->n_points(); ++p) {
    const PointState from = at_start(at(p)), &to = now_.points[at(p)];
    if (!to.counted || !from.anchored || !to.anchored) continue;
    const PointMotion motion = kinematics_->motion(p, from, ContactKinematics::Asked::motion);
    const double pressure = share * to.balance_pressure + (1 - share) * from.balance_pressure;
    const Point traction = add_scaled(scale(share, to.traction), 1 - share, motion.carried);
    work_and_rigid_work +=
        motion.weight * (pressure * (to.penetration - from.penetration) + dot(traction, motion.slip));
  }
  return parallel::global_sum(work_and_rigid_work) - work(share);
}

ContactSums ContactPair::sums(std::span<const double> temperature) const {
  configuration_->place(time_, displacement_, ContactKinematics::Points::own);
  std::array<double, 21> s{};
  double left_gap = 0;
  const auto n = static_cast<std::size_t>(components_);
  for (Index p = 0; p < kinematics_->n_points(); ++p) {
    const ContactKinematics::Particle particle = kinematics_->particle(p);
    if (!particle.counted) continue;
    const PointState& state = now_.points[at(p)];
    const PointMotion motion = kinematics_->motion(p, state, ContactKinematics::Asked::motion);
    const double w = particle.weight;
    s[0] += 1;
    s[1] += w * (active_ ? law_.stored(state) : 0.0);
    s[2] += w * state.work;
    s[3] += w * state.dissipation;
    if (state.suction > 0) {
      s[18] += w;
      // A face with a coherent node goes with the shell, and takes the points between along.
      if (!step_.liquid.empty() && step_.liquid[at(p)] != 0 && -state.penetration > spec_.leaving_gap) {
        s[19] += 1;
        s[20] += w;
        left_gap = std::max(left_gap, -state.penetration);
      }
    }
    const bool open = state.status == PointStatus::open;
    if (open && state.pressure == 0) continue;
    s[4] += open ? 0 : 1;
    s[5] += state.status == PointStatus::sticks ? 1 : 0;
    s[6] += open ? 0.0 : w;
    s[7] += w * state.pressure;
    s[8] += w * norm(state.traction);
    Point x = particle.position;
    for (std::size_t b = 0; b < particle.nodes.size(); ++b)
      for (std::size_t i = 0; i < n; ++i)
        x[i] += particle.share[b] * displacement_[at(particle.nodes[b]) * n + i];
    const Point force = scale(w, force_on_master(motion, state, state.pressure));
    const Point moment = cross(x, force);
    for (std::size_t i = 0; i < 3; ++i) {
      s[9 + i] += force[i];
      s[12 + i] += moment[i];
    }
  }
  if (heat_ && !temperature.empty()) {
    const SurfaceHeat heat = heat_->counted_heat(temperature);
    s[15] = heat.total[1] - heat.by_friction[1];
    s[16] = heat.total[0];
    s[17] = heat.total[1];
  }
  MPI_Allreduce(MPI_IN_PLACE, s.data(), static_cast<int>(s.size()), MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
  ContactSums sums;
  sums.points = std::llround(s[0]);
  sums.energy = s[1];
  sums.work = s[2];
  sums.dissipation = s[3];
  sums.closed_points = std::llround(s[4]);
  sums.sticking_points = std::llround(s[5]);
  sums.closed_area = s[6];
  sums.force = s[7];
  sums.friction = s[8];
  sums.resultant = {s[9], s[10], s[11]};
  sums.moment = {s[12], s[13], s[14]};
  sums.heat = s[15];
  sums.heat_to_slave = s[16];
  sums.heat_to_master = s[17];
  sums.wet_area = s[18];
  sums.left_points = std::llround(s[19]);
  sums.left_area = s[20];
  if (sums.left_points > 0) sums.left_gap = parallel::global_max(left_gap);
  return sums;
}

}  // namespace solidus::contact
