#include "contact/forces/penetration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "system/processes.hpp"

namespace solidus::contact {

namespace {}  // namespace

std::vector<double> nodal_penetration(const ContactGeometry& geometry, const ContactState& now) {
  const mesh::Mesh& mesh = geometry.mesh();
  const ContactKinematics& kinematics = geometry.kinematics();
  // The mean over the closed points around each node, weighted as they would enter the least squares of a
  // nodal field that is lumped to its diagonal.
  std::vector<double> weight(mesh.x.size(), 0.0), mean(mesh.x.size(), 0.0);
  for (Index p = 0; p < kinematics.n_points(); ++p) {
    const ContactPointState& point = now.points[as_size(p)];
    if (point.status == PointStatus::open) continue;
    const ContactKinematics::Particle particle = kinematics.particle(p);
    for (std::size_t b = 0; b < particle.nodes.size(); ++b) {
      const double w = particle.weight * particle.share[b] * particle.share[b];
      weight[as_size(particle.nodes[b])] += w;
      mean[as_size(particle.nodes[b])] += w * point.penetration;
    }
  }
  for (std::size_t i = 0; i < mean.size(); ++i) mean[i] = weight[i] > 0 ? mean[i] / weight[i] : 0.0;
  parallel::GhostExchange(mesh).update(mean, 1);
  return mean;
}

Penetration largest_penetration(const ContactGeometry& geometry, const ContactState& now) {
  Penetration found;
  for (const double g : nodal_penetration(geometry, now))
    found.penetration = std::max(found.penetration, std::abs(g));
  for (const ContactPointState& point : now.points) found.pressure = std::max(found.pressure, point.pressure);
  found.penetration = parallel::global_max(found.penetration);
  found.pressure = parallel::global_max(found.pressure);
  return found;
}

std::string worst_penetration(const ContactGeometry& geometry, const ContactState& now) {
  const mesh::Mesh& mesh = geometry.mesh();
  const std::vector<double> penetration = nodal_penetration(geometry, now);
  double worst = -1;
  std::size_t node = 0;
  // The largest of the own nodes first; the process that has the largest of all writes the text, which the
  // others receive.
  for (std::size_t i = 0; i < penetration.size(); ++i) {
    if (std::abs(penetration[i]) <= worst) continue;
    worst = std::abs(penetration[i]);
    node = i;
  }
  const int owner = processes::find_largest(worst).rank;
  std::string text;
  if (owner == processes::rank() && !penetration.empty()) {
    const mesh::Point& x = mesh.x[node];
    text = fmt::format("node {} at ({:.6g}, {:.6g}, {:.6g}) m: penetration {:.3g} m", mesh.input_node[node],
                       x[0], x[1], x[2], penetration[node]);
  }
  processes::broadcast(text, owner);
  return text;
}

}  // namespace solidus::contact
