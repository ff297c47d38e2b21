#include "mesh/shape.hpp"

#include <cassert>
#include <utility>

namespace solidus::mesh {

namespace {

struct Facts {
  std::string_view name;
  int dimension, order, nodes, vertices, faces;
  Shape face;
};

constexpr std::array<Facts, 11> k_facts{{
    {"point1", 0, 1, 1, 1, 0, Shape::point1},
    {"line2", 1, 1, 2, 2, 2, Shape::point1},
    {"line3", 1, 2, 3, 2, 2, Shape::point1},
    {"tri3", 2, 1, 3, 3, 3, Shape::line2},
    {"tri6", 2, 2, 6, 3, 3, Shape::line3},
    {"quad4", 2, 1, 4, 4, 4, Shape::line2},
    {"quad8", 2, 2, 8, 4, 4, Shape::line3},
    {"tet4", 3, 1, 4, 4, 4, Shape::tri3},
    {"tet10", 3, 2, 10, 4, 4, Shape::tri6},
    {"hex8", 3, 1, 8, 8, 6, Shape::quad4},
    {"hex20", 3, 2, 20, 8, 6, Shape::quad8},
}};

const Facts& facts(Shape shape) {
  return k_facts[static_cast<std::size_t>(shape)];
}

// Faces with their nodes in the order of the face's own shape, counter-clockwise seen from outside.
constexpr std::array<int, 2> k_line{0, 1};
constexpr std::array<int, 9> k_tri{0, 1, 3, 1, 2, 4, 2, 0, 5};
constexpr std::array<int, 12> k_quad{0, 1, 4, 1, 2, 5, 2, 3, 6, 3, 0, 7};
constexpr std::array<int, 24> k_tet{0, 2, 1, 6, 5, 4, 0, 1, 3, 4, 9, 7, 0, 3, 2, 7, 8, 6, 1, 2, 3, 5, 8, 9};
constexpr std::array<int, 48> k_hex{0, 3, 2, 1, 9,  13, 11, 8,  0, 1, 5, 4, 8,  12, 16, 10,
                                    0, 4, 7, 3, 10, 17, 15, 9,  1, 2, 6, 5, 11, 14, 18, 12,
                                    2, 3, 7, 6, 13, 15, 19, 14, 4, 5, 6, 7, 16, 18, 19, 17};

// Vertices of the reference quad and hex, and the edges that carry the mid nodes of a hex.
constexpr std::array<std::array<int, 3>, 8> k_corner{
    {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}};
constexpr std::array<std::pair<int, int>, 12> k_hex_edge{
    {{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 5}, {2, 3}, {2, 6}, {3, 7}, {4, 5}, {4, 7}, {5, 6}, {6, 7}}};
constexpr std::array<std::pair<int, int>, 4> k_quad_edge{{{0, 1}, {1, 2}, {2, 3}, {3, 0}}};
constexpr std::array<std::pair<int, int>, 3> k_tri_edge{{{0, 1}, {1, 2}, {2, 0}}};
constexpr std::array<std::pair<int, int>, 6> k_tet_edge{{{0, 1}, {1, 2}, {2, 0}, {3, 0}, {3, 2}, {3, 1}}};

// Barycentric coordinates of a simplex: λ_0 = 1 − Σξ, λ_i = ξ_i.
std::array<double, 4> barycentric(int dim, const Point& xi) {
  std::array<double, 4> l{1, 0, 0, 0};
  for (std::size_t i = 0; i < static_cast<std::size_t>(dim); ++i) {
    l[i + 1] = xi[i];
    l[0] -= xi[i];
  }
  return l;
}
double barycentric_gradient(int a, int i) {
  return a == 0 ? -1.0 : (a == i + 1 ? 1.0 : 0.0);
}

template <std::size_t n_edges>
void simplex_values(int dim, int order, const std::array<std::pair<int, int>, n_edges>& edges,
                    const Point& xi, std::span<double> v) {
  const auto l = barycentric(dim, xi);
  const auto n = static_cast<std::size_t>(dim) + 1;
  for (std::size_t a = 0; a < n; ++a) v[a] = order == 1 ? l[a] : l[a] * (2 * l[a] - 1);
  if (order == 2)
    for (std::size_t e = 0; e < n_edges; ++e)
      v[n + e] =
          4 * l[static_cast<std::size_t>(edges[e].first)] * l[static_cast<std::size_t>(edges[e].second)];
}

template <std::size_t n_edges>
void simplex_gradients(int dim, int order, const std::array<std::pair<int, int>, n_edges>& edges,
                       const Point& xi, std::span<double> g) {
  const auto l = barycentric(dim, xi);
  const auto d = static_cast<std::size_t>(dim);
  const std::size_t n = d + 1;
  for (std::size_t i = 0; i < d; ++i) {
    const int direction = static_cast<int>(i);
    for (std::size_t a = 0; a < n; ++a)
      g[a * d + i] = barycentric_gradient(static_cast<int>(a), direction) * (order == 1 ? 1.0 : 4 * l[a] - 1);
    if (order == 2)
      for (std::size_t e = 0; e < n_edges; ++e) {
        const auto [p, q] = edges[e];
        g[(n + e) * d + i] = 4 * (barycentric_gradient(p, direction) * l[static_cast<std::size_t>(q)] +
                                  l[static_cast<std::size_t>(p)] * barycentric_gradient(q, direction));
      }
  }
}

// Tensor-product and serendipity shapes. A node of the reference cube has coordinates c ∈ {−1, 0, 1}; N is
// the product of its one-dimensional factors and, for vertices of the serendipity shapes, of (Σ c ξ − (d −
// 1)).
struct CubeNode {
  std::array<int, 3> c{};
};

template <std::size_t n_edges>
CubeNode cube_node(int dim, int a, const std::array<std::pair<int, int>, n_edges>& edges) {
  const int vertices = 1 << dim;
  if (a < vertices) return {k_corner[static_cast<std::size_t>(a)]};
  const auto [p, q] = edges[static_cast<std::size_t>(a - vertices)];
  CubeNode n;
  for (std::size_t i = 0; i < 3; ++i)
    n.c[i] = (k_corner[static_cast<std::size_t>(p)][i] + k_corner[static_cast<std::size_t>(q)][i]) / 2;
  return n;
}

double factor(int c, double x) {
  return c == 0 ? 1 - x * x : 0.5 * (1 + c * x);
}
double factor_slope(int c, double x) {
  return c == 0 ? -2 * x : 0.5 * c;
}

template <std::size_t n_edges>
void cube_values(int dim, int order, int n_nodes, const std::array<std::pair<int, int>, n_edges>& edges,
                 const Point& xi, std::span<double> v) {
  for (int a = 0; a < n_nodes; ++a) {
    const CubeNode node = cube_node(dim, a, edges);
    double value = 1, sum = 1.0 - dim;
    bool vertex = true;
    for (std::size_t i = 0; i < static_cast<std::size_t>(dim); ++i) {
      value *= factor(node.c[i], xi[i]);
      sum += node.c[i] * xi[i];
      vertex = vertex && node.c[i] != 0;
    }
    v[static_cast<std::size_t>(a)] = order == 2 && vertex ? value * sum : value;
  }
}

template <std::size_t n_edges>
void cube_gradients(int dim, int order, int n_nodes, const std::array<std::pair<int, int>, n_edges>& edges,
                    const Point& xi, std::span<double> g) {
  const auto d = static_cast<std::size_t>(dim);
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
      g[static_cast<std::size_t>(a) * d + i] = order == 2 && vertex ? slope * sum + value * node.c[i] : slope;
    }
  }
}

}  // namespace

