/// Newton's method for the distance in reference coordinates, with descent where it fails, inside the
/// element and on each of its faces.
#include "mesh/nearest_place.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "numbers/index_casts.hpp"

namespace solidus::mesh {

namespace {

// Inside up to this much of the reference shape: points on edges count for every element that has the edge.
constexpr double k_inside = 1e-9;

bool inside(Shape shape, const Point& xi) {
  const int dim = dimension(shape);
  const bool simplex = dim > 1 && vertex_count(shape) == dim + 1;
  double sum = 0;
  for (std::size_t i = 0; i < as_size(dim); ++i) {
    sum += xi[i];
    if (simplex ? xi[i] < -k_inside : std::abs(xi[i]) > 1 + k_inside) return false;
  }
  return !simplex || sum <= 1 + k_inside;
}

Point centre(Shape shape) {
  const int dim = dimension(shape);
  const bool simplex = dim > 1 && vertex_count(shape) == dim + 1;
  const double c = simplex ? 1.0 / (dim + 1) : 0.0;
  return {dim > 0 ? c : 0, dim > 1 ? c : 0, dim > 2 ? c : 0};
}

// Solves the symmetric positive system a y = b of up to three unknowns by elimination; false if singular.
bool solve(std::array<std::array<double, 3>, 3> a, Point b, std::size_t n, Point& y) {
  for (std::size_t k = 0; k < n; ++k) {
    if (!(a[k][k] > 0)) return false;
    for (std::size_t i = k + 1; i < n; ++i) {
      const double f = a[i][k] / a[k][k];
      for (std::size_t j = k; j < n; ++j) a[i][j] -= f * a[k][j];
      b[i] -= f * b[k];
    }
  }
  y = {};
  for (std::size_t k = n; k-- > 0;) {
    y[k] = b[k];
    for (std::size_t j = k + 1; j < n; ++j) y[k] -= a[k][j] * y[j];
    y[k] /= a[k][k];
  }
  return true;
}

class Search {
 public:
  Search(const Mesh& mesh, const Point& target) : mesh_(mesh), target_(target) {}

  // The place of the element nearest to the target: in its interior, or, where that has no stationary point,
  // on one of its faces, and so on down to the vertices.
  NearestPlace element(Shape shape, const Index* nodes) {
    std::vector<int> all(as_size(node_count(shape)));
    for (std::size_t a = 0; a < all.size(); ++a) all[a] = static_cast<int>(a);
    NearestPlace best;
    descend(shape, nodes, all, best);
    return best;
  }

 private:
  // Gauss–Newton on |x(ξ) − target|².
  bool stationary(Shape shape, const Index* nodes, const std::vector<int>& local, Point& xi,
                  double& distance) {
    const auto dim = as_size(dimension(shape));
    std::array<double, 20> value{};
    std::array<double, 60> slope{};
    xi = centre(shape);
    for (int iteration = 0;; ++iteration) {
      // The distance and the tangents at the present place.
      basis_values(shape, xi, value);
      basis_gradients(shape, xi, slope);
      Point r = target_;
      std::array<Point, 3> tangent{};
      for (std::size_t a = 0; a < local.size(); ++a) {
        const Point& x = mesh_.x[as_size(nodes[local[a]])];
        for (std::size_t i = 0; i < 3; ++i) {
          r[i] -= value[a] * x[i];
          for (std::size_t k = 0; k < dim; ++k) tangent[k][i] += slope[a * dim + k] * x[i];
        }
      }
      distance = std::hypot(r[0], r[1], r[2]);
      // The normal equations of the step; steps are at most two long, since reference elements are.
      std::array<std::array<double, 3>, 3> metric{};
      Point rhs{}, step{};
      for (std::size_t k = 0; k < dim; ++k) {
        for (std::size_t i = 0; i < 3; ++i) rhs[k] += tangent[k][i] * r[i];
        for (std::size_t l = 0; l < dim; ++l)
          for (std::size_t i = 0; i < 3; ++i) metric[k][l] += tangent[k][i] * tangent[l][i];
      }
      if (!solve(metric, rhs, dim, step)) return false;
      double size = 0;
      for (std::size_t k = 0; k < dim; ++k) size = std::max(size, std::abs(step[k]));
      if (size < 1e-12) return true;
      if (iteration == 50 || !(size < 1e3)) return false;
      for (std::size_t k = 0; k < dim; ++k) xi[k] += step[k] * std::min(1.0, 2.0 / size);
    }
  }

  void descend(Shape shape, const Index* nodes, const std::vector<int>& local, NearestPlace& best) {
    Point xi{};
    double distance = 0;
    if (dimension(shape) == 0) {
      const Point& x = mesh_.x[as_size(nodes[local[0]])];
      distance = std::hypot(x[0] - target_[0], x[1] - target_[1], x[2] - target_[2]);
      if (distance < best.distance) best = {distance, shape, local, xi};
      return;
    }
    if (stationary(shape, nodes, local, xi, distance) && inside(shape, xi)) {
      // An interior stationary point of full dimension is the target itself.
      if (dimension(shape) == mesh_.dimension) distance = 0;
      if (distance < best.distance) best = {distance, shape, local, xi};
      return;
    }
    // Outside of the shape the nearest place is on its boundary: each face is searched in the same
    // way.
    for (int f = 0; f < face_count(shape); ++f) {
      std::vector<int> face;
      for (const int a : face_nodes(shape, f)) face.push_back(local[as_size(a)]);
      descend(face_shape(shape), nodes, face, best);
    }
  }

  const Mesh& mesh_;
  Point target_;
};

}  // namespace

NearestPlace nearest_place(const Mesh& mesh, Shape shape, const Index* nodes, const Point& point) {
  return Search(mesh, point).element(shape, nodes);
}

Box element_box(const Mesh& mesh, const ElementBlock& block, Index e) {
  const Index* nodes = block.element(e);
  Box box;
  for (std::size_t i = 0; i < 3; ++i) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (int a = 0; a < node_count(block.shape); ++a) {
      const double c = mesh.x[as_size(nodes[a])][i];
      low = std::min(low, c);
      high = std::max(high, c);
    }
    const double margin = (order(block.shape) == 2 ? 0.25 : 1e-6) * (high - low);
    box.low[i] = low - margin;
    box.high[i] = high + margin;
  }
  return box;
}

double distance_to_box(const Box& box, const Point& p) {
  double squared = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double outside = std::max({box.low[i] - p[i], p[i] - box.high[i], 0.0});
    squared += outside * outside;
  }
  return std::sqrt(squared);
}

}  // namespace solidus::mesh
