/// All of a face follows from the shape functions of its kind: place, tangents, normal, curvature; lines
/// and triangles are told apart only where coordinates are clamped.
#include "contact/surfaces/face.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/quadrature.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::contact {

namespace {

using mesh::Shape;

constexpr std::array<Point, 2> k_line_vertices{{{-1, 0, 0}, {1, 0, 0}}};
constexpr std::array<Point, 3> k_tri_vertices{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
constexpr std::array<Point, 4> k_quad_vertices{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}};

bool is_triangle(Shape shape) {
  return shape == Shape::tri3 || shape == Shape::tri6;
}
bool is_line(Shape shape) {
  return shape == Shape::line2 || shape == Shape::line3;
}

}  // namespace

Point Face::at(const Point& xi) const {
  std::array<double, k_max_face_nodes> n;
  mesh::basis_values(shape, xi, n);
  Point p{};
  for (std::size_t a = 0; a < as_size(n_nodes); ++a) p = add_scaled(p, n[a], x[a]);
  return p;
}

std::array<Point, 2> Face::tangents(const Point& xi) const {
  std::array<double, 2 * k_max_face_nodes> g;
  mesh::basis_gradients(shape, xi, g);
  const auto dim = as_size(dimension());
  std::array<Point, 2> t{};
  for (std::size_t a = 0; a < as_size(n_nodes); ++a)
    for (std::size_t i = 0; i < dim; ++i) t[i] = add_scaled(t[i], g[a * dim + i], x[a]);
  if (dim == 1) t[1] = {0, 0, 1};
  return t;
}

std::array<Point, 3> Face::curvatures(const Point& xi) const {
  if (mesh::order(shape) == 1) {
    if (shape != Shape::quad4) return {};
    return {Point{}, Point{}, scale(0.25, subtract(add(x[0], x[2]), add(x[1], x[3])))};
  }
  // The tangents are polynomials of degree two or less in each direction, for which the central difference
  // is exact whatever its width.
  constexpr double h = 0.5;
  const auto difference = [&](std::size_t direction, std::size_t tangent) {
    Point right = xi, left = xi;
    right[direction] += h;
    left[direction] -= h;
    return scale(0.5 / h, subtract(tangents(right)[tangent], tangents(left)[tangent]));
  };
  if (dimension() == 1) return {difference(0, 0), Point{}, Point{}};
  return {difference(0, 0), difference(1, 1), difference(1, 0)};
}

Point Face::normal(const Point& xi) const {
  const auto [t1, t2] = tangents(xi);
  const Point n = cross(t1, t2);
  return scale(1 / norm(n), n);
}

double Face::jacobian(const Point& xi) const {
  const auto [t1, t2] = tangents(xi);
  return norm(cross(t1, t2));
}

double Face::measure() const {
  double sum = 0;
  for (const auto& q : mesh::gauss_rule(shape, mesh::order(shape) == 1 ? 2 : 6))
    sum += q.weight * jacobian(q.xi);
  return sum;
}

double Face::size() const {
  return dimension() == 1 ? measure() : std::sqrt(measure());
}

double Face::rounding() const {
  constexpr double k_places = 16 * std::numeric_limits<double>::epsilon();
  double largest = 0;
  for (std::size_t a = 0; a < as_size(n_nodes); ++a)
    for (const double component : x[a]) largest = std::max(largest, std::abs(component));
  return k_places * largest / distance(x[0], x[1]);
}

std::array<Point, 2> Face::box() const {
  std::array<Point, 2> b{x[0], x[0]};
  for (std::size_t a = 1; a < as_size(n_nodes); ++a)
    for (std::size_t i = 0; i < 3; ++i) {
      b[0][i] = std::min(b[0][i], x[a][i]);
      b[1][i] = std::max(b[1][i], x[a][i]);
    }
  if (mesh::order(shape) == 2) {
    // A quadratic edge overshoots its nodes by at most an eighth of its width when its mid node lies within
    // the middle half.
    const double margin = 0.125 * distance(b[0], b[1]);
    for (std::size_t i = 0; i < 3; ++i) {
      b[0][i] -= margin;
      b[1][i] += margin;
    }
  }
  return b;
}

bool Face::straight_edges() const {
  if (mesh::order(shape) == 1) return true;
  const auto v = as_size(mesh::vertex_count(shape));
  const double tolerance = 1e-9 * distance(x[0], x[1]);
  for (std::size_t e = 0; e < (is_line(shape) ? 1 : v); ++e) {
    const Point middle = scale(0.5, add(x[e], x[(e + 1) % v]));
    if (distance(middle, x[v + e]) > tolerance) return false;
  }
  return true;
}

bool Face::affine() const {
  if (!straight_edges()) return false;
  if (is_line(shape) || is_triangle(shape)) return true;
  const Point defect = add(subtract(x[0], x[1]), subtract(x[2], x[3]));
  return norm(defect) <= 1e-9 * distance(x[0], x[2]);
}

Point reference_centre(Shape shape) {
  return is_triangle(shape) ? Point{1.0 / 3, 1.0 / 3, 0} : Point{};
}

std::span<const Point> reference_vertices(Shape shape) {
  if (is_line(shape)) return k_line_vertices;
  if (is_triangle(shape)) return k_tri_vertices;
  return k_quad_vertices;
}

double outside_by(Shape shape, const Point& xi) {
  if (is_line(shape)) return std::max(0.0, std::abs(xi[0]) - 1);
  if (is_triangle(shape)) return std::max({0.0, -xi[0], -xi[1], xi[0] + xi[1] - 1});
  return std::max({0.0, std::abs(xi[0]) - 1, std::abs(xi[1]) - 1});
}

std::array<double, 2> outside_by_xi(Shape shape, const Point& xi) {
  if (outside_by(shape, xi) == 0) return {};
  const auto sign = [](double v) { return v < 0 ? -1.0 : 1.0; };
  if (is_line(shape)) return {sign(xi[0]), 0};
  if (is_triangle(shape)) {
    const double across = xi[0] + xi[1] - 1;
    if (across >= std::max(-xi[0], -xi[1])) return {1, 1};
    return -xi[0] > -xi[1] ? std::array{-1.0, 0.0} : std::array{0.0, -1.0};
  }
  return std::abs(xi[0]) >= std::abs(xi[1]) ? std::array{sign(xi[0]), 0.0} : std::array{0.0, sign(xi[1])};
}

Point clamp(Shape shape, Point xi) {
  if (!is_triangle(shape)) {
    for (std::size_t i = 0; i < 2; ++i) xi[i] = std::clamp(xi[i], -1.0, 1.0);
    if (is_line(shape)) xi[1] = 0;
    return xi;
  }
  // Beyond the hypotenuse a point goes back along its normal, then onto the legs.
  if (const double excess = xi[0] + xi[1] - 1; excess > 0) {
    // Half of the excess on each axis is the step along the normal of the hypotenuse.
    xi[0] -= excess / 2;
    xi[1] -= excess / 2;
  }
  for (std::size_t i = 0; i < 2; ++i) xi[i] = std::clamp(xi[i], 0.0, 1.0);
  // Clamping one coordinate may lead beyond the hypotenuse again.
  if (const double sum = xi[0] + xi[1]; sum > 1) {
    xi[0] /= sum;
    xi[1] /= sum;
  }
  return xi;
}

}  // namespace solidus::contact
