#include "contact/points/sliding_kinematics.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "contact/points/frame_push.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::contact {

namespace {

bool in_wedge(const Partner& partner) {
  return partner.region != Partner::Region::face;
}

// In a wedge traction lives in the plane of the face.
const Point& plane_normal(const Partner& partner, const MasterFrame& frame) {
  return in_wedge(partner) ? frame.reference_face_normal : frame.reference_nu;
}
const Point& plane_normal_xi(const Partner& partner, const MasterFrame& frame, std::size_t alpha) {
  return in_wedge(partner) ? frame.reference_face_normal_xi[alpha] : frame.reference_nu_xi[alpha];
}

}  // namespace

SlidingKinematics::SlidingKinematics(const mesh::Mesh& mesh, AnalysisKind kind, const ContactSurface& slave,
                                     std::unique_ptr<Master> master, const SlidingOptions& options)
    : points_(mesh, kind, slave, std::move(master), options),
      components_(as_size(displacement_components(kind))),
      heights_(slave) {
  const auto of_master = points_.master().max_nodes();
  const std::size_t most = as_size(k_max_face_nodes) + of_master;
  last_.frame.nu_rate.resize(of_master);
  last_.nodes.resize(most);
  last_.share.resize(most);
  last_.penetration_rate.resize(most);
  last_.weight_rate.resize(most);
  last_.xi_rate.resize(most);
  last_.normal_rate.resize(most);
  last_.slip_rate.resize(most);
  last_.carried_rate.resize(most);
}

void SlidingKinematics::list_nodes(std::size_t point) const {
  const auto slave = points_.slave().nodes(points_.table().face[point]);
  last_.n_slave = slave.size();
  last_.n_nodes = last_.n_slave + last_.frame.nodes.size();
  for (std::size_t a = 0; a < last_.n_slave; ++a) {
    last_.nodes[a] = slave[a];
    last_.share[a] = points_.table().shape[point][a];
  }
  for (std::size_t a = 0; a < last_.frame.nodes.size(); ++a) {
    last_.nodes[last_.n_slave + a] = last_.frame.nodes[a];
    last_.share[last_.n_slave + a] = a < as_size(last_.frame.n_face_nodes) ? -last_.frame.share[a] : 0.0;
  }
}

PointMotion SlidingKinematics::motion(Index point, const ContactPointState& old, Asked asked) const {
  const auto p = as_size(point);
  const Partner& partner = points_.table().partner[p];
  PointMotion m;
  m.weight = points_.weight_of(p);
  m.covered = partner.covered;
  if (partner.face < 0) return m;
  points_.master().frame(partner, asked == Asked::rates, last_.frame);
  list_nodes(p);
  m.partnered = true;
  m.nodes = std::span(last_.nodes).first(last_.n_nodes);
  m.n_slave = static_cast<int>(last_.n_slave);
  m.share = std::span(last_.share).first(last_.n_nodes);
  m.penetration = partner.penetration;
  m.normal = scale(-1, partner.normal);
  m.master_normal = plane_normal(partner, last_.frame);
  // An open point keeps its own place as the master sees it: above a round corner it is ahead of the closest
  // point, and would else slip less than it moves in the step that closes it.
  const double opening = std::max(-partner.penetration, 0.0);
  m.anchor = contact::add_scaled(last_.frame.reference_y, opening, m.master_normal);
  m.push = push_forward(last_.frame, m.master_normal, partner.normal);
  if (asked == Asked::rates) {
    find_rates(partner);
    m.penetration_rate = std::span(last_.penetration_rate).first(last_.n_nodes);
    m.weight_rate = find_weight_rates(p);
    m.slip_rate = std::span(last_.slip_rate).first(last_.n_nodes);
  }
  find_slip(partner, old, asked, m);
  return m;
}

