/// Volumes are added at the nodes with shares that are nowhere negative; the depth of a node is its volume
/// over the area that belongs to it.
#include "contact/points/master_wear.hpp"

#include <algorithm>
#include <array>

#include "contact/surfaces/face.hpp"
#include "contact/surfaces/slave_rule.hpp"
#include "mesh/quadrature.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::contact {

namespace {

constexpr int k_degree = 8;  // of the areas: the shares of quadratic faces have bends

std::size_t place_of(const std::vector<Index>& nodes, Index node) {
  return as_size(std::lower_bound(nodes.begin(), nodes.end(), node) - nodes.begin());
}

/// s_a from N_a.
void make_shares(std::span<double> n) {
  double sum = 0;
  for (double& value : n) sum += value = std::max(value, 0.0);
  for (double& value : n) value /= sum;
}

}  // namespace

MasterWear::MasterWear(const mesh::Mesh& mesh, AnalysisKind kind, const ContactSurface& master)
    : mesh_(mesh), nodes_(master.all_nodes()), area_(nodes_.size(), 0.0) {
  std::array<double, k_max_face_nodes> shares;
  for (Index f = 0; f < master.n_faces(); ++f) {
    // Wear of the master is kept at its nodes, as a volume: a slave point moves on, the groove does
    // not.
    const Face face = master.reference_face(f);
    const auto nodes = master.nodes(f);
    // The area that belongs to each node, with positive shares.
    for (const auto& q : mesh::gauss_rule(face.shape, k_degree)) {
      const std::span<double> s = std::span(shares).first(nodes.size());
      mesh::basis_values(face.shape, q.xi, s);
      make_shares(s);
      const double w = q.weight * face.jacobian(q.xi) * circumference(kind, face.at(q.xi));
      for (std::size_t a = 0; a < s.size(); ++a) area_[place_of(nodes_, nodes[a])] += w * s[a];
    }
  }
}

std::vector<WornNode> MasterWear::initial_state() const {
  std::vector<WornNode> state;
  for (const Index node : nodes_)
    state.push_back({.number = mesh_.input_node[as_size(node)], .counted = node < mesh_.n_owned_nodes});
  return state;
}

void MasterWear::add(const PointMotion& motion, double depth, double dissipation,
                     std::vector<WornNode>& nodes) const {
  const auto first = as_size(motion.n_slave);
  // Nodes take part with positive shares, which are made to sum to one.
  const auto share = [&](std::size_t b) { return std::max(-motion.share[b], 0.0); };
  // The sum is that of the positive parts; it is never zero, since shape functions sum to one.
  double sum = 0;
  for (std::size_t b = first; b < motion.nodes.size(); ++b) sum += share(b);
  for (std::size_t b = first; b < motion.nodes.size(); ++b) {
    const double part = motion.weight * (share(b) / sum);
    if (part == 0) continue;
    WornNode& node = nodes[place_of(nodes_, motion.nodes[b])];
    node.volume += part * depth;
    node.dissipation += part * dissipation;
  }
}

std::vector<MasterWear::Depth> MasterWear::depths(const std::vector<WornNode>& nodes) const {
  std::vector<Depth> depths;
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    depths.push_back({nodes_[i], nodes[i].volume / area_[i], nodes[i].dissipation / area_[i]});
  return depths;
}

}  // namespace solidus::contact