int node_count(Shape shape) {
  return facts(shape).nodes;
}
int vertex_count(Shape shape) {
  return facts(shape).vertices;
}
int dimension(Shape shape) {
  return facts(shape).dimension;
}
int order(Shape shape) {
  return facts(shape).order;
}
std::string_view name(Shape shape) {
  return facts(shape).name;
}
int face_count(Shape shape) {
  return facts(shape).faces;
}
Shape face_shape(Shape shape) {
  return facts(shape).face;
}

std::span<const int> face_nodes(Shape shape, int face) {
  assert(face >= 0 && face < face_count(shape));
  const auto f = static_cast<std::size_t>(face);
  switch (shape) {
    case Shape::line2:
    case Shape::line3:
      return std::span(k_line).subspan(f, 1);
    case Shape::tri3:
      return std::span(k_tri).subspan(3 * f, 2);
    case Shape::tri6:
      return std::span(k_tri).subspan(3 * f, 3);
    case Shape::quad4:
      return std::span(k_quad).subspan(3 * f, 2);
    case Shape::quad8:
      return std::span(k_quad).subspan(3 * f, 3);
    case Shape::tet4:
      return std::span(k_tet).subspan(6 * f, 3);
    case Shape::tet10:
      return std::span(k_tet).subspan(6 * f, 6);
    case Shape::hex8:
      return std::span(k_hex).subspan(8 * f, 4);
    case Shape::hex20:
      return std::span(k_hex).subspan(8 * f, 8);
    case Shape::point1:
      break;
  }
  return {};
}

