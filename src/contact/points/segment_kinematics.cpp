/// When bodies move, the faces of the slave are cut again and every piece gets its place on the master; a
/// cell's motion is the mean over its pieces, by area.
#include "contact/points/segment_kinematics.hpp"

#include <algorithm>
#include <cassert>

#include "contact/points/point_list.hpp"
#include "contact/surfaces/face_cells.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::contact {

namespace {

// A cell of which less than this share is covered has no partner: rounding at the master's end.
constexpr double k_least_covered = 1e-9;

}  // namespace

SegmentKinematics::SegmentKinematics(const mesh::Mesh& mesh, AnalysisKind kind, const ContactSurface& slave,
                                     const ContactSurface& master, std::unique_ptr<Master> met,
                                     double search_distance)
    : kind_(kind),
      components_(as_size(displacement_components(kind))),
      slave_(slave),
      master_(master),
      reach_(search_distance),
      degree_(degree_of_pieces(master)),
      places_(mesh, kind, slave, std::move(met), {.graph_rings = 1, .meets_several = true}),
      n_owned_(mesh.n_owned_nodes) {
  // Cells are laid on the reference faces once; pieces are cut whenever bodies move.
  add_cells();
  place(std::vector<double>(mesh.x.size() * components_, 0.0));
  // The share of the slave's area that faces the master.
  double whole = 0, covered = 0;
  for (std::size_t c = 0; c < cells_.face.size(); ++c) {
    whole += cells_.whole[c];
    covered += cells_.covered[c];
  }
  coverage_ = covered / whole;
}

/// Shape functions are integrated, not their products: a degree that does so exactly on affine faces, with
/// the circumference, and closely on others, whose functions are rational in the plane.
int SegmentKinematics::degree_of_pieces(const ContactSurface& master) const {
  int degree = kind_ == AnalysisKind::axisymmetric ? 2 : 1;
  for (const ContactSurface* surface : {&slave_, &master})
    for (Index f = 0; f < surface->n_faces(); ++f) {
      const Face face = surface->reference_face(f);
      degree =
          std::max(degree, product_degree(face, face) / 2 + (kind_ == AnalysisKind::axisymmetric ? 1 : 0));
    }
  return degree;
}

void SegmentKinematics::add_cells() {
  std::array<double, k_max_face_nodes> shape{};
  for (Index f = 0; f < slave_.n_faces(); ++f) {
    const Face face = slave_.reference_face(f);
    cells_.first_cell.push_back(n_points());
    Index number = 0;
    // A cell is where one value of pressure lives: its area, its centre and the mean of the shape functions
    // on it.
    for (const std::vector<Point>& cell : face_cells(face.shape)) {
      cells_.face.push_back(f);
      cells_.number.push_back(number++);
      // Pressure is constant on a cell, so that its motion is the mean over the cell's pieces.
      double& whole = cells_.whole.emplace_back(0.0);
      Point& position = cells_.position.emplace_back();
      auto& mean = cells_.shape.emplace_back();
      for (const SlaveRulePoint& q : cell_rule(face, kind_, cell, 6)) {
        mesh::basis_values(face.shape, q.xi, shape);
        whole += q.weight;
        position = contact::add_scaled(position, q.weight, face.at(q.xi));
        for (std::size_t a = 0; a < as_size(face.n_nodes); ++a) mean[a] += q.weight * shape[a];
      }
      // Means instead of integrals over the cell.
      position = scale(1 / whole, position);
      for (double& value : mean) value /= whole;
    }
  }
  cells_.first_cell.push_back(n_points());
  cells_.covered.assign(cells_.face.size(), 0.0);
}

SegmentKinematics::Particle SegmentKinematics::particle(Index point) const {
  const std::size_t c = as_size(point);
  const auto nodes = slave_.nodes(cells_.face[c]);
  const bool counted = nodes[0] < n_owned_;
  const bool met = cells_.covered[c] > 0;
  return {.number = cells_.face[c] * k_points_of_a_face + cells_.number[c],
          .counted = counted,
          .position = cells_.position[c],
          .area = cells_.whole[c],
          .weight = met ? cells_.covered[c] : cells_.whole[c],
          .nodes = nodes,
          .share = std::span(cells_.shape[c]).first(nodes.size())};
}

