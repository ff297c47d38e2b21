#include "mesh/locate.hpp"

#include <petscsys.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include "mesh/block_geometry.hpp"

namespace solidus::mesh {

namespace {

struct Candidate {
  double distance = std::numeric_limits<double>::infinity();
  int body = std::numeric_limits<int>::max();
  std::vector<Index> nodes;
  std::vector<double> values;
};

double distance_to_box(const Mesh& mesh, const Index* element, int n, const Point& x) {
  double square = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (int a = 0; a < n; ++a) {
      low = std::min(low, mesh.x[static_cast<std::size_t>(element[a])][i]);
      high = std::max(high, mesh.x[static_cast<std::size_t>(element[a])][i]);
    }
    const double d = std::max({low - x[i], x[i] - high, 0.0});
    square += d * d;
  }
  return std::sqrt(square);
}

// Back into the reference shape.
void clamp(Shape shape, Point& xi) {
  const auto dim = static_cast<std::size_t>(dimension(shape));
  const bool simplex = vertex_count(shape) == static_cast<int>(dim) + 1;
  if (!simplex) {
    for (std::size_t i = 0; i < dim; ++i) xi[i] = std::clamp(xi[i], -1.0, 1.0);
    return;
  }
  double sum = 0;
  for (std::size_t i = 0; i < dim; ++i) {
    xi[i] = std::max(xi[i], 0.0);
    sum += xi[i];
  }
  if (sum > 1)
    for (std::size_t i = 0; i < dim; ++i) xi[i] /= sum;
}

// Solves the normal equations of ∂x/∂ξ dξ = r for up to three unknowns by Cramer's rule.
Point solve(const std::array<std::array<double, 3>, 3>& j, const Point& r, std::size_t dim) {
  std::array<std::array<double, 3>, 3> a{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  Point b{};
  for (std::size_t p = 0; p < dim; ++p) {
    for (std::size_t q = 0; q < dim; ++q) {
      a[p][q] = 0;
      for (std::size_t i = 0; i < 3; ++i) a[p][q] += j[i][p] * j[i][q];
    }
    for (std::size_t i = 0; i < 3; ++i) b[p] += j[i][p] * r[i];
  }
  const auto det = [](const std::array<std::array<double, 3>, 3>& m) {
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  };
  const double d = det(a);
  Point x{};
  for (std::size_t p = 0; p < dim; ++p) {
    auto c = a;
    for (std::size_t i = 0; i < 3; ++i) c[i][p] = b[i];
    x[p] = det(c) / d;
  }
  return x;
}

// Inverse map by Newton's method, kept within the shape; returns the distance that remains.
double invert(const Mesh& mesh, Shape shape, const Index* element, const Point& x,
              std::vector<double>& values) {
  const auto nn = static_cast<std::size_t>(node_count(shape)),
             dim = static_cast<std::size_t>(dimension(shape));
  values.resize(nn);
  std::vector<double> gradients(nn * dim);
  Point xi{};
  if (vertex_count(shape) == static_cast<int>(dim) + 1) xi = {0.25, 0.25, dim == 3 ? 0.25 : 0.0};
  double distance = 0;
  for (int iteration = 0; iteration < 30; ++iteration) {
    basis_values(shape, xi, values);
    basis_gradients(shape, xi, gradients);
    Point r = x;
    std::array<std::array<double, 3>, 3> j{};
    for (std::size_t a = 0; a < nn; ++a)
      for (std::size_t i = 0; i < 3; ++i) {
        const double c = mesh.x[static_cast<std::size_t>(element[a])][i];
        r[i] -= values[a] * c;
        for (std::size_t k = 0; k < dim; ++k) j[i][k] += c * gradients[a * dim + k];
      }
    distance = std::hypot(r[0], r[1], r[2]);
    const Point step = solve(j, r, dim);
    Point next = xi;
    double moved = 0;
    for (std::size_t k = 0; k < dim; ++k) next[k] += step[k];
    clamp(shape, next);
    for (std::size_t k = 0; k < dim; ++k) moved = std::max(moved, std::abs(next[k] - xi[k]));
    xi = next;
    if (moved < 1e-13) break;
  }
  basis_values(shape, xi, values);
  return distance;
}

}  // namespace

LocatedPoint locate(const Mesh& mesh, const Point& x, int body) {
  double extent = 0;
  for (const Point& p : mesh.x) extent = std::max({extent, std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
  const double zero = 1e-9 * extent;

  Candidate best;
  std::vector<double> values;
  for (const Block& block : mesh.blocks) {
    if (body >= 0 && block.body != body) continue;
    const int nn = node_count(block.shape);
    for (Index e = 0; e < block.n_counted; ++e) {
      const Index* element = block.element(e);
      // curved edges may bulge out of the box of the nodes, by less than its size; the nearest elements are
      // looked at first anyway
      if (distance_to_box(mesh, element, nn, x) > best.distance + zero) continue;
      double distance = invert(mesh, block.shape, element, x, values);
      if (distance < zero) distance = 0;
      if (distance < best.distance || (distance == best.distance && block.body < best.body))
        best = {distance, block.body, std::vector<Index>(element, element + nn), values};
    }
  }

  // The nearest, then the lowest body, then the lowest process.
  int rank = 0;
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  struct {
    double value;
    int process;
  } mine{best.distance, rank}, winner{};
  double nearest = 0;
  MPI_Allreduce(&best.distance, &nearest, 1, MPI_DOUBLE, MPI_MIN, PETSC_COMM_WORLD);
  mine.value = best.distance == nearest ? best.body : std::numeric_limits<double>::max();
  MPI_Allreduce(&mine, &winner, 1, MPI_DOUBLE_INT, MPI_MINLOC, PETSC_COMM_WORLD);

  LocatedPoint found;
  found.distance = nearest;
  if (winner.process == rank && std::isfinite(nearest))
    found.interpolation = {std::move(best.nodes), std::move(best.values)};
  return found;
}

NodalWeights mean_over(const Mesh& mesh, AnalysisKind kind, const std::string& group) {
  std::map<Index, double> weights;
  double total = 0;
  if (const auto surface = mesh.surfaces.find(group); surface != mesh.surfaces.end()) {
    for (const Block& faces : surface->second.faces) {
      const FaceGeometry g(mesh, faces, kind, gauss_rule(faces.shape, 4));
      for (Index f = 0; f < g.n_counted; ++f)
        for (int p = 0; p < g.n_points; ++p) {
          const double w = g.weight[static_cast<std::size_t>(f) * static_cast<std::size_t>(g.n_points) +
                                    static_cast<std::size_t>(p)];
          total += w;
          for (int a = 0; a < g.n_nodes; ++a)
            weights[faces.element(f)[a]] += w * g.values[static_cast<std::size_t>(p * g.n_nodes + a)];
        }
    }
  } else {
    bool is_body = false;
    for (const Block& block : mesh.blocks) {
      if (mesh.bodies[static_cast<std::size_t>(block.body)].name != group) continue;
      is_body = true;
      const BlockGeometry g(mesh, block, kind, gauss_rule(block.shape, 4));
      for (Index e = 0; e < g.n_counted; ++e)
        for (int p = 0; p < g.n_points; ++p) {
          const double w = g.weight_at(e / k_lanes, p)[e % k_lanes];
          total += w;
          for (int a = 0; a < g.n_nodes; ++a)
            weights[block.element(e)[a]] += w * g.values[static_cast<std::size_t>(p * g.n_nodes + a)];
        }
    }
    if (!is_body) throw std::out_of_range("'" + group + "' is neither a surface nor a body of the mesh");
  }
  MPI_Allreduce(MPI_IN_PLACE, &total, 1, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
  NodalWeights result;
  for (const auto& [node, w] : weights) {
    result.nodes.push_back(node);
    result.weights.push_back(w / total);
  }
  return result;
}

}  // namespace solidus::mesh
