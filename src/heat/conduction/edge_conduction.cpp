/// The factor of an element comes from the singular functions of its wedge, by their means over the faces
/// opposite to its nodes.
#include "heat/conduction/edge_conduction.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"

namespace solidus::heat {

namespace {

using mesh::Point;

constexpr std::size_t k_nodes = 4;  ///< at most

Point difference(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
double product(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Point normal_to(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Point scaled(double s, const Point& a) {
  return {s * a[0], s * a[1], s * a[2]};
}
Point direction(const Point& a) {
  const double length = std::sqrt(product(a, a));
  return length > 0 ? scaled(1 / length, a) : a;
}

/// r^α cos αφ and r^α sin αφ around an edge.
class SingularFunctions {
 public:
  SingularFunctions(const Point& at, const mesh::Wedge& wedge)
      : at_(at),
        bisector_(wedge.bisector),
        beside_(normal_to(wedge.tangent, wedge.bisector)),
        half_(wedge.angle / 2),
        alpha_(std::acos(-1.0) / wedge.angle) {}
  std::array<double, 2> operator()(const Point& x) const {
    const Point from = difference(x, at_);
    const double u = product(from, bisector_), v = product(from, beside_);
    const double r = std::hypot(u, v);
    if (r == 0) return {0, 0};
    const double phi = std::clamp(std::atan2(v, u), -half_, half_);
    const double power = std::pow(r, alpha_);
    return {power * std::cos(alpha_ * phi), power * std::sin(alpha_ * phi)};
  }

 private:
  Point at_, bisector_, beside_;
  double half_, alpha_;
};

/// A linear triangle or tetrahedron.
struct Simplex {
  std::size_t n = 0;  ///< vertices
  std::array<Point, k_nodes> x{};
  /// The outward vector areas of the faces opposite to the vertices: −(n − 1) V ∇N_a.
  std::array<Point, k_nodes> area{};

  Simplex(const mesh::Mesh& mesh, std::span<const Index> nodes) : n(nodes.size()) {
    for (std::size_t a = 0; a < n; ++a) x[a] = mesh.x[as_size(nodes[a])];
    for (std::size_t a = 0; a < n; ++a) {
      const Point& p = x[(a + 1) % n];
      const Point first = difference(x[(a + 2) % n], p);
      area[a] = n == 3 ? Point{first[1], -first[0], 0}
                       : scaled(0.5, normal_to(first, difference(x[(a + 3) % n], p)));
      if (product(area[a], difference(x[a], p)) > 0) area[a] = scaled(-1, area[a]);
    }
  }
};

/// The mean of both functions over the face opposite to vertex `a`, by its parts of equal size: enough for
/// powers r^α, and exact for linear functions.
std::array<double, 2> mean_over_face(const Simplex& s, std::size_t a, const SingularFunctions& functions) {
  // The face is a segment or a triangle with the corner p and the sides `first` and `second`.
  const Point& p = s.x[(a + 1) % s.n];
  const Point first = difference(s.x[(a + 2) % s.n], p);
  std::array<double, 2> sum{};
  int n_parts = 0;
  const auto add = [&](double xi, double eta, const Point& second) {
    Point x = p;
    for (std::size_t i = 0; i < 3; ++i) x[i] += xi * first[i] + eta * second[i];
    const std::array<double, 2> value = functions(x);
    for (std::size_t k = 0; k < 2; ++k) sum[k] += value[k];
    ++n_parts;
  };
  // Midpoints of equal parts; triangles are cut into small ones that point up (1/3) and down (2/3).
  constexpr int k_parts_of_line = 24, k_parts_of_side = 8;
  if (s.n == 3) {
    for (int i = 0; i < k_parts_of_line; ++i) add((i + 0.5) / k_parts_of_line, 0, first);
  } else {
    const Point second = difference(s.x[(a + 3) % s.n], p);
    constexpr double k_side = 1.0 / k_parts_of_side;
    for (int i = 0; i < k_parts_of_side; ++i)
      for (int j = 0; i + j < k_parts_of_side; ++j) {
        add((i + 1.0 / 3) * k_side, (j + 1.0 / 3) * k_side, second);
        if (i + j + 1 < k_parts_of_side) add((i + 2.0 / 3) * k_side, (j + 2.0 / 3) * k_side, second);
      }
  }
  for (double& value : sum) value /= n_parts;
  return sum;
}

/// c of the element for the functions around one edge.
/// @param on_edge  by bits, vertices that lie on it
double factor_of(const Simplex& s, const SingularFunctions& functions, unsigned on_edge) {
  std::array<Point, 2> gradient{}, interpolated{};  // times V (n − 1)
  for (std::size_t a = 0; a < s.n; ++a) {
    const std::array<double, 2> mean = mean_over_face(s, a, functions);
    const std::array<double, 2> value =
        (on_edge >> a & 1U) != 0 ? std::array<double, 2>{0, 0} : functions(s.x[a]);
    for (std::size_t k = 0; k < 2; ++k)
      for (std::size_t i = 0; i < 3; ++i) {
        gradient[k][i] += static_cast<double>(s.n - 1) * mean[k] * s.area[a][i];
        interpolated[k][i] -= value[k] * s.area[a][i];
      }
  }
  const double exact = product(gradient[0], interpolated[0]) + product(gradient[1], interpolated[1]);
  const double own = product(interpolated[0], interpolated[0]) + product(interpolated[1], interpolated[1]);
  // Elements whose edge is not as straight as the functions have it may have values outside of this.
  constexpr double k_least = 0.1, k_greatest = 1.25;
  return own > 0 ? std::clamp(exact / own, k_least, k_greatest) : 1.0;
}

/// Whether the edge goes from one node to the other: both have its direction, within 30 degrees.
bool along_edge(const Point& between, const mesh::Wedge& a, const mesh::Wedge& b) {
  constexpr double k_straight = 0.866;
  return std::abs(product(between, a.tangent)) > k_straight &&
         std::abs(product(between, b.tangent)) > k_straight && product(a.bisector, b.bisector) > 0;
}

}  // namespace

EdgeConduction::EdgeConduction(const mesh::Mesh& mesh) {
  // Linear triangles and tetrahedra alone are corrected, and only if the mesh has a re-entrant edge
  // somewhere.
  const bool simplices = std::any_of(mesh.blocks.begin(), mesh.blocks.end(), [](const auto& block) {
    return block.shape == mesh::Shape::tri3 || block.shape == mesh::Shape::tet4;
  });
  if (!parallel::any_process(simplices)) return;
  const auto owned = mesh::reentrant_wedges(mesh);
  if (!parallel::any_process(!owned.empty())) return;
  // The wedge of a node is known to its owner: its bisector, the direction of the edge and the angle go to
  // the ghosts as seven numbers.
  constexpr int k_numbers = 7;
  std::vector<double> all(mesh.x.size() * k_numbers, 0.0);
  for (const auto& [node, wedge] : owned) {
    double* to = all.data() + static_cast<std::ptrdiff_t>(node) * k_numbers;
    std::copy(wedge.bisector.begin(), wedge.bisector.end(), to);
    std::copy(wedge.tangent.begin(), wedge.tangent.end(), to + 3);
    to[6] = wedge.angle;
  }
  parallel::GhostExchange(mesh).update(all, k_numbers);
  for (std::size_t i = 0; i < mesh.x.size(); ++i) {
    const double* from = all.data() + i * k_numbers;
    if (from[6] > 0)
      wedges_[as_index(i)] = {{from[0], from[1], from[2]}, {from[3], from[4], from[5]}, from[6]};
  }
}

const mesh::Wedge* EdgeConduction::wedge(Index node) const {
  const auto found = wedges_.find(node);
  return found == wedges_.end() ? nullptr : &found->second;
}

std::optional<EdgeLoss> EdgeConduction::loss(const mesh::Mesh& mesh, mesh::Shape shape,
                                             const Index* nodes) const {
  if (wedges_.empty() || (shape != mesh::Shape::tri3 && shape != mesh::Shape::tet4)) return {};
  // Which nodes of the element lie on re-entrant edges.
  const auto n = as_size(mesh::node_count(shape));
  std::array<const mesh::Wedge*, k_nodes> wedges{};
  bool any = false;
  for (std::size_t a = 0; a < n; ++a) any = (wedges[a] = wedge(nodes[a])) != nullptr || any;
  if (!any) return {};
  const Simplex s(mesh, {nodes, n});
  // The loss is that of a matrix (1 − c)(1 − t ⊗ t): conduction along the edge t is not reduced.
  EdgeLoss mean{};
  int n_edges = 0;
  const auto add = [&](double c, const Point& t) {
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) mean[i][j] += (1 - c) * ((i == j ? 1.0 : 0.0) - t[i] * t[j]);
    ++n_edges;
  };
  // A side along an edge has the solution of the wedge between both nodes.
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = a + 1; b < n; ++b) {
      if (wedges[a] == nullptr || wedges[b] == nullptr) continue;
      const Point between = direction(difference(s.x[b], s.x[a]));
      if (!along_edge(between, *wedges[a], *wedges[b])) continue;
      Point bisector = wedges[a]->bisector;
      for (std::size_t i = 0; i < 3; ++i) bisector[i] += wedges[b]->bisector[i];
      bisector = direction(difference(bisector, scaled(product(bisector, between), between)));
      const mesh::Wedge joined{bisector, between, (wedges[a]->angle + wedges[b]->angle) / 2};
      add(factor_of(s, {s.x[a], joined}, 1U << a | 1U << b), between);
    }
  // Else the element touches the edge with single nodes.
  const bool with_a_side = n_edges > 0;
  for (std::size_t a = 0; a < n && !with_a_side; ++a)
    if (wedges[a] != nullptr) add(factor_of(s, {s.x[a], *wedges[a]}, 1U << a), wedges[a]->tangent);
  // Of several edges the mean.
  for (auto& row : mean)
    for (double& value : row) value /= n_edges;
  return mean;
}

}  // namespace solidus::heat
