#include "contact/points/sliding_points.hpp"

#include <algorithm>
#include <utility>

#include "contact/surfaces/slave_rule.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::contact {

SlidingPoints::SlidingPoints(const mesh::Mesh& mesh, AnalysisKind kind, const ContactSurface& slave,
                             std::unique_ptr<Master> master, const SlidingOptions& options)
    : mesh_(mesh),
      components_(as_size(displacement_components(kind))),
      slave_(slave),
      master_(std::move(master)),
      options_(options) {
  // Points are laid on the slave's faces, and those that may concern this process are found.
  add_points(kind, options);
  find_faces_that_concern();

  // At the start each point finds its partner. One that lies behind the master there would be pushed through
  // the body, and has no partner until it comes out.
  place(std::vector<double>(mesh.x.size() * components_, 0.0), ContactKinematics::Points::all);
  for (std::size_t p = 0; p < table_.partner.size(); ++p) {
    table_.behind[p] = table_.partner[p].face >= 0 && master_->behind(table_.partner[p]) ? 1 : 0;
    if (table_.behind[p] != 0) table_.partner[p] = {};
  }
  double all = 0, paired = 0;
  for (std::size_t p = 0; p < table_.weight.size(); ++p) {
    all += table_.weight[p];
    if (table_.partner[p].face >= 0) paired += weight_of(p);
  }
  coverage_ = paired / all;
}

void SlidingPoints::add_points(AnalysisKind kind, const SlidingOptions& options) {
  for (Index f = 0; f < slave_.n_faces(); ++f) {
    const Face face = slave_.reference_face(f);
    Index number = 0;
    for (const SlaveRulePoint& q : slave_rule(face, kind, options.rule, options.gauss_degree))
      add_point({.face = f, .xi = q.xi, .weight = q.weight}, number++, face);
  }
  start_points();
}

void SlidingPoints::add_point(const SlavePlace& place, Index number, const Face& face) {
  table_.face.push_back(place.face);
  table_.number.push_back(number);
  table_.xi.push_back(place.xi);
  table_.position.push_back(face.at(place.xi));
  table_.weight.push_back(place.weight);
  mesh::basis_values(face.shape, place.xi, table_.shape.emplace_back());
  table_.hint.push_back(place.hint);
}

void SlidingPoints::start_points() {
  table_.x = table_.position;
  table_.partner.assign(table_.weight.size(), {});
  table_.behind.assign(table_.weight.size(), 0);
  table_.concern.assign(table_.weight.size(), reached);
}

void SlidingPoints::set_places(std::span<const SlavePlace> places) {
  for (auto* indices : {&table_.face, &table_.number, &table_.hint}) indices->clear();
  for (auto* points : {&table_.xi, &table_.position}) points->clear();
  table_.weight.clear();
  table_.shape.clear();
  Face face;
  Index number = 0;
  for (const SlavePlace& place : places) {
    if (table_.face.empty() || table_.face.back() != place.face) {
      face = slave_.reference_face(place.face);
      number = 0;
    }
    add_point(place, number++, face);
  }
  start_points();
}

bool SlidingPoints::own_slave(std::size_t point) const {
  const auto nodes = slave_.nodes(table_.face[point]);
  return std::any_of(nodes.begin(), nodes.end(), [&](Index n) { return n < mesh_.n_owned_nodes; });
}

void SlidingPoints::find_faces_that_concern() {
  // Faces of the master matter to this process if they are near its own nodes. Rings of neighbours are added
  // to the faces with own nodes: first those that the graph of the matrix reaches, then those near them.
  const auto own = [&](Index node) { return node < mesh_.n_owned_nodes; };
  all_own_ = std::all_of(slave_.all_nodes().begin(), slave_.all_nodes().end(), own);
  if (all_own_) return;
  const auto n_faces = as_size(master_->n_faces());
  std::vector<char> found(n_faces, 0);
  for (Index f = 0; f < master_->n_faces(); ++f) {
    const auto nodes = master_->nodes(f);
    found[as_size(f)] = std::any_of(nodes.begin(), nodes.end(), own) ? 1 : 0;
  }
  const auto widen = [&](int rings) {
    for (int ring = 0; ring < rings; ++ring) {
      const std::vector<char> inner = found;
      for (Index f = 0; f < master_->n_faces(); ++f)
        if (inner[as_size(f)] != 0)
          for (const Index g : master_->around(f)) found[as_size(g)] = 1;
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
  // A partner lies on the closest face or on a neighbour of it, so one more ring is watched.
  widen(1);
  master_->watch(std::move(found));
}

ContactKinematics::Particle SlidingPoints::particle(Index point) const {
  const auto p = as_size(point);
  const auto nodes = slave_.nodes(table_.face[p]);
  return {.number = table_.face[p] * k_points_of_a_face + table_.number[p],
          .counted = nodes[0] < mesh_.n_owned_nodes,
          .position = table_.position[p],
          .area = table_.weight[p],
          .weight = weight_of(p),
          .nodes = nodes,
          .share = std::span(table_.shape[p]).first(nodes.size())};
}

Point SlidingPoints::place_of(std::size_t point, const Face& face) const {
  Point x{};
  for (std::size_t a = 0; a < as_size(face.n_nodes); ++a)
    x = contact::add_scaled(x, table_.shape[point][a], face.x[a]);
  return x;
}

void SlidingPoints::place(std::span<const double> displacement, ContactKinematics::Points points) {
  master_->place(displacement, time_);
  Face face;
  bool own = true;
  for (std::size_t p = 0; p < table_.face.size(); ++p) {
    if (p == 0 || table_.face[p] != table_.face[p - 1]) {
      face = slave_.current_face(table_.face[p], displacement, static_cast<int>(components_));
      own = all_own_ || own_slave(p);
    }
    table_.x[p] = place_of(p, face);
    const Point normal = face.normal(table_.xi[p]);
    table_.partner[p] = {};
    const bool asked = own || points == ContactKinematics::Points::all ||
                       master_->may_meet_watched(table_.x[p], normal, table_.hint[p]);
    if (asked && table_.behind[p] == 0)
      table_.partner[p] = master_->find(table_.x[p], normal, table_.hint[p]);
    const Index met = table_.partner[p].face;
    if (met >= 0) table_.hint[p] = met;
    table_.concern[p] = own ? reached : met < 0 || face_concern_.empty() ? none : face_concern_[as_size(met)];
  }
}

}  // namespace solidus::contact
