/// Gauss points of the line, from which those of quadrangles and hexahedra follow; orbits of symmetric
/// points for triangles and tetrahedra; nodal rules at the corners.
#include "mesh/quadrature.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "mesh/shape_table.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mesh {

namespace {

struct Gauss1 {
  double x, w;
};

// Gauss–Legendre on [−1, 1] by Newton's method on the Legendre polynomial (exact to rounding for any n).
std::vector<Gauss1> gauss_legendre(int n) {
  std::vector<Gauss1> rule(as_size(n));
  for (int i = 0; i < n; ++i) {
    // The start is close to the i-th root; Newton's method needs few iterations from there.
    double x = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5)), slope = 0;
    for (int iteration = 0; iteration < 50; ++iteration) {
      // Legendre's polynomial by its three-term recurrence.
      double p = 1, previous = 0;
      for (int k = 1; k <= n; ++k) {
        const double next = ((2 * k - 1) * x * p - (k - 1) * previous) / k;
        previous = p;
        p = next;
      }
      slope = n * (x * p - previous) / (x * x - 1);
      const double dx = p / slope;
      x -= dx;
      if (std::abs(dx) < 1e-16) break;
    }
    if (2 * i + 1 == n) x = 0;
    rule[as_size(n - 1 - i)] = {x, 2 / ((1 - x * x) * slope * slope)};
  }
  return rule;
}

Rule cube(int dim, int n) {
  const auto line = gauss_legendre(n);
  Rule rule{{{0, 0, 0}, 1}};
  // The last direction outermost, so that points run as nodes do: x fastest.
  for (int d = 0; d < dim; ++d) {
    Rule wider;
    for (const Gauss1& g : line)
      for (QuadraturePoint p : rule) {
        p.xi[as_size(d)] = g.x;
        p.weight *= g.w;
        wider.push_back(p);
      }
    rule = std::move(wider);
  }
  return rule;
}

// A conical product rule: exact to degree 2n − 1 − (dim − 1) in every simplex, all points inside, all weights
// positive.
Rule collapsed_simplex(int dim, int n) {
  Rule rule;
  for (const QuadraturePoint& p : cube(dim, n)) {
    const double u = 0.5 * (1 + p.xi[0]), v = 0.5 * (1 + p.xi[1]), w = 0.5 * (1 + p.xi[2]);
    if (dim == 2)
      rule.push_back({{u, v * (1 - u), 0}, p.weight / 4 * (1 - u)});
    else
      rule.push_back({{u, v * (1 - u), w * (1 - u) * (1 - v)}, p.weight / 8 * (1 - u) * (1 - u) * (1 - v)});
  }
  return rule;
}

void add_triangle_orbit(Rule& rule, double a, double weight) {
  const double b = 1 - 2 * a;
  for (const Point& xi : {Point{a, a, 0}, Point{b, a, 0}, Point{a, b, 0}}) rule.push_back({xi, weight});
}

// Symmetric rules: degree 1 and 2 (Hammer, Marlowe, Stroud 1956), 4 and 5 (Cowper 1973; the latter Radon's).
Rule triangle(int degree) {
  Rule rule;
  if (degree <= 1) return {{{1.0 / 3, 1.0 / 3, 0}, 0.5}};
  if (degree <= 2) {
    add_triangle_orbit(rule, 1.0 / 6, 1.0 / 6);
  } else if (degree <= 4) {
    add_triangle_orbit(rule, 0.445948490915964886, 0.111690794839005732);
    add_triangle_orbit(rule, 0.091576213509770743, 0.054975871827660934);
  } else if (degree <= 5) {
    const double r = std::sqrt(15.0);
    rule.push_back({{1.0 / 3, 1.0 / 3, 0}, 9.0 / 80});
    add_triangle_orbit(rule, (6 - r) / 21, (155 - r) / 2400);
    add_triangle_orbit(rule, (6 + r) / 21, (155 + r) / 2400);
  } else {
    return collapsed_simplex(2, (degree + 3) / 2);
  }
  return rule;
}

// Degree 1, 2 (Hammer, Marlowe, Stroud 1956); beyond, conical products.
Rule tetrahedron(int degree) {
  if (degree <= 1) return {{{0.25, 0.25, 0.25}, 1.0 / 6}};
  if (degree <= 2) {
    const double a = (5 - std::sqrt(5.0)) / 20, b = 1 - 3 * a;
    return {{{a, a, a}, 1.0 / 24}, {{b, a, a}, 1.0 / 24}, {{a, b, a}, 1.0 / 24}, {{a, a, b}, 1.0 / 24}};
  }
  return collapsed_simplex(3, (degree + 4) / 2);
}

constexpr int k_highest_degree = 20;

}  // namespace

Rule gauss_rule(Shape shape, int degree) {
  if (degree < 0 || degree > k_highest_degree)
    throw std::invalid_argument("quadrature degree " + std::to_string(degree) + " is not between 0 and " +
                                std::to_string(k_highest_degree));
  // Gauss's rule of n points integrates degree 2 n - 1.
  const int n = degree / 2 + 1;
  const ShapeRow& row = row_of(shape);
  switch (row.reference) {
    case Reference::point:
      return {{{0, 0, 0}, 1}};
    case Reference::line:
    case Reference::cube:
      return cube(row.dimension, n);
    case Reference::simplex:
      return row.dimension == 2 ? triangle(degree) : tetrahedron(degree);
    case Reference::split:
      break;
  }
  return {};
}

Rule stiffness_rule(Shape shape) {
  return gauss_rule(shape, row_of(shape).stiffness_degree);
}

Rule nodal_rule(Shape shape) {
  static constexpr std::array<Point, 8> corner{
      {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}};
  // First the vertices of the reference element become points, then the middles of its edges; at last every
  // point gets an equal share of the reference volume as its weight.
  const int dim = dimension(shape), n = node_count(shape), vertices = vertex_count(shape);
  const bool simplex = row_of(shape).reference == Reference::simplex;
  double volume = 1;
  if (simplex)
    volume = dim == 2 ? 0.5 : 1.0 / 6;
  else
    for (int i = 0; i < dim; ++i) volume *= 2;

  Rule rule(as_size(n));
  for (int a = 0; a < vertices; ++a) {
    Point& xi = rule[as_size(a)].xi;
    xi = {0, 0, 0};
    if (simplex) {
      if (a > 0) xi[as_size(a - 1)] = 1;
    } else {
      for (std::size_t i = 0; i < as_size(dim); ++i) xi[i] = corner[as_size(a)][i];
    }
  }
  // A mid-edge node lies halfway between the two vertices of its edge. The list of a face has its vertices
  // first, then its mid-edge nodes in the order of its edges.
  if (order(shape) == 2) {
    if (dim == 1) {
      rule[2].xi = {0, 0, 0};
    } else {
      for (int f = 0; f < face_count(shape); ++f) {
        const Shape face = face_shape(shape);
        const auto local = face_nodes(shape, f);
        const int m = vertex_count(face);
        const auto edges = dim == 2 ? 1 : m;
        for (int e = 0; e < edges; ++e) {
          const Point& p = rule[as_size(local[as_size(e)])].xi;
          const Point& q = rule[as_size(local[as_size((e + 1) % m)])].xi;
          Point& mid = rule[as_size(local[as_size(m + e)])].xi;
          for (std::size_t i = 0; i < 3; ++i) mid[i] = 0.5 * (p[i] + q[i]);
        }
      }
    }
  }
  for (QuadraturePoint& p : rule) p.weight = volume / n;
  return rule;
}

}  // namespace solidus::mesh
