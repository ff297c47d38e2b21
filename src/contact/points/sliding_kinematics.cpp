#include "contact/points/sliding_kinematics.hpp"

#include <algorithm>
#include <cassert>

#include "contact/points/frame_push.hpp"
#include "contact/surfaces/slave_rule.hpp"

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
    : mesh_(mesh),
      components_(static_cast<std::size_t>(displacement_components(kind))),
      slave_(slave),
      master_(std::move(master)),
      heights_(slave),
      options_(options) {
  // Points are laid on the slave's faces, and those that may concern this process are found.
  add_points(kind, options);
  find_faces_that_concern();
  const std::size_t most = static_cast<std::size_t>(k_max_face_nodes) + master_->max_nodes();
  last_.frame.nu_rate.resize(master_->max_nodes());
  last_.nodes.resize(most);
  last_.share.resize(most);
  last_.penetration_rate.resize(most);
  last_.weight_rate.resize(most);
  last_.xi_rate.resize(most);
  last_.normal_rate.resize(most);
  last_.slip_rate.resize(most);
  last_.carried_rate.resize(most);

  // At the start each point finds its partner. One that lies behind the master there would be pushed through
  // the body, and has no partner until it comes out.
  place(std::vector<double>(mesh.x.size() * components_, 0.0));
  for (std::size_t p = 0; p < points_.partner.size(); ++p) {
    points_.behind[p] = points_.partner[p].face >= 0 && master_->behind(points_.partner[p]) ? 1 : 0;
    if (points_.behind[p] != 0) points_.partner[p] = {};
  }
  double all = 0, paired = 0;
  for (std::size_t p = 0; p < points_.weight.size(); ++p) {
    all += points_.weight[p];
    if (points_.partner[p].face >= 0) paired += weight_of(p);
  }
  coverage_ = paired / all;
}

void SlidingKinematics::add_points(AnalysisKind kind, const SlidingOptions& options) {
  for (Index f = 0; f < slave_.n_faces(); ++f) {
    const Face face = slave_.reference_face(f);
    Index number = 0;
    for (const SlaveRulePoint& q : slave_rule(face, kind, options.rule, options.gauss_degree))
      add_point({.face = f, .xi = q.xi, .weight = q.weight}, number++, face);
  }
  start_points();
}

void SlidingKinematics::add_point(const SlavePlace& place, Index number, const Face& face) {
  points_.face.push_back(place.face);
  points_.number.push_back(number);
  points_.xi.push_back(place.xi);
  points_.position.push_back(face.at(place.xi));
  points_.weight.push_back(place.weight);
  mesh::basis_values(face.shape, place.xi, points_.shape.emplace_back());
  points_.hint.push_back(place.hint);
}

void SlidingKinematics::start_points() {
  points_.x = points_.position;
  points_.partner.assign(points_.weight.size(), {});
  points_.behind.assign(points_.weight.size(), 0);
  points_.concern.assign(points_.weight.size(), reached);
}

void SlidingKinematics::set_places(std::span<const SlavePlace> places) {
  for (auto* indices : {&points_.face, &points_.number, &points_.hint}) indices->clear();
  for (auto* points : {&points_.xi, &points_.position}) points->clear();
  points_.weight.clear();
  points_.shape.clear();
  Face face;
  Index number = 0;
  for (const SlavePlace& place : places) {
    if (points_.face.empty() || points_.face.back() != place.face) {
      face = slave_.reference_face(place.face);
      number = 0;
    }
    add_point(place, number++, face);
  }
  start_points();
}

bool SlidingKinematics::own_slave(std::size_t point) const {
  const auto nodes = slave_.nodes(points_.face[point]);
  return std::any_of(nodes.begin(), nodes.end(), [&](Index n) { return n < mesh_.n_owned_nodes; });
}

void SlidingKinematics::find_faces_that_concern() {
  const auto own = [&](Index node) { return node < mesh_.n_owned_nodes; };
  all_own_ = std::all_of(slave_.all_nodes().begin(), slave_.all_nodes().end(), own);
  if (all_own_) return;
  const auto n_faces = static_cast<std::size_t>(master_->n_faces());
  std::vector<char> found(n_faces, 0);
  for (Index f = 0; f < master_->n_faces(); ++f) {
    const auto nodes = master_->nodes(f);
    found[static_cast<std::size_t>(f)] = std::any_of(nodes.begin(), nodes.end(), own) ? 1 : 0;
  }
  const auto widen = [&](int rings) {
    for (int ring = 0; ring < rings; ++ring) {
      const std::vector<char> inner = found;
      for (Index f = 0; f < master_->n_faces(); ++f)
        if (inner[static_cast<std::size_t>(f)] != 0)
          for (const Index g : master_->around(f)) found[static_cast<std::size_t>(g)] = 1;
    }
  };
  face_concern_.assign(n_faces, none);
  const auto mark = [&](Concern concern) {
    for (std::size_t f = 0; f < n_faces; ++f)
      if (found[f] != 0 && face_concern_[f] == none) face_concern_[f] = concern;
  };
  widen(options_.graph_rings);
  mark(reached);
  widen(options_.graph_rings);
  mark(near);
  // A partner lies on the closest face or next to it.
  widen(1);
  master_->watch(std::move(found));
}