void SegmentKinematics::cut(Index slave_face, const Face& now, const FaceSearch& master) {
  // Only faces of the master within reach of the present face are cut against it.
  const Face reference = slave_.reference_face(slave_face);
  const std::vector<Index> candidates = faces_within(now, master, reach_);
  std::vector<PairedPoint> pieces;
  (now.dimension() == 1 ? cut_line : cut_face)(
      now, master, candidates, {.search_distance = reach_, .cells = true, .degree = degree_}, pieces);
  const auto cell = [&](const PairedPoint& p) { return cell_of(now.shape, p.slave_xi); };
  // Pieces in order of their cells, with weights of the undeformed slave.
  std::ranges::stable_sort(pieces, {}, cell);
  std::size_t next = 0;
  // The loop fills the range of each cell of the face in turn, empty ones included, so that cell c
  // has the places [cells_.first_place[c], cells_.first_place[c + 1]).
  for (const Index last = cells_.first_cell[as_size(slave_face) + 1];
       as_index(cells_.first_place.size()) <= last;) {
    const std::size_t number = as_size(cells_.number[cells_.first_place.size() - 1]);
    for (; next < pieces.size() && cell(pieces[next]) == number; ++next) {
      const PairedPoint& p = pieces[next];
      const double area = p.measure * reference.jacobian(p.slave_xi) / now.jacobian(p.slave_xi);
      found_.push_back({.face = slave_face,
                        .xi = p.slave_xi,
                        .weight = area * circumference(kind_, reference.at(p.slave_xi)),
                        .hint = p.master_face});
    }
    cells_.first_place.push_back(as_index(found_.size()));
  }
}

void SegmentKinematics::place(std::span<const double> displacement, Points) {
  const int components = static_cast<int>(components_);
  // Faces of the master as they lie now; a tree over them finds the candidates of each slave face.
  std::vector<Face> faces;
  for (Index f = 0; f < master_.n_faces(); ++f)
    faces.push_back(master_.current_face(f, displacement, components));
  const FaceSearch master(std::move(faces));
  found_.clear();
  cells_.first_place.assign(1, 0);
  for (Index f = 0; f < slave_.n_faces(); ++f)
    cut(f, slave_.current_face(f, displacement, components), master);
  places_.points().set_places(found_);
  // All of them: a mean needs every place of its cell.
  places_.place(displacement, Points::all);
  // A cell that is covered in a sliver alone has no stable mean: it counts as one without a
  // partner.
  for (std::size_t c = 0; c < cells_.face.size(); ++c) {
    cells_.covered[c] = 0;
    for (Index s = cells_.first_place[c]; s < cells_.first_place[c + 1]; ++s)
      if (places_.points().table().partner[as_size(s)].face >= 0)
        cells_.covered[c] += places_.particle(s).weight;
    if (cells_.covered[c] < k_least_covered * cells_.whole[c]) cells_.covered[c] = 0;
  }
}

FacetGap SegmentKinematics::facets(Index point) const {
  FacetGap mean;
  if (cells_.covered[as_size(point)] == 0) return mean;
  // The mean over the pieces of the cell, by area.
  for (Index s = cells_.first_place[as_size(point)]; s < cells_.first_place[as_size(point) + 1]; ++s) {
    if (places_.points().table().partner[as_size(s)].face < 0) continue;
    const FacetGap here = places_.facets(s);
    const double alpha = places_.particle(s).weight / cells_.covered[as_size(point)];
    mean.height += alpha * here.height;
    mean.bound += alpha * here.bound;
    mean.fits += alpha * here.fits;
  }
  return mean;
}

