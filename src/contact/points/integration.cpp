/// Each rule finds points with their partners face by face; points of one pair of faces are stored together
/// as a pairing, with the shape functions of all its nodes.
#include "contact/points/integration.hpp"

#include <algorithm>

#include "contact/points/nodal_means.hpp"
#include "contact/points/point_list.hpp"
#include "contact/surfaces/slave_rule.hpp"
#include "mesh/quadrature.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"

namespace solidus::contact {

namespace {

// At the edge of the master, points of the rules `nodal` and `gauss` that miss it by this much, in reference
// coordinates of its face, still belong to it: on curved surfaces the two discrete edges never coincide.
constexpr double k_edge_tolerance = 0.02;

double measure_of(const Face& face, AnalysisKind kind) {
  double sum = 0;
  for (const auto& q : mesh::gauss_rule(face.shape, face.affine() ? 2 : 6))
    sum += q.weight * face.jacobian(q.xi) * circumference(kind, face.at(q.xi));
  return sum;
}

/// The length of the edges of a face; of a line the number of its ends.
double perimeter(const Face& face) {
  if (face.dimension() == 1) return 2;
  const auto n = as_size(mesh::vertex_count(face.shape));
  double sum = 0;
  for (std::size_t a = 0; a < n; ++a) sum += distance(face.x[a], face.x[(a + 1) % n]);
  return sum;
}

class Builder {
 public:
  Builder(const mesh::Mesh& mesh, AnalysisKind kind, const ContactSurface& slave,
          const ContactSurface& master, const IntegrationOptions& options)
      : mesh_(mesh),
        kind_(kind),
        slave_(slave),
        master_(master),
        options_(options),
        everything_(options.rule == IntegrationRule::mortar),
        search_(reference_faces(master)),
        slave_heights_(slave),
        master_heights_(master) {}

  ContactPoints build() {
    for (Index f = 0; f < slave_.n_faces(); ++f) add_slave_face(f);
    points_.paired_measure = parallel::global_sum(points_.paired_measure);
    return std::move(points_);
  }

 private:
  bool owns_any(std::span<const Index> nodes) const {
    return std::any_of(nodes.begin(), nodes.end(), [&](Index n) { return n < mesh_.n_owned_nodes; });
  }

  void add_slave_face(Index f) {
    // A slave face concerns this process if it, or a master face within reach, has a node that the process
    // owns.
    const Face face = slave_.reference_face(f);
    points_.slave_measure += measure_of(face, kind_);
    const auto slave_nodes = slave_.nodes(f);
    const std::vector<Index> candidates = faces_within(face, search_, options_.search_distance);
    const bool mine = everything_ || owns_any(slave_nodes) ||
                      std::any_of(candidates.begin(), candidates.end(),
                                  [&](Index m) { return owns_any(master_.nodes(m)); });
    if (!mine) return;
    // Segments cut the face at the edges of the master below it, so that each piece has one partner. Rules
    // with points at fixed places look for the partner of each point.
    found_.clear();
    switch (options_.rule) {
      case IntegrationRule::automatic:
      case IntegrationRule::segments:
      case IntegrationRule::mortar:
        (face.dimension() == 1 ? cut_line : cut_face)(face, search_, candidates,
                                                      {.search_distance = options_.search_distance}, found_);
        complete(f, face);
        break;
      case IntegrationRule::gauss:
      case IntegrationRule::nodal:
        for (const SlaveRulePoint& q : slave_rule(face, kind_, options_.rule, options_.gauss_degree))
          add_point(face, q.xi, q.weight, candidates);
        break;
    }
    // Points with the same partner are stored together, because they share their nodes.
    std::stable_sort(found_.begin(), found_.end(), [](const PairedPoint& a, const PairedPoint& b) {
      return a.master_face < b.master_face;
    });
    for (std::size_t first = 0; first < found_.size();) {
      std::size_t last = first;
      while (last < found_.size() && found_[last].master_face == found_[first].master_face) ++last;
      store(f, face, first, std::span(found_).subspan(first, last - first));
      first = last;
    }
  }

  // Two bodies that end in one plane face each other up to it. Their facets do not where their surfaces are
  // curved: the normal of a facet leans by up to the angle by which the surface turns along it, and what lies
  // next to the end of the slave looks past that of the master, by the gap times this angle. A face that
  // lacks no more than such a strip along its edges stands for all of its area.
  void complete(Index f, const Face& face) {
    double found = 0, moment = 0;
    for (const PairedPoint& point : found_) {
      found += point.measure;
      moment += point.measure *
                distance(face.at(point.slave_xi), search_.face(point.master_face).at(point.master_xi));
    }
    const double all = face.measure(), lost = all - found;
    constexpr double k_rounding = 1e-9;
    if (!(found > 0) || lost <= k_rounding * all) return;
    const double strip = slave_heights_.turn(f) * moment / found;
    if (lost > strip * perimeter(face)) return;
    for (PairedPoint& point : found_) point.measure *= all / found;
  }

