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
  frame_.nu_rate.resize(master_->max_nodes());
  nodes_.resize(most);
  share_.resize(most);
  penetration_rate_.resize(most);
  weight_rate_.resize(most);
  xi_rate_.resize(most);
  normal_rate_.resize(most);
  slip_rate_.resize(most);
  carried_rate_.resize(most);

  // At the start each point finds its partner. One that lies behind the master there would be pushed through
  // the body, and has no partner until it comes out.
  place(std::vector<double>(mesh.x.size() * components_, 0.0));
  for (std::size_t p = 0; p < partner_.size(); ++p) {
    behind_[p] = partner_[p].face >= 0 && master_->behind(partner_[p]) ? 1 : 0;
    if (behind_[p] != 0) partner_[p] = {};
  }
  double all = 0, paired = 0;
  for (std::size_t p = 0; p < weight_.size(); ++p) {
    all += weight_[p];
    if (partner_[p].face >= 0) paired += weight_of(p);
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
  face_.push_back(place.face);
  number_.push_back(number);
  xi_.push_back(place.xi);
  position_.push_back(face.at(place.xi));
  weight_.push_back(place.weight);
  mesh::basis_values(face.shape, place.xi, shape_.emplace_back());
  hint_.push_back(place.hint);
}

void SlidingKinematics::start_points() {
  x_ = position_;
  partner_.assign(weight_.size(), {});
  behind_.assign(weight_.size(), 0);
  concern_.assign(weight_.size(), reached);
}

void SlidingKinematics::set_places(std::span<const SlavePlace> places) {
  for (auto* indices : {&face_, &number_, &hint_}) indices->clear();
  for (auto* points : {&xi_, &position_}) points->clear();
  weight_.clear();
  shape_.clear();
  Face face;
  Index number = 0;
  for (const SlavePlace& place : places) {
    if (face_.empty() || face_.back() != place.face) {
      face = slave_.reference_face(place.face);
      number = 0;
    }
    add_point(place, number++, face);
  }
  start_points();
}

bool SlidingKinematics::own_slave(std::size_t point) const {
  const auto nodes = slave_.nodes(face_[point]);
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
  const auto nodes = slave_.nodes(face_[p]);
  return {.number = face_[p] * k_points_of_a_face + number_[p],
          .counted = nodes[0] < mesh_.n_owned_nodes,
          .position = position_[p],
          .area = weight_[p],
          .weight = weight_of(p),
          .nodes = nodes,
          .share = std::span(shape_[p]).first(nodes.size())};
}

Point SlidingKinematics::place_of(std::size_t point, const Face& face) const {
  Point x{};
  for (std::size_t a = 0; a < static_cast<std::size_t>(face.n_nodes); ++a)
    x = contact::add_scaled(x, shape_[point][a], face.x[a]);
  return x;
}

void SlidingKinematics::place(std::span<const double> displacement, Points points) {
  master_->place(displacement, time_);
  Face face;
  bool own = true;
  for (std::size_t p = 0; p < face_.size(); ++p) {
    if (p == 0 || face_[p] != face_[p - 1]) {
      face = slave_.current_face(face_[p], displacement, static_cast<int>(components_));
      own = all_own_ || own_slave(p);
    }
    x_[p] = place_of(p, face);
    const Point normal = face.normal(xi_[p]);
    partner_[p] = {};
    const bool asked = own || points == Points::all || master_->may_meet_watched(x_[p], normal, hint_[p]);
    if (asked && behind_[p] == 0) partner_[p] = master_->find(x_[p], normal, hint_[p]);
    const Index met = partner_[p].face;
    if (met >= 0) hint_[p] = met;
    concern_[p] = own                                ? reached
                  : met < 0 || face_concern_.empty() ? none
                                                     : face_concern_[static_cast<std::size_t>(met)];
  }
}

void SlidingKinematics::list_nodes(std::size_t point) const {
  const auto slave = slave_.nodes(face_[point]);
  n_slave_ = slave.size();
  n_nodes_ = n_slave_ + frame_.nodes.size();
  for (std::size_t a = 0; a < n_slave_; ++a) {
    nodes_[a] = slave[a];
    share_[a] = shape_[point][a];
  }
  for (std::size_t a = 0; a < frame_.nodes.size(); ++a) {
    nodes_[n_slave_ + a] = frame_.nodes[a];
    share_[n_slave_ + a] = a < static_cast<std::size_t>(frame_.n_face_nodes) ? -frame_.share[a] : 0.0;
  }
}