// ΔG = P (Ȳ − Ȳ_n) and T_n carried, with P and the rotation those of the plane at Ȳ. All of it changes with
// ξ̄ alone.
void SlidingKinematics::find_slip(const Partner& partner, const ContactPointState& old, Asked asked,
                                  PointMotion& m) const {
  const Point nu = m.master_normal;
  const Point way = old.anchored ? subtract(last_.frame.reference_y, old.anchor) : Point{};
  const bool carries = old.anchored && norm(old.traction) > 0;
  m.slip = contact::add_scaled(way, -dot(nu, way), nu);
  if (carries) m.carried = rotate(old.master_normal, nu, old.traction);
  if (asked == Asked::motion) return;
  const Tensor turn = carries ? rotation_rates(old.master_normal, nu, old.traction).by_to : Tensor{};
  const bool turns = carries && points_.master().reference_turns();
  std::array<Point, 2> slip_xi{}, carried_xi{};
  for (std::size_t alpha = 0; alpha + 1 < components_; ++alpha) {
    const Point& nu_xi = plane_normal_xi(partner, last_.frame, alpha);
    const Point& tau = last_.frame.reference_tau[alpha];
    if (old.anchored) {
      slip_xi[alpha] = contact::add_scaled(tau, -dot(nu, tau) - dot(nu_xi, way), nu);
      slip_xi[alpha] = contact::add_scaled(slip_xi[alpha], -dot(nu, way), nu_xi);
    }
    if (turns) carried_xi[alpha] = times(turn, nu_xi);
  }
  for (std::size_t c = 0; c < last_.n_nodes; ++c) {
    last_.slip_rate[c] = {};
    last_.carried_rate[c] = {};
    for (std::size_t alpha = 0; alpha + 1 < components_; ++alpha) {
      add_outer(last_.slip_rate[c], 1, slip_xi[alpha], last_.xi_rate[c][alpha]);
      if (turns) add_outer(last_.carried_rate[c], 1, carried_xi[alpha], last_.xi_rate[c][alpha]);
    }
  }
  if (turns) m.carried_rate = std::span(last_.carried_rate).first(last_.n_nodes);
}

std::span<const Point> SlidingKinematics::find_weight_rates(std::size_t point) const {
  const std::array<double, 2>& slope = points_.table().partner[point].covered_xi;
  if (slope[0] == 0 && slope[1] == 0) return {};
  for (std::size_t c = 0; c < last_.n_nodes; ++c) {
    last_.weight_rate[c] = {};
    for (std::size_t alpha = 0; alpha + 1 < components_; ++alpha)
      last_.weight_rate[c] = contact::add_scaled(
          last_.weight_rate[c], points_.table().weight[point] * slope[alpha], last_.xi_rate[c][alpha]);
  }
  return std::span(last_.weight_rate).first(last_.n_nodes);
}

void SlidingKinematics::find_rates(const Partner& partner) const {
  if (in_wedge(partner))
    find_wedge_rates(partner);
  else
    find_face_rates(partner);
}

// dr = 0:  (τ_α − g ν,α) dξ^α − ν dg = dx_s − dy + g dν, with dy and dν at fixed ξ on the right-hand side.
void SlidingKinematics::find_face_rates(const Partner& partner) const {
  const double g = partner.penetration;
  const Point& nu = partner.normal;
  const Point a = contact::add_scaled(last_.frame.tau[0], -g, last_.frame.nu_xi[0]);
  const Point b = contact::add_scaled(last_.frame.tau[1], -g, last_.frame.nu_xi[1]);
  const Point bc = scale(-1, cross(b, nu)), ca = scale(-1, cross(nu, a)), ab = cross(a, b);
  const double det = dot(a, bc);
  const std::array<Point, 3> row{scale(1 / det, bc), scale(1 / det, ca), scale(1 / det, ab)};
  for (std::size_t c = 0; c < last_.n_nodes; ++c) {
    Tensor right{}, total{};
    add_identity(right, last_.share[c], components_);
    if (c >= last_.n_slave) {
      total = last_.frame.nu_rate[c - last_.n_slave];
      contact::add_scaled(right, g, total);
    }
    last_.xi_rate[c] = {};
    for (std::size_t alpha = 0; alpha + 1 < components_; ++alpha) {
      last_.xi_rate[c][alpha] = transposed_times(right, row[alpha]);
      add_outer(total, 1, last_.frame.nu_xi[alpha], last_.xi_rate[c][alpha]);
    }
    last_.penetration_rate[c] = transposed_times(right, row[2]);
    last_.normal_rate[c] = total;
  }
}

