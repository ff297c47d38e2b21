/// Work of a contact pair in a step.
#include <cmath>

#include "contact/contact_report.hpp"
#include "contact/surfaces/rotation.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"

namespace solidus::contact {

namespace {

enum class End { start, finish };

/// The kinematics of the points that concern this process, at one end of the step.
const ContactKinematics& placed(const ContactView& pair, End end) {
  const auto own = ContactKinematics::Points::own;
  return end == End::start ? pair.geometry.at(pair.step.begun, pair.step.displacement, own)
                           : pair.geometry.at(pair.end.time, pair.end.displacement, own);
}

/// u_{n+1} − u_n, [local node][component] [m].
std::vector<double> increment_of(const ContactView& pair) {
  std::vector<double> increment = pair.end.displacement;
  for (std::size_t i = 0; i < increment.size(); ++i) increment[i] -= pair.step.displacement[i];
  return increment;
}

/// ∫ f · ΔΣ B_b u_b of the points' forces at the start or at the end of the step, this process's part [J].
double force_times_increment(const ContactView& pair, End end, std::span<const double> increment) {
  const bool start = end == End::start;
  const ContactKinematics& kinematics = placed(pair, end);
  const auto n = as_size(pair.geometry.components());
  double work = 0;
  for (Index p = 0; p < kinematics.n_points(); ++p) {
    // Each point once, by the process that owns its slave face; open ones without pressure do no
    // work.
    if (!kinematics.particle(p).counted) continue;
    const ContactPointState state =
        start ? pair.step.at_start(as_size(p)) : pair.end.state.points[as_size(p)];
    if (state.balance_pressure == 0 && state.status == PointStatus::open) continue;
    const PointMotion motion = kinematics.motion(p, state, ContactKinematics::Asked::motion);
    for (std::size_t b = 0; b < motion.nodes.size(); ++b) {
      const Point force = motion.force_at(b, state.balance_pressure, state.traction);
      for (std::size_t i = 0; i < n; ++i)
        work += motion.weight * force[i] * increment[as_size(motion.nodes[b]) * n + i];
    }
  }
  return work;
}

/// The work of points with a partner at one end of the step alone: ∫ f · (Δu_s − Δy) dA with the way Δy of
/// the rigid master's particle there, this process's part [J].
double force_times_relative_way(const ContactView& pair, End end, std::span<const double> increment) {
  const bool start = end == End::start;
  const ContactKinematics& kinematics = placed(pair, end);
  const auto n = as_size(pair.geometry.components());
  double work = 0;
  for (Index p = 0; p < kinematics.n_points(); ++p) {
    const ContactKinematics::Particle particle = kinematics.particle(p);
    const ContactPointState from = pair.step.at_start(as_size(p)), &to = pair.end.state.points[as_size(p)];
    // Points that keep their partner are summed by force_times_increment; only those that met or
    // left it within the step are left here.
    if (!particle.counted || from.anchored == to.anchored) continue;
    const ContactPointState& state = start ? from : to;
    if (!state.anchored || (state.balance_pressure == 0 && state.status == PointStatus::open)) continue;
    const PointMotion motion = kinematics.motion(p, state, ContactKinematics::Asked::motion);
    const Point force = force_on_master(motion, state, state.balance_pressure);
    // The way of the slave's particle relative to the rigid master's.
    Point way = scale(-1, kinematics.master_way(p, pair.step.begun, pair.end.time));
    for (std::size_t b = 0; b < particle.nodes.size(); ++b)
      for (std::size_t i = 0; i < n; ++i)
        way[i] += particle.share[b] * increment[as_size(particle.nodes[b]) * n + i];
    work += motion.weight * dot(force, way);
  }
  return work;
}

}  // namespace

double work(const ContactView& pair, double share) {
  const std::vector<double> increment = increment_of(pair);
  double work = 0;
  if (share != 1) work += (1 - share) * force_times_increment(pair, End::start, increment);
  if (share != 0) work += share * force_times_increment(pair, End::finish, increment);
  placed(pair, End::finish);  // whose graph the thermal phase looks at
  return parallel::global_sum(work);
}

double rigid_work(const ContactView& pair, double share) {
  if (!pair.spec.rigid_master) return 0;
  const std::vector<double> increment = increment_of(pair);
  // Forces times ways relative to the rigid surface are its work and that of the pair together; less the work
  // of the pair that of the surface is left.
  double work_and_rigid_work = 0;
  if (share != 1) work_and_rigid_work += (1 - share) * force_times_relative_way(pair, End::start, increment);
  if (share != 0) work_and_rigid_work += share * force_times_relative_way(pair, End::finish, increment);
  const ContactKinematics& kinematics = placed(pair, End::finish);
  for (Index p = 0; p < kinematics.n_points(); ++p) {
    const ContactPointState from = pair.step.at_start(as_size(p)), &to = pair.end.state.points[as_size(p)];
    if (!to.counted || !from.anchored || !to.anchored) continue;
    const PointMotion motion = kinematics.motion(p, from, ContactKinematics::Asked::motion);
    const double pressure = share * to.balance_pressure + (1 - share) * from.balance_pressure;
    const Point traction = add_scaled(scale(share, to.traction), 1 - share, motion.carried);
    work_and_rigid_work +=
        motion.weight * (pressure * (to.penetration - from.penetration) + dot(traction, motion.slip));
  }
  return parallel::global_sum(work_and_rigid_work) - work(pair, share);
}

}  // namespace solidus::contact
