/// Basis functions of simplices in barycentric coordinates, of quadrangles and hexahedra as products; the
/// table of shapes tells which is which.
#include "mesh/shape.hpp"

#include <cassert>

#include "mesh/shape_table.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mesh {

namespace {

// Vertices of the reference quad and hex.
constexpr std::array<std::array<int, 3>, 8> k_corner{
    {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}};

// Barycentric coordinates of a simplex: λ_0 = 1 − Σξ, λ_i = ξ_i.
std::array<double, 4> barycentric(int dim, const Point& xi) {
  std::array<double, 4> l{1, 0, 0, 0};
  for (std::size_t i = 0; i < as_size(dim); ++i) {
    l[i + 1] = xi[i];
    l[0] -= xi[i];
  }
  return l;
}
double barycentric_gradient(int a, int i) {
  return a == 0 ? -1.0 : (a == i + 1 ? 1.0 : 0.0);
}

/// Values of linear or quadratic simplices: vertices first, then the middles of edges.
void simplex_values(int dim, int order, Edges edges, const Point& xi, std::span<double> v) {
  const auto l = barycentric(dim, xi);
  const auto n = as_size(dim) + 1;
  for (std::size_t a = 0; a < n; ++a) v[a] = order == 1 ? l[a] : l[a] * (2 * l[a] - 1);
  if (order == 2)
    for (std::size_t e = 0; e < edges.size(); ++e)
      v[n + e] = 4 * l[as_size(edges[e].first)] * l[as_size(edges[e].second)];
}

/// The gradients of these by the product rule, with the constant gradients of the barycentric coordinates.
void simplex_gradients(int dim, int order, Edges edges, const Point& xi, std::span<double> g) {
  const auto l = barycentric(dim, xi);
  const auto d = as_size(dim);
  const std::size_t n = d + 1;
  for (std::size_t i = 0; i < d; ++i) {
    const int direction = static_cast<int>(i);
    for (std::size_t a = 0; a < n; ++a)
      g[a * d + i] = barycentric_gradient(static_cast<int>(a), direction) * (order == 1 ? 1.0 : 4 * l[a] - 1);
    if (order == 2)
      for (std::size_t e = 0; e < edges.size(); ++e) {
        const auto [p, q] = edges[e];
        g[(n + e) * d + i] = 4 * (barycentric_gradient(p, direction) * l[as_size(q)] +
                                  l[as_size(p)] * barycentric_gradient(q, direction));
      }
  }
}

// Tensor-product and serendipity shapes. A node of the reference cube has coordinates c ∈ {−1, 0, 1}; N is
// the product of its one-dimensional factors and, for vertices of the serendipity shapes, of (Σ c ξ − (d −
// 1)).
struct CubeNode {
  std::array<int, 3> c{};
};

/// A vertex, or the middle between the two vertices of an edge.
CubeNode cube_node(int dim, int a, Edges edges) {
  const int vertices = 1 << dim;
  if (a < vertices) return {k_corner[as_size(a)]};
  const auto [p, q] = edges[as_size(a - vertices)];
  CubeNode n;
  for (std::size_t i = 0; i < 3; ++i) n.c[i] = (k_corner[as_size(p)][i] + k_corner[as_size(q)][i]) / 2;
  return n;
}

double factor(int c, double x) {
  return c == 0 ? 1 - x * x : 0.5 * (1 + c * x);
}
double factor_slope(int c, double x) {
  return c == 0 ? -2 * x : 0.5 * c;
}

void cube_values(int dim, int order, int n_nodes, Edges edges, const Point& xi, std::span<double> v) {
  for (int a = 0; a < n_nodes; ++a) {
    const CubeNode node = cube_node(dim, a, edges);
    double value = 1, sum = 1.0 - dim;
    bool vertex = true;
    for (std::size_t i = 0; i < as_size(dim); ++i) {
      value *= factor(node.c[i], xi[i]);
      sum += node.c[i] * xi[i];
      vertex = vertex && node.c[i] != 0;
    }
    v[as_size(a)] = order == 2 && vertex ? value * sum : value;
  }
}

void cube_gradients(int dim, int order, int n_nodes, Edges edges, const Point& xi, std::span<double> g) {
  const auto d = as_size(dim);
  // Products of factors along the axes; vertices of quadratic serendipity elements have a sum as one more
  // factor.
  for (int a = 0; a < n_nodes; ++a) {
    const CubeNode node = cube_node(dim, a, edges);
    double value = 1, sum = 1.0 - dim;
    bool vertex = true;
    for (std::size_t i = 0; i < d; ++i) {
      value *= factor(node.c[i], xi[i]);
      sum += node.c[i] * xi[i];
      vertex = vertex && node.c[i] != 0;
    }
    for (std::size_t i = 0; i < d; ++i) {
      double slope = factor_slope(node.c[i], xi[i]);
      for (std::size_t j = 0; j < d; ++j)
        if (j != i) slope *= factor(node.c[j], xi[j]);
      g[as_size(a) * d + i] = order == 2 && vertex ? slope * sum + value * node.c[i] : slope;
    }
  }
}

}  // namespace

