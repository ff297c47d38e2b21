/// Shapes of cells in reference coordinates, for their division (cell_division.hpp).
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <tuple>
#include <utility>

#include "heat/loads/cell_integrals.hpp"
#include "mesh/quadrature.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::heat {

using mesh::Point;
using mesh::Shape;

constexpr int k_most_nodes = 20;
constexpr std::size_t k_values = std::tuple_size_v<LoadValues>;

inline bool is_box(Shape shape) {
  return shape != Shape::tri3 && shape != Shape::tri6 && shape != Shape::tet4 && shape != Shape::tet10;
}

/// W_a at a reference point.
inline void shares_at(Shape shape, const Point& xi, std::span<double> w) {
  mesh::basis_values(shape, xi, w);
  if (mesh::order(shape) == 1) return;
  double sum = 0;
  for (double& v : w) sum += v *= v;
  for (double& v : w) v /= sum;
}

/// Where a reference point lies, and the volume or area there per unit of the reference shape.
inline std::pair<Position, double> map(const mesh::Mesh& mesh, AnalysisKind kind, Shape shape,
                                       const Index* nodes, const Point& xi) {
  const auto n = as_size(mesh::node_count(shape)), dim = as_size(mesh::dimension(shape));
  std::array<double, k_most_nodes> values{};
  std::array<double, 3 * k_most_nodes> gradients{};
  mesh::basis_values(shape, xi, std::span(values).first(n));
  mesh::basis_gradients(shape, xi, std::span(gradients).first(n * dim));
  Position x{};
  std::array<Point, 3> tangent{Point{1, 0, 0}, Point{0, 1, 0}, Point{0, 0, 1}};
  for (std::size_t j = 0; j < dim; ++j) tangent[j] = {};
  for (std::size_t a = 0; a < n; ++a) {
    const Point& node = mesh.x[as_size(nodes[a])];
    for (std::size_t i = 0; i < 3; ++i) {
      x[i] += values[a] * node[i];
      for (std::size_t j = 0; j < dim; ++j) tangent[j][i] += gradients[a * dim + j] * node[i];
    }
  }
  const Point &s = tangent[0], &t = tangent[1], &u = tangent[2];
  const Point cross{s[1] * t[2] - s[2] * t[1], s[2] * t[0] - s[0] * t[2], s[0] * t[1] - s[1] * t[0]};
  double size = 0;
  if (dim == 3)
    size = std::abs(cross[0] * u[0] + cross[1] * u[1] + cross[2] * u[2]);
  else
    size = dim == 2 ? std::hypot(cross[0], cross[1], cross[2]) : std::hypot(s[0], s[1], s[2]);
  if (kind == AnalysisKind::axisymmetric) size *= 2 * std::numbers::pi * x[0];
  return {x, size};
}

inline Point half_way(const Point& a, const Point& b) {
  return {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2])};
}

}  // namespace solidus::heat
