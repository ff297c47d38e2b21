/// The shapes and normals of all points are stored when they are found, since they never change; a motion
/// is then one sum over the nodes of the point.
#include "contact/points/fixed_kinematics.hpp"

#include <algorithm>
#include <utility>

#include "numbers/index_casts.hpp"

namespace solidus::contact {

namespace {

constexpr Tensor k_identity{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
constexpr double k_whole = 1;

std::size_t most_nodes(const ContactPoints& points) {
  int most = 0;
  for (const Pairing& pairing : points.pairings) most = std::max(most, pairing.n_nodes());
  return as_size(most);
}

}  // namespace

FixedKinematics::FixedKinematics(ContactPoints points, int components)
    : points_(std::move(points)),
      components_(components),
      relative_(points_.weight.size()),
      penetration_rate_(most_nodes(points_)),
      slip_rate_(most_nodes(points_)) {
  pairing_.reserve(points_.weight.size());
  for (std::size_t k = 0; k < points_.pairings.size(); ++k)
    pairing_.insert(pairing_.end(), as_size(points_.pairings[k].n_points), as_index(k));
}

FixedKinematics::Particle FixedKinematics::particle(Index point) const {
  const auto p = as_size(point);
  // Points of one pairing lie one after the other, each with the shape functions of all its nodes.
  const Pairing& pairing = points_.pairings[as_size(pairing_[p])];
  const auto n_slave = as_size(pairing.n_slave);
  const std::size_t shape =
      pairing.first_shape + as_size(point - pairing.first_point) * as_size(pairing.n_nodes());
  // Means around nodes show their values at the node alone, with the share one; other points at
  // their face.
  const bool of_a_node = pairing.n_shown == 1;
  return {points_.number[p],
          pairing.counted,
          points_.position[p],
          points_.weight[p],
          points_.weight[p],
          std::span(points_.nodes).subspan(pairing.first_node, of_a_node ? 1 : n_slave),
          of_a_node ? std::span(&k_whole, 1) : std::span(points_.shape).subspan(shape, n_slave)};
}

void FixedKinematics::place(std::span<const double> u, Points) {
  // Shares do not change in small sliding, so that the relative displacement of each point is linear in the
  // nodal ones.
  for (const Pairing& pairing : points_.pairings) {
    const Index* nodes = points_.nodes.data() + pairing.first_node;
    const double* b = points_.shape.data() + pairing.first_shape;
    for (Index p = pairing.first_point; p < pairing.first_point + pairing.n_points; ++p) {
      Point d{};
      for (int a = 0; a < pairing.n_nodes(); ++a) {
        const double* ua = u.data() + static_cast<std::ptrdiff_t>(nodes[a]) * components_;
        for (int i = 0; i < components_; ++i) d[as_size(i)] += b[a] * ua[i];
      }
      relative_[as_size(p)] = d;
      b += pairing.n_nodes();
    }
  }
}

PointMotion FixedKinematics::motion(Index point, const ContactPointState& old, Asked asked) const {
  // In small sliding partner, weight and normal of a point are those of the undeformed bodies; only its
  // relative displacement d is new. Penetration is its normal part besides the initial one, the anchor its
  // tangential part.
  const auto p = as_size(point);
  const Pairing& pairing = points_.pairings[as_size(pairing_[p])];
  const auto n_nodes = as_size(pairing.n_nodes());
  const Point &n = points_.normal[p], &d = relative_[p];
  const double along = dot(d, n);
  PointMotion m;
  m.partnered = true;
  m.nodes = {points_.nodes.data() + pairing.first_node, n_nodes};
  m.n_slave = pairing.n_slave;
  m.share = {points_.shape.data() + pairing.first_shape + as_size(point - pairing.first_point) * n_nodes,
             n_nodes};
  m.weight = points_.weight[p];
  m.penetration = points_.initial_penetration[p] + along;
  m.normal = n;
  m.push = k_identity;
  m.anchor = add_scaled(d, -along, n);
  // Slip is counted from the place at which the point was anchored, and carries its traction along.
  if (old.anchored) {
    m.slip = subtract(m.anchor, old.anchor);
    m.carried = old.traction;
  }
  m.master_normal = n;
  if (asked == Asked::motion) return m;

  // The rates are constant: shape functions times the normal, and times the projection onto the tangent
  // plane.
  for (std::size_t a = 0; a < n_nodes; ++a) {
    penetration_rate_[a] = scale(m.share[a], n);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        slip_rate_[a][i][j] = old.anchored ? m.share[a] * (k_identity[i][j] - n[i] * n[j]) : 0.0;
  }
  m.penetration_rate = std::span(penetration_rate_).first(n_nodes);
  m.slip_rate = std::span(slip_rate_).first(n_nodes);
  return m;
}

void FixedKinematics::add_to_graph(CliqueSink& sink) {
  for (const Pairing& p : points_.pairings)
    sink.add(std::span(points_.nodes).subspan(p.first_node, as_size(p.n_nodes())));
}

}  // namespace solidus::contact