  void add_point(const Face& face, const Point& xi, double measure, const std::vector<Index>& candidates) {
    const SurfacePoint partner =
        search_.along(face.at(xi), face.normal(xi), options_.search_distance, k_edge_tolerance, candidates);
    if (partner.face >= 0) found_.push_back({partner.face, xi, partner.projection.xi, measure});
  }

  // Points of one slave face and one master face become a pairing, when they touch a node of this process.
  void store(Index slave_face, const Face& face, std::size_t place, std::span<const PairedPoint> found) {
    const Index master_face = found.front().master_face;
    const auto s = slave_.nodes(slave_face), m = master_.nodes(master_face);
    if (!everything_ && !owns_any(s) && !owns_any(m)) return;
    // The pairing says where its nodes, points and shape functions begin in the common arrays.
    Pairing p;
    p.slave_face = slave_face;
    p.master_face = master_face;
    p.n_slave = static_cast<int>(s.size());
    p.n_master = static_cast<int>(m.size());
    p.first_node = points_.nodes.size();
    p.first_point = points_.n_points();
    p.n_points = as_index(found.size());
    p.first_shape = points_.shape.size();
    p.counted = s[0] < mesh_.n_owned_nodes;
    points_.nodes.insert(points_.nodes.end(), s.begin(), s.end());
    points_.nodes.insert(points_.nodes.end(), m.begin(), m.end());
    // Shape functions of the slave count with plus, those of the master with minus, so that Σ B_b
    // u_b is the relative displacement.
    const Face& partner = search_.face(master_face);
    std::array<double, k_max_face_nodes> values, master_values;
    for (const PairedPoint& point : found) {
      mesh::basis_values(face.shape, point.slave_xi, values);
      points_.shape.insert(points_.shape.end(), values.begin(), values.begin() + p.n_slave);
      mesh::basis_values(partner.shape, point.master_xi, master_values);
      for (std::size_t b = 0; b < m.size(); ++b) points_.shape.push_back(-master_values[b]);
      points_.facets.push_back(facet_gap(slave_heights_, slave_face, std::span(values).first(s.size()),
                                         &master_heights_, master_face,
                                         std::span(master_values).first(m.size())));
      const Point x = face.at(point.slave_xi), n = face.normal(point.slave_xi);
      // The other rules' measures hold the circumference already.
      const bool placed = options_.rule == IntegrationRule::gauss || options_.rule == IntegrationRule::nodal;
      const double w = point.measure * (placed ? 1.0 : circumference(kind_, x));
      // A point's number is that of its face and its place on it: the same on every number of
      // processes.
      points_.number.push_back(slave_face * k_points_of_a_face + static_cast<GlobalIndex>(place++));
      points_.weight.push_back(w);
      points_.normal.push_back(n);
      points_.position.push_back(x);
      points_.initial_penetration.push_back(dot(subtract(x, partner.at(point.master_xi)), n));
      // The area is summed by the owner of the face, once for all processes.
      if (p.counted) points_.paired_measure += w;
    }
    points_.pairings.push_back(p);
  }

  const mesh::Mesh& mesh_;
  AnalysisKind kind_;
  const ContactSurface& slave_;
  const ContactSurface& master_;
  IntegrationOptions options_;
  bool everything_;  ///< the points that this process does not need itself, too
  FaceSearch search_;
  FacetHeights slave_heights_, master_heights_;
  ContactPoints points_;
  std::vector<PairedPoint> found_;
};

}  // namespace

std::vector<Index> faces_within(const Face& slave, const FaceSearch& master, double reach) {
  auto [low, high] = slave.box();
  const double margin = 1e-6 * distance(low, high);
  // The normals of a face of straight edges are one; of a curved one they turn, hence every direction.
  const Point n = slave.normal(reference_centre(slave.shape));
  const bool flat = slave.affine();
  for (std::size_t i = 0; i < 3; ++i) {
    const double r = (flat ? std::abs(n[i]) : 1.0) * reach + margin;
    low[i] -= r;
    high[i] += r;
  }
  return master.candidates(low, high);
}

std::size_t ContactPoints::bytes() const {
  return pairings.capacity() * sizeof(Pairing) + nodes.capacity() * sizeof(Index) +
         (shape.capacity() + weight.capacity() + initial_penetration.capacity()) * sizeof(double) +
         (normal.capacity() + position.capacity()) * sizeof(Point) + facets.capacity() * sizeof(FacetGap) +
         number.capacity() * sizeof(GlobalIndex);
}

ContactPoints integrate(const mesh::Mesh& mesh, AnalysisKind kind, const ContactSurface& slave,
                        const ContactSurface& master, const IntegrationOptions& options) {
  ContactPoints points = Builder(mesh, kind, slave, master, options).build();
  return options.rule == IntegrationRule::mortar ? means_around_nodes(mesh, slave, points) : points;
}

}  // namespace solidus::contact
