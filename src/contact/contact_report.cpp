/// Sums over the points of a pair at the end of a step: forces, areas and energies first, then what has
/// left its wall, which takes a search for the nearest face of the master and is therefore asked only of
/// points that seem to have left.
#include "contact/contact_report.hpp"
#include "contact/heat/heat_measures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "contact/interface/interface_thermodynamics.hpp"
#include "contact/points/wall_distance.hpp"
#include "contact/surfaces/rotation.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "system/processes.hpp"

namespace solidus::contact {

namespace {

/// Whether liquid metal seems to have left its wall at a point: a void has opened there. A wall that is soft
/// by the penalty that it was given is drawn along before that. A face with a coherent node goes with the
/// shell, and takes the points between along.
bool seems_left(const ContactView& pair, Index point) {
  const ContactPointState& state = pair.end.state.points[as_size(point)];
  return state.suction > 0 && state.status == PointStatus::open && !pair.step.liquid.empty() &&
         pair.step.liquid[as_size(point)] != 0 && -state.penetration > pair.spec.leaving_gap;
}

/// The area that has left its wall and the largest gap, where the surfaces really are: melt that has slid
/// along a wall of flat faces has not. Collective.
void measure_left(const ContactView& pair, const ContactKinematics& kinematics, ContactSums& sums) {
  // The distance to the true surface of the wall needs a search, which only a meshed master has; a
  // rigid surface is exact, so that its penetration is the distance.
  std::optional<WallDistance> wall;
  if (!pair.spec.rigid_master)
    wall.emplace(ContactSurface(pair.geometry.mesh(), pair.spec.master), pair.end.displacement,
                 pair.geometry.components());
  double points = 0, area = 0, gap = 0;
  for (Index p = 0; p < kinematics.n_points(); ++p) {
    // Cheap tests come first: most points of a casting in its mould have not left the wall at all.
    const ContactKinematics::Particle particle = kinematics.particle(p);
    if (!particle.counted || !seems_left(pair, p)) continue;
    const double along = -pair.end.state.points[as_size(p)].penetration,
                 opened =
                     wall ? std::min(wall->opened(particle, along + pair.geometry.touching()), along) : along;
    if (!(opened > pair.spec.leaving_gap)) continue;
    points += 1;
    area += particle.weight;
    gap = std::max(gap, opened);
  }
  // Sums go over processes once, after the loop; each point is counted by the process that owns its
  // slave face.
  sums.left_points = std::llround(parallel::global_sum(points));
  sums.left_area = parallel::global_sum(area);
  sums.left_gap = parallel::global_max(gap);
}

/// C_co (Θ_c − Θ_0) and what hardening stores at that temperature, over the points of this process [J].
double interface_energy_here(const ContactView& pair) {
  const ContactKinematics& kinematics =
      pair.geometry.at(pair.end.time, pair.end.displacement, ContactKinematics::Points::own);
  // Only points with a temperature of their own store heat: those whose interface has a heat
  // capacity.
  double energy = 0;
  for (Index p = 0; p < kinematics.n_points(); ++p) {
    const ContactKinematics::Particle particle = kinematics.particle(p);
    const ContactPointState& state = pair.end.state.points[as_size(p)];
    if (!particle.counted || !(state.temperature > 0)) continue;
    energy +=
        particle.weight *
        (pair.law.friction ? interface_energy(*pair.law.friction, state.temperature, state.internal_variable)
                           : interface_energy(pair.spec.interface_heat_capacity, state.temperature));
  }
  return energy;
}

}  // namespace

double stored_energy(const ContactView& pair) {
  const ContactSums s = sums(pair, {});
  if (!pair.has_temperature()) return s.energy + s.work - s.dissipation;
  return s.energy + parallel::global_sum(interface_energy_here(pair));
}

namespace {

/// Gives the sums their names, in the order in which sums() has added them.
ContactSums named(const std::array<double, 20>& s) {
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
  return sums;
}

}  // namespace

ContactSums sums(const ContactView& pair, std::span<const double> temperature) {
  // Sums over all counted points of the pair: numbers of points by status, area, forces and moments on the
  // master, work and dissipation, and heat. All of them go through one array, so that one message adds them
  // up over the processes.
  const ContactKinematics& kinematics =
      pair.geometry.at(pair.end.time, pair.end.displacement, ContactKinematics::Points::own);
  std::array<double, 20> s{};
  const auto n = as_size(pair.geometry.components());
  for (Index p = 0; p < kinematics.n_points(); ++p) {
    const ContactKinematics::Particle particle = kinematics.particle(p);
    if (!particle.counted || !kinematics.there(p)) continue;
    const ContactPointState& state = pair.end.state.points[as_size(p)];
    const PointMotion motion = kinematics.motion(p, state, ContactKinematics::Asked::motion);
    const double w = particle.weight;
    // What every point has counts first: energy of its springs, work and dissipation of its particle.
    s[0] += 1;
    s[1] += w * (pair.active ? pair.law.stored(state) : 0.0);
    s[2] += particle.area * state.work;
    s[3] += particle.area * state.dissipation;
    // Wet points, which carry suction, are counted apart, with those that seem to have left their wall.
    if (state.suction > 0) {
      s[18] += w;
      s[19] += seems_left(pair, p) ? 1 : 0;
    }
    // Open points without a pressure exert no force, and end here.
    const bool open = state.status == PointStatus::open;
    if (open && state.pressure == 0) continue;
    s[4] += open ? 0 : 1;
    s[5] += state.status == PointStatus::sticks ? 1 : 0;
    s[6] += open ? 0.0 : w;
    s[7] += w * state.pressure;
    s[8] += w * norm(state.traction);
    // The moment needs the place of the point in the deformed configuration.
    Point x = particle.position;
    for (std::size_t b = 0; b < particle.nodes.size(); ++b)
      for (std::size_t i = 0; i < n; ++i)
        x[i] += particle.share[b] * pair.end.displacement[as_size(particle.nodes[b]) * n + i];
    const Point force = scale(w, force_on_master(motion, state, state.pressure));
    const Point moment = cross(x, force);
    for (std::size_t i = 0; i < 3; ++i) {
      s[9 + i] += force[i];
      s[12 + i] += moment[i];
    }
  }
  // Heat is that of both sides; heat made by friction is taken out of what passes.
  if (pair.heat != nullptr && !temperature.empty()) {
    const InterfaceHeatFlux heat = counted_heat(pair.heat->points(), temperature);
    s[15] = heat.total[1] - heat.by_friction[1];
    s[16] = heat.total[0];
    s[17] = heat.total[1];
  }
  processes::sum(s);
  ContactSums sums = named(s);
  if (s[19] > 0) measure_left(pair, kinematics, sums);
  return sums;
}

}  // namespace solidus::contact
