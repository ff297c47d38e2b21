#include "contact/nodal_wear.hpp"
#include "numbers/index_casts.hpp"

#include <algorithm>
#include <vector>

namespace solidus::contact {

void take_wear(const ContactView& pair, std::span<double> depth) {
  if (!pair.law.wear) return;
  const ContactKinematics& kinematics =
      pair.geometry.at(pair.end.time, pair.end.displacement, ContactKinematics::Points::own);
  const auto n = as_size(pair.geometry.mesh().n_owned_nodes);
  // A node of the slave has the mean of the points around it, by their areas and its share in them.
  std::vector<double> sum(n, 0.0), weight(n, 0.0);
  for (Index p = 0; p < kinematics.n_points(); ++p) {
    const ContactKinematics::Particle particle = kinematics.particle(p);
    for (std::size_t b = 0; b < particle.nodes.size(); ++b) {
      const auto node = as_size(particle.nodes[b]);
      if (node >= n) continue;
      const double w = particle.area * particle.share[b];
      weight[node] += w;
      sum[node] += w * pair.end.state.points[as_size(p)].wear_depth;
    }
  }
  for (std::size_t node = 0; node < n; ++node)
    if (weight[node] > 0) depth[node] = std::max(depth[node], sum[node] / weight[node]);
  // A master that wears keeps its depth at its nodes.
  for (const MasterWear::Depth& worn : pair.history.depths(pair.end.state))
    if (const auto node = as_size(worn.node); node < n) depth[node] = std::max(depth[node], worn.depth);
}

}  // namespace solidus::contact
