/// The closest face comes first. Then it depends on where the foot lies: inside a face, at an edge or
/// vertex between faces (a wedge), or at the free boundary, beyond which contact fades within a strip.
#include "contact/surfaces/master_mesh.hpp"

#include <algorithm>
#include <cmath>

#include "numbers/index_casts.hpp"

namespace solidus::contact {

namespace {

// A face is continued by this much beyond its rim, in its reference coordinates, between faces of (almost)
// one plane, where the wedge between their normals is as thin as rounding.
constexpr double k_flat = 1e-8;
constexpr int k_max_iterations = 30;

double mean_diagonal(std::span<const Face> faces) {
  double sum = 0;
  for (const Face& f : faces) {
    const auto [low, high] = f.box();
    sum += distance(low, high);
  }
  return sum / static_cast<double>(faces.size());
}

// Angle of the face at a vertex; one for the ends of lines.
double vertex_angle(const Face& face, std::size_t v) {
  if (face.dimension() == 1) return 1;
  const auto n = as_size(mesh::vertex_count(face.shape));
  const Point a = subtract(face.x[(v + 1) % n], face.x[v]);
  const Point b = subtract(face.x[(v + n - 1) % n], face.x[v]);
  return std::atan2(norm(cross(a, b)), dot(a, b));
}

struct Basis {
  std::array<Point, 2> tau{};
  std::array<Point, 3> tau_xi{};
  Point normal{};
  std::array<Point, 2> normal_xi{};  // ν,α = −k_αβ τ^β (Weingarten)
};

Basis basis_at(const Face& face, const Point& xi) {
  Basis b;
  // The tangents and their derivatives by ξ are those of the shape functions (monograph, 3.1.4).
  b.tau = face.tangents(xi);
  b.tau_xi = face.curvatures(xi);
  const Point n = cross(b.tau[0], b.tau[1]);
  b.normal = scale(1 / norm(n), n);
  // The normal turns with the place by the curvature of the face (Weingarten).
  const auto dual = dual_basis(b.tau);
  const double k11 = dot(b.tau_xi[0], b.normal), k22 = dot(b.tau_xi[1], b.normal),
               k12 = dot(b.tau_xi[2], b.normal);
  b.normal_xi = {add_scaled(scale(-k11, dual[0]), -k12, dual[1]),
                 add_scaled(scale(-k12, dual[0]), -k22, dual[1])};
  return b;
}

}  // namespace

MeshMaster::MeshMaster(int components, const ContactSurface& surface, const MeshMasterOptions& options)
    : surface_(surface),
      components_(components),
      options_(options),
      reference_(reference_faces(surface)),
      faces_(reference_),
      topology_(surface_),
      heights_(surface),
      search_(faces_, 0.25 * mean_diagonal(faces_)) {
  // Smoothed normals are kept for the reference too: slip is measured there.
  if (options.smoothing) {
    reference_normals_.emplace(surface, options.feature_angle);
    normals_.emplace(surface, options.feature_angle);
    reference_normals_->place(reference_);
    normals_->place(faces_);
  }
  // The tree of boxes is built for the undeformed faces; it serves until they have moved by its
  // margin.
  search_.move(faces_);
  // Where the normal varies along a face, the traction turns as its point slides.
  turns_ = options.smoothing;
  for (Index f = 0; f < surface.n_faces(); ++f) {
    max_nodes_ = std::max(max_nodes_, nodes(f).size());
    turns_ = turns_ || !face(f).affine();
  }
}

std::span<const Index> MeshMaster::nodes(Index face) const {
  return normals_ ? normals_->nodes(face) : surface_.nodes(face);
}

bool MeshMaster::reference_turns() const {
  return turns_;
}

void MeshMaster::place(std::span<const double> displacement, double) {
  for (Index f = 0; f < surface_.n_faces(); ++f)
    faces_[as_size(f)] = surface_.current_face(f, displacement, components_);
  if (normals_) normals_->place(faces_);
  search_.move(faces_);
}

Partner MeshMaster::on_face(Index f, const Point& xi, const Point& x) const {
  Partner p;
  p.face = f;
  p.xi = xi;
  p.normal = face(f).normal(xi);
  p.penetration = -dot(subtract(x, face(f).at(xi)), p.normal);
  return p;
}

// The face on whose continuation, by up to `tolerance` beyond its rim, x has its foot; of several the first.
Partner MeshMaster::continued(const SurfacePoint& closest, const Feature& feature, const Point& x,
                              double tolerance) const {
  for (Index f : feature.faces) {
    const Point start = f == closest.face ? closest.projection.xi : closest_point(face(f), x).xi;
    const Projection foot = closest_point_extended(face(f), x, start);
    if (foot.found && outside_by(face(f).shape, foot.xi) <= tolerance) return on_face(f, foot.xi, x);
  }
  return {};
}

// x lies in the wedge that the normals at an edge or a vertex leave open.
Partner MeshMaster::in_wedge(const Feature& feature, const SurfacePoint& closest, const Point& x) const {
  // Inside or outside is told by the sum of the normals, weighted with the angles at a vertex (Bærentzen,
  // Aanæs 2005).
  Point outward{};
  for (Index f : feature.faces) {
    if (feature.kind == Feature::Kind::edge) {
      outward = add(outward, face(f).normal(closest_point(face(f), x).xi));
      continue;
    }
    const Index node = topology_.vertex(closest.face, feature.local);
    const auto v = as_size(topology_.local_vertex(f, node));
    outward =
        add_scaled(outward, vertex_angle(face(f), v), face(f).normal(reference_vertices(face(f).shape)[v]));
  }
  const Point r = subtract(x, closest.projection.y);
  const double d = norm(r);
  Partner p = on_face(closest.face, closest.projection.xi, x);
  // A point on the edge itself has no direction: it takes the face's.
  if (!(d > 1e-13 * distance(face(closest.face).x[0], face(closest.face).x[1]))) return p;
  const double side = dot(r, outward) > 0 ? 1 : -1;
  p.region = feature.kind == Feature::Kind::edge ? Partner::Region::edge : Partner::Region::vertex;
  if (feature.kind == Feature::Kind::edge) p.along = edge_direction(face(p.face).shape, feature.local);
  p.normal = scale(side / d, r);
  p.penetration = -side * d;
  return p;
}

void MeshMaster::cover(Partner& partner, double outside) const {
  partner.covered = 1;
  partner.covered_xi = {};
  if (outside <= k_rim) return;
  const double per_outside = -1 / (options_.rim - k_rim);
  partner.covered = -(options_.rim - outside) * per_outside;
  partner.covered_xi = outside_by_xi(face(partner.face).shape, partner.xi);
  for (double& slope : partner.covered_xi) slope *= per_outside;
}

// Finds, among the faces whose continuation beyond the free boundary holds x, the one that ends nearest.
Partner MeshMaster::beyond_rim(const SurfacePoint& closest, const Feature& feature, const Point& x) const {
  double least = options_.rim;
  Partner best;
  // A corner of the boundary belongs to several faces, each of which may be continued.
  for (Index f : feature.faces) {
    const Point start = f == closest.face ? closest.projection.xi : closest_point(face(f), x).xi;
    const Projection foot = closest_point_extended(face(f), x, start);
    if (!foot.found) continue;
    const double outside = outside_by(face(f).shape, foot.xi);
    // Of equally near faces the first stays, whatever the order of rounding.
    if (outside > least || (best.face >= 0 && outside == least)) continue;
    least = outside;
    best = on_face(f, foot.xi, x);
    // The contribution fades with the distance beyond the boundary, so that a point which slides
    // off loses its force gradually.
    cover(best, outside);
  }
  return best;
}

// At a vertex of the free boundary: the edges between faces that end there, continued a little.
Partner MeshMaster::along_edge(const Feature& vertex, const Point& x) const {
  for (Index f : vertex.faces)
    // Only edges between two faces continue; the rim's own edges are handled by beyond_rim.
    for (int e = 0; e < topology_.n_edges(f); ++e) {
      const auto faces = topology_.at_edge(f, e);
      if (faces.size() != 2) continue;
      const auto i = as_size(e);
      const auto vertices = reference_vertices(face(f).shape);
      // The edge is continued in space as a line, on which the foot of the point is found.
      const Face line = edge_of(face(f), i);
      const Projection foot = closest_point_extended(line, x, closest_point(line, x).xi);
      if (!foot.found) continue;
      const double outside = outside_by(line.shape, foot.xi);
      if (outside > options_.rim) continue;
      // Back from the line's coordinate in [−1, 1] to the place on the face.
      const double s = 0.5 * (1 + foot.xi[0]);
      const Point xi = add_scaled(vertices[i], s, edge_direction(face(f).shape, e));
      const Feature edge{Feature::Kind::edge, e, faces, false};
      Partner p = in_wedge(edge, {f, {true, xi, foot.y, foot.distance}}, x);
      cover(p, outside);
      p.covered_xi = {};  // along the edge: not told by the place on the face
      return p;
    }
  return {};
}

Partner MeshMaster::flat(const SurfacePoint& closest, const Point& x) const {
  const Feature feature = topology_.feature(closest.face, closest.projection.xi);
  if (feature.kind == Feature::Kind::interior) return on_face(closest.face, closest.projection.xi, x);
  if (const Partner p = continued(closest, feature, x, k_flat); p.face >= 0) return p;
  if (!feature.free) return in_wedge(feature, closest, x);
  if (const Partner p = beyond_rim(closest, feature, x); p.face >= 0) return p;
  return feature.kind == Feature::Kind::vertex ? along_edge(feature, x) : Partner{};
}

// Newton's method for x = y(ξ) − g ν(ξ) on one face.
Partner MeshMaster::smooth_on(Index f, const Point& start, const Point& x, double tolerance) const {
  const Face& here = face(f);
  const double allowed = std::max(1e-13, here.rounding());
  Point xi = start;
  double g = 0;
  for (int i = 0; i < k_max_iterations; ++i) {
    const auto d = normals_->at(f, here.shape, xi);
    if (i == 0) g = -dot(subtract(x, here.at(xi)), d.nu);
    // The residual and its derivatives by both parameters and by the gap, solved by Cramer's rule.
    const Point r = add_scaled(subtract(x, here.at(xi)), g, d.nu);
    const auto tau = here.tangents(xi);
    const Point a = add_scaled(tau[0], -g, d.nu_xi[0]), b = add_scaled(tau[1], -g, d.nu_xi[1]);
    const Point c = scale(-1, d.nu);
    const double det = dot(a, cross(b, c));
    if (!(std::abs(det) > 1e-10 * norm(a) * norm(b))) return {};
    const double d1 = dot(r, cross(b, c)) / det, d2 = here.dimension() == 1 ? 0 : dot(r, cross(c, a)) / det;
    const double length = std::max(std::abs(d1), std::abs(d2));
    // A step longer than one is cut, as parameters of a face lie between -1 and 1.
    const double step = length > 1 ? 1 / length : 1;
    xi = {xi[0] + step * d1, xi[1] + step * d2, 0};
    g += step * dot(r, cross(a, b)) / det;
    if (outside_by(here.shape, xi) > 2) return {};
    if (length > allowed && i + 1 < k_max_iterations) continue;
    // The partner must have converged and lie on the face, or beyond it by no more than the tolerance.
    if (length > 1e-9 || outside_by(here.shape, xi) > tolerance) return {};
    Partner p;
    p.face = f;
    p.averaged = true;
    p.xi = xi;
    p.normal = normals_->at(f, here.shape, xi).nu;
    p.penetration = -dot(subtract(x, here.at(xi)), p.normal);
    return p;
  }
  return {};
}

// On the face of the closest point, else on the one around it that is nearest. None across a sharp edge.
Partner MeshMaster::smooth(const SurfacePoint& closest, const Point& x) const {
  // With averaged normals the partner is where the interpolated normal points at x, mostly on the
  // closest face.
  Partner best = smooth_on(closest.face, closest.projection.xi, x, k_flat);
  if (best.face >= 0) return best;
  for (Index f : topology_.around(closest.face)) {
    if (f == closest.face) continue;
    const Partner p = smooth_on(f, closest_point(face(f), x).xi, x, k_flat);
    if (p.face >= 0 && (best.face < 0 || std::abs(p.penetration) < std::abs(best.penetration))) best = p;
  }
  if (best.face >= 0) return best;
  // On neither: the point may lie beyond the free boundary, within the strip in which contact
  // fades.
  const Feature feature = topology_.feature(closest.face, closest.projection.xi);
  double least = options_.rim;
  for (Index f : feature.faces) {
    if (!feature.free) break;
    const Partner p = smooth_on(f, closest_point(face(f), x).xi, x, least);
    if (p.face < 0) continue;
    const double outside = outside_by(face(f).shape, p.xi);
    if (best.face >= 0 && outside == least) continue;
    least = outside;
    best = p;
    cover(best, outside);
  }
  return best;
}

Partner MeshMaster::find(const Point& x, const Point& slave_normal, Index hint) const {
  const SurfacePoint closest = search_.closest(x, options_.search_distance, slave_normal, hint);
  if (closest.face < 0) return {};
  Partner p = normals_ ? smooth(closest, x) : Partner{};
  if (p.face < 0) p = flat(closest, x);
  if (p.face < 0 || !(std::abs(p.penetration) <= options_.search_distance)) return {};
  return dot(p.normal, slave_normal) < k_facing_cosine ? p : Partner{};
}

void MeshMaster::frame(const Partner& partner, bool rates, MasterFrame& frame) const {
  // The frame of a partner holds all that the kinematics of a point asks of the master at ξ: nodes, shape
  // functions and their slopes, place, tangents and normals, now and in the reference configuration.
  const Face& now = face(partner.face);
  const Face& then = reference_[as_size(partner.face)];
  const auto n = as_size(now.n_nodes);
  const auto dim = as_size(now.dimension());
  frame.n_face_nodes = now.n_nodes;
  frame.nodes = partner.averaged ? normals_->nodes(partner.face) : surface_.nodes(partner.face);
  mesh::basis_values(now.shape, partner.xi, frame.share);
  std::array<double, 2 * k_max_face_nodes> g;
  mesh::basis_gradients(now.shape, partner.xi, g);
  for (std::size_t a = 0; a < n; ++a) frame.slope[a] = {g[a * dim], dim == 2 ? g[a * dim + 1] : 0.0};

  // Tangents and curvature are those of the face as it lies now; slip is measured on the reference face.
  const Basis b = basis_at(now, partner.xi), reference = basis_at(then, partner.xi);
  frame.y = now.at(partner.xi);
  frame.tau = b.tau;
  frame.tau_xi = b.tau_xi;
  frame.face_normal = b.normal;
  frame.reference_y = then.at(partner.xi);
  frame.reference_tau = reference.tau;
  frame.reference_tau_xi = reference.tau_xi;
  frame.reference_face_normal = reference.normal;
  frame.reference_face_normal_xi = reference.normal_xi;
  // Averaged normals are interpolated between nodes, and their rates reach all faces around.
  if (partner.averaged) {
    const auto d = normals_->at(partner.face, now.shape, partner.xi);
    const auto e = reference_normals_->at(partner.face, now.shape, partner.xi);
    frame.nu = d.nu;
    frame.nu_xi = d.nu_xi;
    frame.reference_nu = e.nu;
    frame.reference_nu_xi = e.nu_xi;
    if (rates)
      normals_->rates(partner.face, faces_, partner.xi, std::span(frame.nu_rate).first(frame.nodes.size()));
    return;
  }
  // Without them the normal is that of the face.
  frame.nu = b.normal;
  frame.nu_xi = b.normal_xi;
  frame.reference_nu = reference.normal;
  frame.reference_nu_xi = reference.normal_xi;
  if (!rates) return;
  // Its rate follows from the tangents: only the component of the motion along the normal turns it.
  const auto dual = dual_basis(b.tau);
  for (std::size_t a = 0; a < n; ++a) {
    frame.nu_rate[a] = {};
    for (std::size_t alpha = 0; alpha < dim; ++alpha)
      add_outer(frame.nu_rate[a], -frame.slope[a][alpha], dual[alpha], b.normal);
  }
}

}  // namespace solidus::contact