PointMotion SlidingKinematics::motion(Index point, const ContactPointState& old, Asked asked) const {
  const auto p = static_cast<std::size_t>(point);
  const Partner& partner = partner_[p];
  PointMotion m;
  m.weight = weight_of(p);
  m.covered = partner.covered;
  if (partner.face < 0) return m;
  master_->frame(partner, asked == Asked::rates, frame_);
  list_nodes(p);
  m.partnered = true;
  m.nodes = std::span(nodes_).first(n_nodes_);
  m.n_slave = static_cast<int>(n_slave_);
  m.share = std::span(share_).first(n_nodes_);
  m.penetration = partner.penetration;
  m.normal = scale(-1, partner.normal);
  m.master_normal = plane_normal(partner, frame_);
  // An open point keeps its own place as the master sees it: above a round corner it is ahead of the closest
  // point, and would else slip less than it moves in the step that closes it.
  const double opening = std::max(-partner.penetration, 0.0);
  m.anchor = contact::add_scaled(frame_.reference_y, opening, m.master_normal);
  m.push = push_forward(frame_, m.master_normal, partner.normal);
  if (asked == Asked::rates) {
    find_rates(partner);
    m.penetration_rate = std::span(penetration_rate_).first(n_nodes_);
    m.weight_rate = find_weight_rates(p);
    m.slip_rate = std::span(slip_rate_).first(n_nodes_);
  }
  find_slip(partner, old, asked, m);
  return m;
}

// ΔG = P (Ȳ − Ȳ_n) and T_n carried, with P and the rotation those of the plane at Ȳ. All of it changes with
// ξ̄ alone.
void SlidingKinematics::find_slip(const Partner& partner, const ContactPointState& old, Asked asked,
                                  PointMotion& m) const {
  const Point nu = m.master_normal;
  const Point way = old.anchored ? subtract(frame_.reference_y, old.anchor) : Point{};
  const bool carries = old.anchored && norm(old.traction) > 0;
  m.slip = contact::add_scaled(way, -dot(nu, way), nu);
  if (carries) m.carried = rotate(old.master_normal, nu, old.traction);
  if (asked == Asked::motion) return;
  const Tensor turn = carries ? rotation_rates(old.master_normal, nu, old.traction).by_to : Tensor{};
  const bool turns = carries && master_->reference_turns();
  std::array<Point, 2> slip_xi{}, carried_xi{};
  for (std::size_t alpha = 0; alpha + 1 < components_; ++alpha) {
    const Point& nu_xi = plane_normal_xi(partner, frame_, alpha);
    const Point& tau = frame_.reference_tau[alpha];
    if (old.anchored) {
      slip_xi[alpha] = contact::add_scaled(tau, -dot(nu, tau) - dot(nu_xi, way), nu);
      slip_xi[alpha] = contact::add_scaled(slip_xi[alpha], -dot(nu, way), nu_xi);
    }
    if (turns) carried_xi[alpha] = times(turn, nu_xi);
  }
  for (std::size_t c = 0; c < n_nodes_; ++c) {
    slip_rate_[c] = {};
    carried_rate_[c] = {};
    for (std::size_t alpha = 0; alpha + 1 < components_; ++alpha) {
      add_outer(slip_rate_[c], 1, slip_xi[alpha], xi_rate_[c][alpha]);
      if (turns) add_outer(carried_rate_[c], 1, carried_xi[alpha], xi_rate_[c][alpha]);
    }
  }
  if (turns) m.carried_rate = std::span(carried_rate_).first(n_nodes_);
}