int node_count(Shape shape) {
  return row_of(shape).nodes;
}
int vertex_count(Shape shape) {
  return row_of(shape).vertices;
}
int dimension(Shape shape) {
  return row_of(shape).dimension;
}
int order(Shape shape) {
  return row_of(shape).order;
}
std::string_view name(Shape shape) {
  return row_of(shape).name;
}
int face_count(Shape shape) {
  return row_of(shape).faces;
}
Shape face_shape(Shape shape) {
  return row_of(shape).face;
}

/// Faces have rows of one width in the table; a narrower face uses the first numbers of its row.
std::span<const int> face_nodes(Shape shape, int face) {
  assert(face >= 0 && face < face_count(shape));
  const ShapeRow& row = row_of(shape);
  const auto f = as_size(face);
  const std::size_t width = row.face_nodes.size() / as_size(row.faces);
  return row.face_nodes.subspan(width * f, as_size(node_count(row.face)));
}

void basis_values(Shape shape, const Point& xi, std::span<double> v) {
  assert(static_cast<int>(v.size()) >= node_count(shape));
  const ShapeRow& row = row_of(shape);
  switch (row.reference) {
    case Reference::point:
      v[0] = 1;
      return;
    case Reference::line:
      if (row.order == 1) {
        v[0] = 0.5 * (1 - xi[0]);
        v[1] = 0.5 * (1 + xi[0]);
      } else {
        v[0] = 0.5 * xi[0] * (xi[0] - 1);
        v[1] = 0.5 * xi[0] * (xi[0] + 1);
        v[2] = 1 - xi[0] * xi[0];
      }
      return;
    case Reference::simplex:
      return simplex_values(row.dimension, row.order, row.edges, xi, v);
    case Reference::cube:
      return cube_values(row.dimension, row.order, row.nodes, row.edges, xi, v);
    case Reference::split:
      assert(false);
  }
}

void basis_gradients(Shape shape, const Point& xi, std::span<double> g) {
  assert(static_cast<int>(g.size()) >= node_count(shape) * dimension(shape));
  const ShapeRow& row = row_of(shape);
  switch (row.reference) {
    case Reference::point:
      return;
    case Reference::line:
      if (row.order == 1) {
        g[0] = -0.5;
        g[1] = 0.5;
      } else {
        g[0] = xi[0] - 0.5;
        g[1] = xi[0] + 0.5;
        g[2] = -2 * xi[0];
      }
      return;
    case Reference::simplex:
      return simplex_gradients(row.dimension, row.order, row.edges, xi, g);
    case Reference::cube:
      return cube_gradients(row.dimension, row.order, row.nodes, row.edges, xi, g);
    case Reference::split:
      assert(false);
  }
}

}  // namespace solidus::mesh