bool SegmentKinematics::concerns(Index point) const {
  for (Index s = cells_.first_place[as_size(point)]; s < cells_.first_place[as_size(point) + 1]; ++s)
    if (places_.concerns(s)) return true;
  return false;
}

void SegmentKinematics::number_nodes(const PointMotion& place) const {
  last_.where.clear();
  // Nodes of all pieces of a cell in one list, and where each piece has its own in it.
  for (const Index node : place.nodes) {
    last_.where.push_back(as_size(as_index(std::ranges::find(last_.nodes, node) - last_.nodes.begin())));
    if (last_.where.back() < last_.nodes.size()) continue;
    last_.nodes.push_back(node);
    last_.share.push_back(0);
    last_.normal_share.emplace_back();
    last_.push_share.emplace_back();
    last_.penetration_rate.emplace_back();
    last_.way_rate.emplace_back();
    last_.turn_rate.emplace_back();
  }
}

template <class Visit>
void SegmentKinematics::for_each_place(Index point, Asked asked, Visit visit) const {
  for (Index s = cells_.first_place[as_size(point)]; s < cells_.first_place[as_size(point) + 1]; ++s) {
    if (places_.points().table().partner[as_size(s)].face < 0) continue;
    const PointMotion place = places_.motion(s, {}, asked);
    number_nodes(place);
    visit(s, place);
  }
}

PointMotion SegmentKinematics::motion(Index point, const ContactPointState& old, Asked asked) const {
  // A cell has the means over its places, each of which faces one master face. Without any covered part it
  // has no partner.
  const std::size_t c = as_size(point);
  PointMotion m;
  m.weight = particle(point).weight;
  if (cells_.covered[c] == 0) return m;
  m.covered = std::min(cells_.covered[c] / cells_.whole[c], 1.0);
  last_.nodes.clear();
  last_.share.clear();
  for (auto* points : {&last_.normal_share, &last_.penetration_rate}) points->clear();
  for (auto* tensors : {&last_.push_share, &last_.way_rate, &last_.turn_rate}) tensors->clear();
  Point normal{}, way = cells_.position[c];
  // The weight of a place over that of the cell is its share α in gap, normal, push and slip; its nodes are
  // collected in one list for the cell.
  for_each_place(point, asked, [&](Index s, const PointMotion& place) {
    const double alpha = place.weight / m.weight;
    m.n_slave = place.n_slave;
    m.penetration += alpha * place.penetration;
    normal = contact::add_scaled(normal, alpha, place.normal);
    m.master_normal = contact::add_scaled(m.master_normal, alpha, place.master_normal);
    contact::add_scaled(m.push, alpha, place.push);
    way = contact::add_scaled(way, alpha, subtract(places_.reference_place(), places_.particle(s).position));
    // Normal and push shares of a node are means of their own, because places of one cell may have several
    // normals.
    for (std::size_t b = 0; b < place.nodes.size(); ++b) {
      const double share = alpha * place.share[b];
      last_.share[last_.where[b]] += share;
      last_.normal_share[last_.where[b]] =
          contact::add_scaled(last_.normal_share[last_.where[b]], share, place.normal);
      contact::add_scaled(last_.push_share[last_.where[b]], share, place.push);
    }
    if (asked == Asked::rates) add_rates(s, alpha, place);
  });
  // The mean normal is made a unit vector; the anchor lies on the master along it where the cell is open.
  m.partnered = true;
  m.nodes = last_.nodes;
  m.share = last_.share;
  m.normal_share = last_.normal_share;
  m.push_share = last_.push_share;
  m.normal = scale(1 / norm(normal), normal);
  m.master_normal = scale(1 / norm(m.master_normal), m.master_normal);
  m.anchor = contact::add_scaled(way, std::max(-m.penetration, 0.0), m.master_normal);
  if (asked == Asked::rates) m.penetration_rate = last_.penetration_rate;
  // The slip follows from the mean way and the state before.
  find_slip(old, way, asked, m);
  return m;
}