ContactKinematics::Particle SlidingKinematics::particle(Index point) const {
  const auto p = static_cast<std::size_t>(point);
  const auto nodes = slave_.nodes(points_.face[p]);
  return {.number = points_.face[p] * k_points_of_a_face + points_.number[p],
          .counted = nodes[0] < mesh_.n_owned_nodes,
          .position = points_.position[p],
          .area = points_.weight[p],
          .weight = weight_of(p),
          .nodes = nodes,
          .share = std::span(points_.shape[p]).first(nodes.size())};
}

Point SlidingKinematics::place_of(std::size_t point, const Face& face) const {
  Point x{};
  for (std::size_t a = 0; a < static_cast<std::size_t>(face.n_nodes); ++a)
    x = contact::add_scaled(x, points_.shape[point][a], face.x[a]);
  return x;
}

void SlidingKinematics::place(std::span<const double> displacement, Points points) {
  master_->place(displacement, time_);
  Face face;
  bool own = true;
  for (std::size_t p = 0; p < points_.face.size(); ++p) {
    if (p == 0 || points_.face[p] != points_.face[p - 1]) {
      face = slave_.current_face(points_.face[p], displacement, static_cast<int>(components_));
      own = all_own_ || own_slave(p);
    }
    points_.x[p] = place_of(p, face);
    const Point normal = face.normal(points_.xi[p]);
    points_.partner[p] = {};
    const bool asked =
        own || points == Points::all || master_->may_meet_watched(points_.x[p], normal, points_.hint[p]);
    if (asked && points_.behind[p] == 0)
      points_.partner[p] = master_->find(points_.x[p], normal, points_.hint[p]);
    const Index met = points_.partner[p].face;
    if (met >= 0) points_.hint[p] = met;
    points_.concern[p] = own                                ? reached
                         : met < 0 || face_concern_.empty() ? none
                                                            : face_concern_[static_cast<std::size_t>(met)];
  }
}

void SlidingKinematics::list_nodes(std::size_t point) const {
  const auto slave = slave_.nodes(points_.face[point]);
  last_.n_slave = slave.size();
  last_.n_nodes = last_.n_slave + last_.frame.nodes.size();
  for (std::size_t a = 0; a < last_.n_slave; ++a) {
    last_.nodes[a] = slave[a];
    last_.share[a] = points_.shape[point][a];
  }
  for (std::size_t a = 0; a < last_.frame.nodes.size(); ++a) {
    last_.nodes[last_.n_slave + a] = last_.frame.nodes[a];
    last_.share[last_.n_slave + a] =
        a < static_cast<std::size_t>(last_.frame.n_face_nodes) ? -last_.frame.share[a] : 0.0;
  }
}

PointMotion SlidingKinematics::motion(Index point, const ContactPointState& old, Asked asked) const {
  const auto p = static_cast<std::size_t>(point);
  const Partner& partner = points_.partner[p];
  PointMotion m;
  m.weight = weight_of(p);
  m.covered = partner.covered;
  if (partner.face < 0) return m;
  master_->frame(partner, asked == Asked::rates, last_.frame);
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
  const bool turns = carries && master_->reference_turns();
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
  const std::array<double, 2>& slope = points_.partner[point].covered_xi;
  if (slope[0] == 0 && slope[1] == 0) return {};
  for (std::size_t c = 0; c < last_.n_nodes; ++c) {
    last_.weight_rate[c] = {};
    for (std::size_t alpha = 0; alpha + 1 < components_; ++alpha)
      last_.weight_rate[c] = contact::add_scaled(last_.weight_rate[c], points_.weight[point] * slope[alpha],
                                                 last_.xi_rate[c][alpha]);
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
  const auto p = static_cast<std::size_t>(point);
  const Partner& partner = points_.partner[p];
  assert(k.size() == last_.n_nodes * last_.n_nodes);
  const PushRates push =
      push_rates(last_.frame, plane_normal(partner, last_.frame),
                 {plane_normal_xi(partner, last_.frame, 0), plane_normal_xi(partner, last_.frame, 1)},
                 partner.normal, traction);
  const Point force = contact::add_scaled(push.pushed, -pressure, partner.normal);
  const double w = weight_of(p);
  for (std::size_t c = 0; c < last_.n_nodes; ++c) {
    // ∂f/∂x_c
    Tensor turn{};
    contact::add_scaled(turn, -pressure, last_.normal_rate[c]);
    const bool on_face =
        c >= last_.n_slave && c < last_.n_slave + static_cast<std::size_t>(last_.frame.n_face_nodes);
    for (std::size_t alpha = 0; alpha + 1 < components_; ++alpha) {
      add_outer(turn, 1, push.by_xi[alpha], last_.xi_rate[c][alpha]);
      if (on_face) contact::add_scaled(turn, last_.frame.slope[c - last_.n_slave][alpha], push.by_tau[alpha]);
    }
    contact::add_scaled(turn, 1, times(push.by_normal, last_.normal_rate[c]));
    for (std::size_t b = 0; b < last_.n_nodes; ++b) {
      Tensor& block = k[b * last_.n_nodes + c];
      if (last_.share[b] != 0) contact::add_scaled(block, w * last_.share[b], turn);
      if (b < last_.n_slave || b - last_.n_slave >= static_cast<std::size_t>(last_.frame.n_face_nodes))
        continue;
      for (std::size_t alpha = 0; alpha + 1 < components_; ++alpha)
        add_outer(block, -w * last_.frame.slope[b - last_.n_slave][alpha], force, last_.xi_rate[c][alpha]);
    }
  }
}

SlidingKinematics::ReferenceRates SlidingKinematics::reference_rates(Index point) const {
  const Partner& met = partner(point);
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