// The partner moves along the edge only, or not at all; ν is the direction of the distance:
// x_s − ȳ = −g ν gives g dν = −(dx_s − dȳ) − ν dg, dg = −ν·(dx_s − dȳ), and along an edge with tangent t
// (t·t + g ν·t') ds = t·(dx_s − dy) − g ν·dt.
void SlidingKinematics::find_wedge_rates(const Partner& partner) const {
  const double g = partner.penetration;
  const Point& nu = partner.normal;
  const double e1 = partner.along[0], e2 = partner.along[1];
  const bool edge = partner.region == Partner::Region::edge;
  const Point t = contact::add_scaled(scale(e1, last_.frame.tau[0]), e2, last_.frame.tau[1]);
  Point curvature =
      contact::add_scaled(scale(e1 * e1, last_.frame.tau_xi[0]), e2 * e2, last_.frame.tau_xi[1]);
  curvature = contact::add_scaled(curvature, 2 * e1 * e2, last_.frame.tau_xi[2]);
  const double stiffness = dot(t, t) + g * dot(nu, curvature);
  for (std::size_t c = 0; c < last_.n_nodes; ++c) {
    double slope = 0;
    if (c >= last_.n_slave)
      slope = e1 * last_.frame.slope[c - last_.n_slave][0] + e2 * last_.frame.slope[c - last_.n_slave][1];
    Point along{};
    if (edge) along = scale(1 / stiffness, contact::add_scaled(scale(last_.share[c], t), -g * slope, nu));
    if (components_ == 2) along = {};
    last_.xi_rate[c] = {scale(e1, along), scale(e2, along)};
    Point dg = scale(-last_.share[c], nu);
    for (std::size_t i = components_; i < 3; ++i) dg[i] = 0;
    last_.penetration_rate[c] = dg;
    Tensor& turn = last_.normal_rate[c] = {};
    add_identity(turn, -last_.share[c] / g, components_);
    add_outer(turn, 1 / g, t, along);
    add_outer(turn, -1 / g, nu, dg);
  }
}

void SlidingKinematics::add_geometric_tangent(Index point, double pressure, const Point& traction,
                                              std::span<Tensor> k) const {
  const auto p = as_size(point);
  const Partner& partner = points_.table().partner[p];
  assert(k.size() == last_.n_nodes * last_.n_nodes);
  const PushRates push =
      push_rates(last_.frame, plane_normal(partner, last_.frame),
                 {plane_normal_xi(partner, last_.frame, 0), plane_normal_xi(partner, last_.frame, 1)},
                 partner.normal, traction);
  const Point force = contact::add_scaled(push.pushed, -pressure, partner.normal);
  const double w = points_.weight_of(p);
  for (std::size_t c = 0; c < last_.n_nodes; ++c) {
    // ∂f/∂x_c
    Tensor turn{};
    contact::add_scaled(turn, -pressure, last_.normal_rate[c]);
    const bool on_face = c >= last_.n_slave && c < last_.n_slave + as_size(last_.frame.n_face_nodes);
    for (std::size_t alpha = 0; alpha + 1 < components_; ++alpha) {
      add_outer(turn, 1, push.by_xi[alpha], last_.xi_rate[c][alpha]);
      if (on_face) contact::add_scaled(turn, last_.frame.slope[c - last_.n_slave][alpha], push.by_tau[alpha]);
    }
    contact::add_scaled(turn, 1, times(push.by_normal, last_.normal_rate[c]));
    for (std::size_t b = 0; b < last_.n_nodes; ++b) {
      Tensor& block = k[b * last_.n_nodes + c];
      if (last_.share[b] != 0) contact::add_scaled(block, w * last_.share[b], turn);
      if (b < last_.n_slave || b - last_.n_slave >= as_size(last_.frame.n_face_nodes)) continue;
      for (std::size_t alpha = 0; alpha + 1 < components_; ++alpha)
        add_outer(block, -w * last_.frame.slope[b - last_.n_slave][alpha], force, last_.xi_rate[c][alpha]);
    }
  }
}

void SlidingKinematics::add_share_rates(Index, std::span<Point> rates) const {
  assert(rates.size() == last_.n_nodes * last_.n_nodes);
  for (std::size_t a = 0; a < as_size(last_.frame.n_face_nodes); ++a)
    for (std::size_t b = 0; b < last_.n_nodes; ++b) {
      Point& rate = rates[(last_.n_slave + a) * last_.n_nodes + b];
      for (std::size_t alpha = 0; alpha + 1 < components_; ++alpha)
        rate = contact::add_scaled(rate, -last_.frame.slope[a][alpha], last_.xi_rate[b][alpha]);
    }
}

SlidingKinematics::ReferenceRates SlidingKinematics::reference_rates(Index point) const {
  const Partner& met = points_.table().partner[as_size(point)];
  last_.place_rate.assign(last_.n_nodes, Tensor{});
  last_.turn_rate.assign(last_.n_nodes, Tensor{});
  for (std::size_t c = 0; c < last_.n_nodes; ++c)
    for (std::size_t alpha = 0; alpha + 1 < components_; ++alpha) {
      add_outer(last_.place_rate[c], 1, last_.frame.reference_tau[alpha], last_.xi_rate[c][alpha]);
      add_outer(last_.turn_rate[c], 1, plane_normal_xi(met, last_.frame, alpha), last_.xi_rate[c][alpha]);
    }
  return {last_.place_rate, last_.turn_rate};
}

}  // namespace solidus::contact