void SegmentKinematics::add_rates(Index place, double share, const PointMotion& of) const {
  const SlidingKinematics::ReferenceRates reference = places_.reference_rates(place);
  for (std::size_t b = 0; b < of.nodes.size(); ++b) {
    const std::size_t node = last_.where[b];
    last_.penetration_rate[node] =
        contact::add_scaled(last_.penetration_rate[node], share, of.penetration_rate[b]);
    contact::add_scaled(last_.way_rate[node], share, reference.place[b]);
    contact::add_scaled(last_.turn_rate[node], share, reference.normal[b]);
  }
}

// ΔG = P (W − W_n) with W the mean way and P = 1 − ν ⊗ ν of the mean normal; T_n is carried to its plane.
void SegmentKinematics::find_slip(const ContactPointState& old, const Point& way, Asked asked,
                                  PointMotion& m) const {
  // The slip is the way of the mean partner since the step's start, without its part along the
  // normal.
  const Point& nu = m.master_normal;
  const Point gone = old.anchored ? subtract(way, old.anchor) : Point{};
  const double along = dot(nu, gone);
  const bool carries = old.anchored && norm(old.traction) > 0;
  m.slip = contact::add_scaled(gone, -along, nu);
  if (carries) m.carried = rotate(old.master_normal, nu, old.traction);
  // Rates are needed of tangents only; those of the normal enter through the projection P and the
  // rotation of T_n.
  if (asked == Asked::motion) return;
  const Tensor turn = carries ? rotation_rates(old.master_normal, nu, old.traction).by_to : Tensor{};
  last_.slip_rate.assign(last_.nodes.size(), Tensor{});
  last_.carried_rate.assign(last_.nodes.size(), Tensor{});
  for (std::size_t b = 0; b < last_.nodes.size() && old.anchored; ++b) {
    Tensor& slip = last_.slip_rate[b];
    slip = last_.way_rate[b];
    add_outer(slip, -1, nu, transposed_times(last_.way_rate[b], nu));
    add_outer(slip, -1, nu, transposed_times(last_.turn_rate[b], gone));
    contact::add_scaled(slip, -along, last_.turn_rate[b]);
    if (carries) last_.carried_rate[b] = times(turn, last_.turn_rate[b]);
  }
  m.slip_rate = last_.slip_rate;
  if (carries) m.carried_rate = last_.carried_rate;
}

void SegmentKinematics::add_geometric_tangent(Index point, double pressure, const Point& traction,
                                              std::span<Tensor> k) const {
  const std::size_t n = last_.nodes.size();
  assert(k.size() == n * n);
  std::vector<Tensor> part;
  // Pieces add theirs at the places of their nodes in the list of the cell.
  for_each_place(point, Asked::rates, [&](Index s, const PointMotion& place) {
    const std::size_t m = place.nodes.size();
    part.assign(m * m, Tensor{});
    places_.add_geometric_tangent(s, pressure, traction, part);
    for (std::size_t b = 0; b < m; ++b)
      for (std::size_t c = 0; c < m; ++c)
        contact::add_scaled(k[last_.where[b] * n + last_.where[c]], 1, part[b * m + c]);
  });
}

void SegmentKinematics::add_share_rates(Index point, std::span<Point> rates) const {
  const std::size_t n = last_.nodes.size();
  assert(rates.size() == n * n);
  std::vector<Point> part;
  // The shares of a cell are the mean of those of its pieces by their weights.
  for_each_place(point, Asked::rates, [&](Index s, const PointMotion& place) {
    const std::size_t m = place.nodes.size();
    part.assign(m * m, Point{});
    places_.add_share_rates(s, part);
    for (std::size_t a = 0; a < m; ++a)
      for (std::size_t b = 0; b < m; ++b) {
        Point& rate = rates[last_.where[a] * n + last_.where[b]];
        rate = contact::add_scaled(rate, place.weight / cells_.covered[as_size(point)], part[a * m + b]);
      }
  });
}

}  // namespace solidus::contact