void basis_values(Shape shape, const Point& xi, std::span<double> v) {
  assert(static_cast<int>(v.size()) >= node_count(shape));
  constexpr std::array<std::pair<int, int>, 0> no_edges{};
  switch (shape) {
    case Shape::point1:
      v[0] = 1;
      return;
    case Shape::line2:
      v[0] = 0.5 * (1 - xi[0]);
      v[1] = 0.5 * (1 + xi[0]);
      return;
    case Shape::line3:
      v[0] = 0.5 * xi[0] * (xi[0] - 1);
      v[1] = 0.5 * xi[0] * (xi[0] + 1);
      v[2] = 1 - xi[0] * xi[0];
      return;
    case Shape::tri3:
      return simplex_values(2, 1, no_edges, xi, v);
    case Shape::tri6:
      return simplex_values(2, 2, k_tri_edge, xi, v);
    case Shape::tet4:
      return simplex_values(3, 1, no_edges, xi, v);
    case Shape::tet10:
      return simplex_values(3, 2, k_tet_edge, xi, v);
    case Shape::quad4:
      return cube_values(2, 1, 4, no_edges, xi, v);
    case Shape::quad8:
      return cube_values(2, 2, 8, k_quad_edge, xi, v);
    case Shape::hex8:
      return cube_values(3, 1, 8, no_edges, xi, v);
    case Shape::hex20:
      return cube_values(3, 2, 20, k_hex_edge, xi, v);
  }
}

void basis_gradients(Shape shape, const Point& xi, std::span<double> g) {
  assert(static_cast<int>(g.size()) >= node_count(shape) * dimension(shape));
  constexpr std::array<std::pair<int, int>, 0> no_edges{};
  switch (shape) {
    case Shape::point1:
      return;
    case Shape::line2:
      g[0] = -0.5;
      g[1] = 0.5;
      return;
    case Shape::line3:
      g[0] = xi[0] - 0.5;
      g[1] = xi[0] + 0.5;
      g[2] = -2 * xi[0];
      return;
    case Shape::tri3:
      return simplex_gradients(2, 1, no_edges, xi, g);
    case Shape::tri6:
      return simplex_gradients(2, 2, k_tri_edge, xi, g);
    case Shape::tet4:
      return simplex_gradients(3, 1, no_edges, xi, g);
    case Shape::tet10:
      return simplex_gradients(3, 2, k_tet_edge, xi, g);
    case Shape::quad4:
      return cube_gradients(2, 1, 4, no_edges, xi, g);
    case Shape::quad8:
      return cube_gradients(2, 2, 8, k_quad_edge, xi, g);
    case Shape::hex8:
      return cube_gradients(3, 1, 8, no_edges, xi, g);
    case Shape::hex20:
      return cube_gradients(3, 2, 20, k_hex_edge, xi, g);
  }
}

}  // namespace solidus::mesh
