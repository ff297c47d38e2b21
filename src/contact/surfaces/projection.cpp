/// Newton's method in reference coordinates for both kinds of projection, guarded so that it goes downhill;
/// edges are searched where the interior has no minimum.
#include "contact/surfaces/projection.hpp"

#include <algorithm>
#include <limits>

#include "numbers/index_casts.hpp"

namespace solidus::contact {

namespace {

constexpr int k_max_iterations = 50;
constexpr double k_xi_tolerance = 1e-13;  ///< in reference coordinates, a few units in the last place

struct Step {
  double d1 = 0, d2 = 0;
};

// Solves [a c; c b] d = −g; a one-dimensional problem has b = 1, c = 0, g2 = 0.
bool solve(double a, double b, double c, double g1, double g2, Step& step) {
  const double det = a * b - c * c;
  if (!(std::abs(det) > 1e-14 * (a * a + b * b + c * c))) return false;
  step = {-(b * g1 - c * g2) / det, -(a * g2 - c * g1) / det};
  return true;
}

double half_square(const Face& face, const Point& xi, const Point& p) {
  const Point r = subtract(face.at(xi), p);
  return 0.5 * dot(r, r);
}

// Minimises ½|x(ξ) − p|² without constraint, by Newton with backtracking. Far from the minimum, or on its
// wrong side, the Hessian may be indefinite: then the Gauss–Newton matrix, which never is, gives the
// direction. Steps are limited to the size of the reference shape. Returns true when the gradient vanished.
bool minimise(const Face& face, const Point& p, Point& xi) {
  const bool line = face.dimension() == 1;
  const double allowed = std::max(k_xi_tolerance, face.rounding());
  double value = half_square(face, xi, p);
  for (int i = 0; i < k_max_iterations; ++i) {
    const auto [t1, t2] = face.tangents(xi);
    const auto [x11, x22, x12] = face.curvatures(xi);
    const Point r = subtract(face.at(xi), p);
    const double g1 = dot(r, t1), g2 = line ? 0 : dot(r, t2);
    const double m11 = dot(t1, t1), m22 = line ? 1 : dot(t2, t2), m12 = line ? 0 : dot(t1, t2);
    const double h11 = m11 + dot(r, x11), h22 = line ? 1 : m22 + dot(r, x22);
    const double h12 = line ? 0 : m12 + dot(r, x12);
    Step s;
    const bool convex = h11 > 0 && h11 * h22 - h12 * h12 > 0;
    if (!(convex && solve(h11, h22, h12, g1, g2, s)) && !solve(m11, m22, m12, g1, g2, s)) return false;
    const double length = std::max(std::abs(s.d1), std::abs(s.d2));
    if (length < allowed) return true;
    double alpha = length > 1 ? 1 / length : 1;
    // Near the minimum the values no longer tell rounding from descent: accept the step there.
    const double slack = 1e-14 * (value + 1e-300);
    Point next = xi;
    double there = value;
    for (int cut = 0; cut < 30; ++cut, alpha *= 0.5) {
      next = {xi[0] + alpha * s.d1, xi[1] + alpha * s.d2, 0};
      there = half_square(face, next, p);
      if (there <= value + slack || length < 1e-7) break;
    }
    if (outside_by(face.shape, next) > 4) return false;  // the minimum is not on this face: edges decide
    xi = next;
    value = there;
  }
  return false;
}

struct Best {
  Point xi{};
  double value = std::numeric_limits<double>::max();
};
void keep_better(const Face& face, const Point& p, const Point& xi, Best& best) {
  const double value = half_square(face, xi, p);
  // A later candidate must be better by more than rounding, so that the result does not depend on it.
  if (value < best.value * (1 - 1e-12)) best = {xi, value};
}

void try_interior(const Face& face, const Point& p, Point start, Best& best) {
  if (minimise(face, p, start) && outside_by(face.shape, start) <= 1e-12)
    keep_better(face, p, clamp(face.shape, start), best);
}

// True when the distance surely has no more than one stationary point on the face: affine faces, and bilinear
// ones whose warp is small against the distance, |r·∂²x/∂ξ∂η| well below the smaller eigenvalue of the
// metric.
bool one_minimum(const Face& face, const Point& p) {
  if (face.affine()) return true;
  if (mesh::vertex_count(face.shape) != 4 || !face.straight_edges()) return false;
  const Point centre = face.at({});
  const auto [t1, t2] = face.tangents({});
  const Point twist = scale(0.25, subtract(add(face.x[0], face.x[2]), add(face.x[1], face.x[3])));
  const double farthest = distance(p, centre) + norm(t1) + norm(t2);
  const double least = dot(cross(t1, t2), cross(t1, t2)) / (dot(t1, t1) + dot(t2, t2));
  return 4 * norm(twist) * (farthest + norm(t1) + norm(t2)) < least;
}

void try_line(const Face& line, const Point& p, Best& best) {
  // On a straight line there is a formula; on a curved one several starts find several minima, and the ends
  // bound it.
  if (line.n_nodes == 2) {
    const Point d = subtract(line.x[1], line.x[0]);
    const double s = dot(subtract(p, line.x[0]), d) / dot(d, d);
    keep_better(line, p, {std::clamp(2 * s - 1, -1.0, 1.0), 0, 0}, best);
    return;
  }
  try_interior(line, p, {}, best);
  if (!line.affine())
    for (double start : {-0.7, 0.7}) try_interior(line, p, {start, 0, 0}, best);
  keep_better(line, p, {-1, 0, 0}, best);
  keep_better(line, p, {1, 0, 0}, best);
}

}  // namespace

Face edge_of(const Face& face, std::size_t e) {
  const auto v = as_size(mesh::vertex_count(face.shape));
  Face edge;
  edge.shape = mesh::order(face.shape) == 1 ? mesh::Shape::line2 : mesh::Shape::line3;
  edge.n_nodes = mesh::node_count(edge.shape);
  edge.x[0] = face.x[e];
  edge.x[1] = face.x[(e + 1) % v];
  if (edge.n_nodes == 3) edge.x[2] = face.x[v + e];
  return edge;
}

Projection closest_point(const Face& face, const Point& p) {
  Best best;
  // A line has no edges: its ends are tried along with its interior.
  if (face.dimension() == 1) {
    try_line(face, p, best);
  } else {
    const auto vertices = reference_vertices(face.shape);
    // Newton's method from the centre finds the minimum of a face with one; others are tried from near each
    // vertex too, and the edges bound the face.
    try_interior(face, p, reference_centre(face.shape), best);
    const bool one = one_minimum(face, p);
    const bool done = one && best.value < std::numeric_limits<double>::max();
    if (!one)
      for (const Point& v : vertices)
        try_interior(face, p, scale(0.5, add(v, reference_centre(face.shape))), best);
    // The minimum may lie on the boundary of the face, so each edge is searched as a line and its ξ
    // mapped back.
    for (std::size_t e = 0; e < vertices.size() && !done; ++e) {
      Best on_edge;
      try_line(edge_of(face, e), p, on_edge);
      const double s = 0.5 * (1 + on_edge.xi[0]);
      const Point& end = vertices[(e + 1) % vertices.size()];
      keep_better(face, p, add(scale(1 - s, vertices[e]), scale(s, end)), best);
    }
  }
  const Point y = face.at(best.xi);
  return {true, best.xi, y, distance(p, y)};
}

Projection closest_point_extended(const Face& face, const Point& p, const Point& start) {
  Projection result;
  result.xi = start;
  result.found = minimise(face, p, result.xi);
  result.y = face.at(result.xi);
  result.distance = distance(p, result.y);
  return result;
}

Projection project_along_extended(const Face& face, const Point& p, const Point& d) {
  // The point ξ of the face is sought whose difference to p is parallel to d: two equations, along directions
  // e₁ and e₂ normal to d (one in the plane).
  const bool line = face.dimension() == 1;
  Point e1, e2;
  if (line) {
    e1 = {-d[1], d[0], 0};
    e2 = {};
  } else {
    tangent_basis(d, e1, e2);
  }
  Projection result;
  const double allowed = std::max(k_xi_tolerance, face.rounding());
  Point xi = reference_centre(face.shape);
  // Newton's method on the face, which is continued beyond its edges; a face that is seen edge-on has no
  // answer.
  for (int i = 0; i < k_max_iterations; ++i) {
    const Point r = subtract(face.at(xi), p);
    const auto [t1, t2] = face.tangents(xi);
    const double a11 = dot(t1, e1), a12 = line ? 0 : dot(t2, e1);
    const double a21 = line ? 0 : dot(t1, e2), a22 = line ? 1 : dot(t2, e2);
    const double r1 = dot(r, e1), r2 = line ? 0 : dot(r, e2);
    const double det = a11 * a22 - a12 * a21;
    const double scale_of_det = line ? norm(t1) : norm(t1) * norm(t2);
    if (!(std::abs(det) > 1e-10 * scale_of_det)) return result;  // the face is seen edge-on
    double d1 = -(a22 * r1 - a12 * r2) / det, d2 = line ? 0 : -(a11 * r2 - a21 * r1) / det;
    const double length = std::max(std::abs(d1), std::abs(d2));
    xi = {xi[0] + d1, xi[1] + d2, 0};
    if (!(length < 1e6)) return result;
    // The iteration ends by its step, absolute or relative where ξ is large.
    if (length < allowed || (i > 0 && length < 1e-11 * (1 + std::abs(xi[0]) + std::abs(xi[1])))) {
      result.found = true;
      break;
    }
  }
  result.xi = xi;
  result.y = face.at(xi);
  result.distance = dot(subtract(result.y, p), d);
  return result;
}

Projection project_along(const Face& face, const Point& p, const Point& d, double tolerance) {
  // The face is continued first; whether the point lies on it is decided afterwards, with the
  // tolerance.
  Projection result = project_along_extended(face, p, d);
  if (!result.found) return result;
  const double outside = outside_by(face.shape, result.xi);
  // Slightly outside the point is drawn onto the face.
  if (outside > tolerance) {
    result.found = false;
  } else if (outside > 0) {
    result.xi = clamp(face.shape, result.xi);
    result.y = face.at(result.xi);
    result.distance = dot(subtract(result.y, p), d);
  }
  return result;
}

}  // namespace solidus::contact
