#include "contact/points/nodal_means.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "contact/surfaces/vector.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::contact {

namespace {

/// Sums around a node of the slave, in the end means.
struct Mean {
  GlobalIndex number = 0;
  Index face = 0, partner = 0;  ///< the first ones that are met
  double weight = 0, penetration = 0;
  FacetGap facets;
  Point normal{}, position{};
  bool linear = true;  ///< all faces around the node
  struct Share {
    Index node = 0;
    double value = 0;
  };
  std::map<GlobalIndex, Share> share[2];  ///< of the slave's and of the master's nodes, by input number
};

/// N̂ of a face's vertices from its shape functions: N̂_A = Σ_a N̂_A(x_a) N_a, half for the middles of its
/// edges.
std::array<double, k_max_face_nodes> vertex_functions(std::span<const double> shape, int n_vertices) {
  std::array<double, k_max_face_nodes> values{};
  const auto n = as_size(n_vertices);
  for (std::size_t v = 0; v < n; ++v) values[v] = shape[v];
  for (std::size_t middle = n; middle < shape.size(); ++middle)
    for (const std::size_t v : {middle - n, (middle - n + 1) % n}) values[v] += 0.5 * shape[middle];
  return values;
}

/// Adds the point that stands for the means around a node of the slave.
void add_point(const mesh::Mesh& mesh, Index node, const Mean& mean, ContactPoints& points) {
  Pairing pairing;
  pairing.slave_face = mean.face;
  pairing.master_face = mean.partner;
  pairing.n_slave = static_cast<int>(mean.share[0].size());
  pairing.n_master = static_cast<int>(mean.share[1].size());
  pairing.first_node = points.nodes.size();
  pairing.first_point = points.n_points();
  pairing.n_points = 1;
  pairing.first_shape = points.shape.size();
  pairing.counted = node < mesh.n_owned_nodes;
  // Pressures of linear faces are those of the node; it comes first, and the results show them there.
  pairing.n_shown = mean.linear ? 1 : pairing.n_slave;
  const auto add = [&](Index of, double share) {
    points.nodes.push_back(of);
    points.shape.push_back(share / mean.weight);
  };
  add(node, mean.share[0].at(mesh.input_node[as_size(node)]).value);
  for (const auto& [number, share] : mean.share[0])
    if (share.node != node) add(share.node, share.value);
  for (const auto& [number, share] : mean.share[1]) add(share.node, share.value);
  points.number.push_back(mean.number);
  points.weight.push_back(mean.weight);
  points.normal.push_back(scale(1 / norm(mean.normal), mean.normal));
  points.position.push_back(scale(1 / mean.weight, mean.position));
  points.initial_penetration.push_back(mean.penetration / mean.weight);
  points.facets.push_back({mean.facets.height / mean.weight, mean.facets.bound / mean.weight});
  points.pairings.push_back(pairing);
}

}  // namespace

ContactPoints means_around_nodes(const mesh::Mesh& mesh, const ContactSurface& slave,
                                 const ContactPoints& pieces) {
  std::map<Index, Mean> means;  // by node
  std::vector<Index> order;     // of their appearance, the same on all processes
  for (const Pairing& pairing : pieces.pairings) {
    const std::span<const Index> nodes = std::span(pieces.nodes).subspan(pairing.first_node);
    const auto n_slave = as_size(pairing.n_slave), n_nodes = as_size(pairing.n_nodes());
    const int n_vertices = mesh::vertex_count(slave.shape(pairing.slave_face));
    for (Index p = pairing.first_point; p < pairing.first_point + pairing.n_points; ++p) {
      const auto i = as_size(p);
      const std::span<const double> shape =
          std::span(pieces.shape)
              .subspan(pairing.first_shape + as_size(p - pairing.first_point) * n_nodes, n_nodes);
      const auto functions = vertex_functions(shape.first(n_slave), n_vertices);
      for (std::size_t v = 0; v < as_size(n_vertices); ++v) {
        const double w = pieces.weight[i] * functions[v];
        if (!(w > 0)) continue;
        const auto [found, fresh] = means.try_emplace(nodes[v]);
        Mean& mean = found->second;
        if (fresh) {
          // Beyond the numbers of the points of `segments`.
          mean.number =
              pairing.slave_face * k_points_of_a_face + k_points_of_a_face / 2 + static_cast<GlobalIndex>(v);
          mean.face = pairing.slave_face;
          mean.partner = pairing.master_face;
          order.push_back(nodes[v]);
        }
        mean.weight += w;
        mean.penetration += w * pieces.initial_penetration[i];
        mean.facets.height += w * pieces.facets[i].height;
        mean.facets.bound += w * pieces.facets[i].bound;
        mean.normal = add_scaled(mean.normal, w, pieces.normal[i]);
        mean.position = add_scaled(mean.position, w, pieces.position[i]);
        mean.linear = mean.linear && mesh::order(slave.shape(pairing.slave_face)) == 1;
        for (std::size_t b = 0; b < n_nodes; ++b) {
          Mean::Share& share = mean.share[b < n_slave ? 0 : 1][mesh.input_node[as_size(nodes[b])]];
          share.node = nodes[b];
          share.value += w * shape[b];
        }
      }
    }
  }

  ContactPoints points;
  points.slave_measure = pieces.slave_measure;
  points.paired_measure = pieces.paired_measure;
  for (const Index node : order) {
    const Mean& mean = means.at(node);
    const auto owned = [&](const auto& share) { return share.second.node < mesh.n_owned_nodes; };
    if (!std::ranges::any_of(mean.share[0], owned) && !std::ranges::any_of(mean.share[1], owned)) continue;
    add_point(mesh, node, mean, points);
  }
  return points;
}

}  // namespace solidus::contact