std::span<const Point> SlidingKinematics::find_weight_rates(std::size_t point) const {
  const std::array<double, 2>& slope = partner_[point].covered_xi;
  if (slope[0] == 0 && slope[1] == 0) return {};
  for (std::size_t c = 0; c < n_nodes_; ++c) {
    weight_rate_[c] = {};
    for (std::size_t alpha = 0; alpha + 1 < components_; ++alpha)
      weight_rate_[c] =
          contact::add_scaled(weight_rate_[c], weight_[point] * slope[alpha], xi_rate_[c][alpha]);
  }
  return std::span(weight_rate_).first(n_nodes_);
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
  const Point a = contact::add_scaled(frame_.tau[0], -g, frame_.nu_xi[0]);
  const Point b = contact::add_scaled(frame_.tau[1], -g, frame_.nu_xi[1]);
  const Point bc = scale(-1, cross(b, nu)), ca = scale(-1, cross(nu, a)), ab = cross(a, b);
  const double det = dot(a, bc);
  const std::array<Point, 3> row{scale(1 / det, bc), scale(1 / det, ca), scale(1 / det, ab)};
  for (std::size_t c = 0; c < n_nodes_; ++c) {
    Tensor right{}, total{};
    add_identity(right, share_[c], components_);
    if (c >= n_slave_) {
      total = frame_.nu_rate[c - n_slave_];
      contact::add_scaled(right, g, total);
    }
    xi_rate_[c] = {};
    for (std::size_t alpha = 0; alpha + 1 < components_; ++alpha) {
      xi_rate_[c][alpha] = transposed_times(right, row[alpha]);
      add_outer(total, 1, frame_.nu_xi[alpha], xi_rate_[c][alpha]);
    }
    penetration_rate_[c] = transposed_times(right, row[2]);
    normal_rate_[c] = total;
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
  const Point t = contact::add_scaled(scale(e1, frame_.tau[0]), e2, frame_.tau[1]);
  Point curvature = contact::add_scaled(scale(e1 * e1, frame_.tau_xi[0]), e2 * e2, frame_.tau_xi[1]);
  curvature = contact::add_scaled(curvature, 2 * e1 * e2, frame_.tau_xi[2]);
  const double stiffness = dot(t, t) + g * dot(nu, curvature);
  for (std::size_t c = 0; c < n_nodes_; ++c) {
    double slope = 0;
    if (c >= n_slave_) slope = e1 * frame_.slope[c - n_slave_][0] + e2 * frame_.slope[c - n_slave_][1];
    Point along{};
    if (edge) along = scale(1 / stiffness, contact::add_scaled(scale(share_[c], t), -g * slope, nu));
    if (components_ == 2) along = {};
    xi_rate_[c] = {scale(e1, along), scale(e2, along)};
    Point dg = scale(-share_[c], nu);
    for (std::size_t i = components_; i < 3; ++i) dg[i] = 0;
    penetration_rate_[c] = dg;
    Tensor& turn = normal_rate_[c] = {};
    add_identity(turn, -share_[c] / g, components_);
    add_outer(turn, 1 / g, t, along);
    add_outer(turn, -1 / g, nu, dg);
  }
}

void SlidingKinematics::add_geometric_tangent(Index point, double pressure, const Point& traction,
                                              std::span<Tensor> k) const {
  const auto p = static_cast<std::size_t>(point);
  const Partner& partner = partner_[p];
  assert(k.size() == n_nodes_ * n_nodes_);
  const PushRates push = push_rates(
      frame_, plane_normal(partner, frame_),
      {plane_normal_xi(partner, frame_, 0), plane_normal_xi(partner, frame_, 1)}, partner.normal, traction);
  const Point force = contact::add_scaled(push.pushed, -pressure, partner.normal);
  const double w = weight_of(p);
  for (std::size_t c = 0; c < n_nodes_; ++c) {
    // ∂f/∂x_c
    Tensor turn{};
    contact::add_scaled(turn, -pressure, normal_rate_[c]);
    const bool on_face = c >= n_slave_ && c < n_slave_ + static_cast<std::size_t>(frame_.n_face_nodes);
    for (std::size_t alpha = 0; alpha + 1 < components_; ++alpha) {
      add_outer(turn, 1, push.by_xi[alpha], xi_rate_[c][alpha]);
      if (on_face) contact::add_scaled(turn, frame_.slope[c - n_slave_][alpha], push.by_tau[alpha]);
    }
    contact::add_scaled(turn, 1, times(push.by_normal, normal_rate_[c]));
    for (std::size_t b = 0; b < n_nodes_; ++b) {
      Tensor& block = k[b * n_nodes_ + c];
      if (share_[b] != 0) contact::add_scaled(block, w * share_[b], turn);
      if (b < n_slave_ || b - n_slave_ >= static_cast<std::size_t>(frame_.n_face_nodes)) continue;
      for (std::size_t alpha = 0; alpha + 1 < components_; ++alpha)
        add_outer(block, -w * frame_.slope[b - n_slave_][alpha], force, xi_rate_[c][alpha]);
    }
  }
}

SlidingKinematics::ReferenceRates SlidingKinematics::reference_rates(Index point) const {
  const Partner& met = partner(point);
  place_rate_.assign(n_nodes_, Tensor{});
  turn_rate_.assign(n_nodes_, Tensor{});
  for (std::size_t c = 0; c < n_nodes_; ++c)
    for (std::size_t alpha = 0; alpha + 1 < components_; ++alpha) {
      add_outer(place_rate_[c], 1, frame_.reference_tau[alpha], xi_rate_[c][alpha]);
      add_outer(turn_rate_[c], 1, plane_normal_xi(met, frame_, alpha), xi_rate_[c][alpha]);
    }
  return {place_rate_, turn_rate_};
}

void SlidingKinematics::add_share_rates(Index, std::span<Point> rates) const {
  assert(rates.size() == n_nodes_ * n_nodes_);
  for (std::size_t a = 0; a < static_cast<std::size_t>(frame_.n_face_nodes); ++a)
    for (std::size_t b = 0; b < n_nodes_; ++b) {
      Point& rate = rates[(n_slave_ + a) * n_nodes_ + b];
      for (std::size_t alpha = 0; alpha + 1 < components_; ++alpha)
        rate = contact::add_scaled(rate, -frame_.slope[a][alpha], xi_rate_[b][alpha]);
    }
}

std::span<const Index> SlidingKinematics::allowed(Index slave_face) const {
  const auto f = static_cast<std::size_t>(slave_face);
  return std::span(allowed_).subspan(first_allowed_[f], first_allowed_[f + 1] - first_allowed_[f]);
}

bool SlidingKinematics::graph_outdated() const {
  if (master_->max_nodes() == 0) return first_allowed_.empty();
  for (std::size_t p = 0; p < face_.size(); ++p) {
    if (concern_[p] != reached || partner_[p].face < 0 || partner_[p].penetration < -options_.graph_distance)
      continue;
    if (first_allowed_.empty()) return true;
    const auto faces = allowed(face_[p]);
    if (!std::binary_search(faces.begin(), faces.end(), partner_[p].face)) return true;
  }
  return false;
}

void SlidingKinematics::add_to_graph(CliqueSink& sink) {
  allowed_.clear();
  first_allowed_.assign(1, 0);
  // The graph of the matrix has room for the partners that a point may get while the graph holds: the faces
  // around its present partner, ring by ring.
  std::vector<Index> faces, wider, clique;
  std::size_t p = 0;
  for (Index slave = 0; slave < slave_.n_faces(); ++slave) {
    faces.clear();
    for (; p < face_.size() && face_[p] == slave; ++p)
      if (concern_[p] != none && partner_[p].face >= 0 && partner_[p].penetration >= -options_.graph_distance)
        faces.push_back(partner_[p].face);
    for (int ring = 0; ring < options_.graph_rings; ++ring) {
      wider.clear();
      for (Index f : faces) wider.insert(wider.end(), master_->around(f).begin(), master_->around(f).end());
      faces.insert(faces.end(), wider.begin(), wider.end());
      std::sort(faces.begin(), faces.end());
      faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    }
    const auto own = slave_.nodes(slave);
    if (master_->max_nodes() == 0) {
      sink.add(own);
      faces.clear();
    }
    clique.assign(own.begin(), own.end());
    for (Index f : faces) {
      if (!options_.meets_several) clique.resize(own.size());
      clique.insert(clique.end(), master_->nodes(f).begin(), master_->nodes(f).end());
      if (!options_.meets_several) sink.add(clique);
    }
    if (options_.meets_several && !faces.empty()) {
      std::sort(clique.begin(), clique.end());
      clique.erase(std::unique(clique.begin(), clique.end()), clique.end());
      sink.add(clique);
    }
    // What is allowed is kept for each slave face, so that a point that leaves it is noticed and the graph
    // made again.
    allowed_.insert(allowed_.end(), faces.begin(), faces.end());
    first_allowed_.push_back(allowed_.size());
  }
}

}  // namespace solidus::contact
