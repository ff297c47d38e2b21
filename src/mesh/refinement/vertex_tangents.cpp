/// Corners of faces around a vertex are joined across smooth edges; each union has one normal.
#include "mesh/refinement/vertex_tangents.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>
#include <unordered_map>

#include "mesh/raw_mesh.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mesh {

namespace {

Point minus(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
std::optional<Point> unit(const Point& a) {
  const double length = std::sqrt(dot(a, a));
  if (!(length > 0)) return std::nullopt;
  return Point{a[0] / length, a[1] / length, a[2] / length};
}

/// Solves five symmetric equations; false where they have no one solution.
bool solve(std::array<std::array<double, 5>, 5>& matrix, std::array<double, 5>& right) {
  // Cholesky's factors of a matrix of few rows, in place.
  for (std::size_t j = 0; j < 5; ++j) {
    for (std::size_t i = j; i < 5; ++i) {
      double sum = matrix[i][j];
      for (std::size_t k = 0; k < j; ++k) sum -= matrix[i][k] * matrix[j][k];
      if (i == j) {
        if (!(sum > 0)) return false;
        matrix[j][j] = std::sqrt(sum);
      } else {
        matrix[i][j] = sum / matrix[j][j];
      }
    }
  }
  for (std::size_t i = 0; i < 5; ++i) {
    for (std::size_t k = 0; k < i; ++k) right[i] -= matrix[i][k] * right[k];
    right[i] /= matrix[i][i];
  }
  for (std::size_t i = 5; i-- > 0;) {
    for (std::size_t k = i + 1; k < 5; ++k) right[i] -= matrix[k][i] * right[k];
    right[i] /= matrix[i][i];
  }
  return true;
}

/// The unit normal, at a vertex, of the quadric h = s·d + ½ d·C d over the plane of a first normal that comes
/// closest to the points around. Where these do not tell a slope from a curvature, as on one row of faces
/// between two edges, it is taken for a slope: the surface is then straight across the row.
/// @param points  from the vertex on [m]
Point normal_of_quadric(const Point& first, const std::vector<Point>& points) {
  // Axes in the plane: the first one is as far from the normal as a coordinate axis can be.
  std::size_t axis = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (std::abs(first[i]) < std::abs(first[axis])) axis = i;
  Point e1{};
  e1[axis] = 1;
  for (std::size_t i = 0; i < 3; ++i) e1[i] -= first[axis] * first[i];
  e1 = unit(e1).value_or(Point{});
  const Point e2 = cross(first, e1);
  double square = 0;
  for (const Point& d : points) square += dot(d, d) / static_cast<double>(points.size());
  if (!(square > 0)) return first;
  const double length = std::sqrt(square);
  // Least squares of slopes and curvatures without units; points count by the inverse of their distance.
  std::array<std::array<double, 5>, 5> matrix{};
  std::array<double, 5> right{};
  for (const Point& d : points) {
    const double a = dot(d, e1) / length, b = dot(d, e2) / length, h = dot(d, first) / length;
    const std::array<double, 5> row{a, b, a * a / 2, a * b, b * b / 2};
    const double weight = square / dot(d, d);
    for (std::size_t i = 0; i < 5; ++i) {
      right[i] += weight * row[i] * h;
      for (std::size_t j = 0; j < 5; ++j) matrix[i][j] += weight * row[i] * row[j];
    }
  }
  constexpr double k_straight = 1e-3;
  for (std::size_t i = 2; i < 5; ++i) matrix[i][i] += k_straight;
  if (!solve(matrix, right)) return first;
  Point n = first;
  for (std::size_t i = 0; i < 3; ++i) n[i] -= right[0] * e1[i] + right[1] * e2[i];
  return unit(n).value_or(first);
}

/// A face of the skin by its vertices, in the order of the numbers of faces.
struct SkinFacet {
  std::array<Index, 4> vertices{};
  int n = 0;
  GlobalIndex number = 0;
};

/// A side of a face: an edge of it, from the vertex `place` on.
struct Side {
  Index low = 0, high = 0;  ///< ends, local numbers
  Index face = 0;
  int place = 0;
};

/// Unions of corners, with a sign of each relative to its union's: faces that run around their common edge in
/// the same direction look to different sides.
class Fans {
 public:
  explicit Fans(std::size_t n) : root_(n), sign_(n, 1) {
    std::iota(root_.begin(), root_.end(), std::size_t{0});
  }
  /// The union of a corner, and the corner's sign in it.
  std::pair<std::size_t, int> find(std::size_t i) const {
    int sign = 1;
    while (root_[i] != i) {
      sign *= sign_[i];
      i = root_[i];
    }
    return {i, sign};
  }
  void join(std::size_t i, std::size_t j, int relative) {
    const auto [a, sign_a] = find(i);
    const auto [b, sign_b] = find(j);
    if (a == b) return;
    root_[b] = a;
    sign_[b] = static_cast<signed char>(sign_a * sign_b * relative);
  }

 private:
  std::vector<std::size_t> root_;
  std::vector<signed char> sign_;
};

class Skin {
 public:
  Skin(const Mesh& mesh, const std::vector<ElementBlock>& blocks)
      : mesh_(mesh), facets_(facets_of(blocks)), fans_(4 * facets_.size()) {
    find_normals();
    find_sides();
  }

  std::vector<SkinEdge> edges() {
    // Sides of one edge stand together: two of faces that bend by little make it smooth.
    for (std::size_t i = 0, next = 0; i < sides_.size(); i = next) {
      while (next < sides_.size() && sides_[next].low == sides_[i].low && sides_[next].high == sides_[i].high)
        ++next;
      const bool smooth = mesh_.dimension == 3 && next - i == 2 && join_if_smooth(sides_[i], sides_[i + 1]);
      SkinEdge& edge = edges_.emplace_back();
      edge = {sides_[i].low, sides_[i].high, !smooth, {}, {}};
      if (number(edge.b) < number(edge.a)) std::swap(edge.a, edge.b);
      first_side_.push_back(i);
      if (!smooth) {
        on_lines_[edge.a].push_back(edge.b);
        on_lines_[edge.b].push_back(edge.a);
      }
    }
    sum_normals();
    for (std::size_t k = 0; k < edges_.size(); ++k) {
      SkinEdge& edge = edges_[k];
      if (is_mine(edge.a)) edge.tangent_a = tangent(k, edge.a, edge.b);
      if (is_mine(edge.b)) {
        edge.tangent_b = tangent(k, edge.b, edge.a);
        if (edge.tangent_b)
          for (double& t : *edge.tangent_b) t = -t;
      }
    }
    return std::move(edges_);
  }

 private:
  bool is_mine(Index node) const { return node < mesh_.n_owned_nodes; }
  GlobalIndex number(Index node) const { return mesh_.input_node[as_size(node)]; }
  const Point& x(Index node) const { return mesh_.x[as_size(node)]; }

  static std::vector<SkinFacet> facets_of(const std::vector<ElementBlock>& blocks) {
    std::vector<SkinFacet> facets;
    for (const ElementBlock& block : blocks) {
      const int n = vertex_count(block.shape);
      for (Index e = 0; e < block.size(); ++e) {
        SkinFacet& facet = facets.emplace_back();
        facet.n = n;
        facet.number = block.input_element[as_size(e)];
        std::copy_n(block.element(e), n, facet.vertices.begin());
      }
    }
    // Sums over faces are made in the order of their numbers, so that they have the same bits on any number
    // of processes.
    std::sort(facets.begin(), facets.end(),
              [](const SkinFacet& a, const SkinFacet& b) { return a.number < b.number; });
    return facets;
  }

  void find_normals() {
    if (mesh_.dimension != 3) return;
    for (const SkinFacet& f : facets_) {
      const auto d = [&](int i, int j) {
        return minus(x(f.vertices[as_size(i)]), x(f.vertices[as_size(j)]));
      };
      const Point n = f.n == 3 ? cross(d(1, 0), d(2, 0)) : cross(d(2, 0), d(3, 1));
      normals_.push_back(unit(n).value_or(Point{}));
    }
  }

  void find_sides() {
    // In the plane a face is a line and its only side.
    for (std::size_t f = 0; f < facets_.size(); ++f) {
      const SkinFacet& facet = facets_[f];
      for (int k = 0; k < (facet.n == 2 ? 1 : facet.n); ++k) {
        const Index a = facet.vertices[as_size(k)], b = facet.vertices[as_size((k + 1) % facet.n)];
        // Only edges with an end of this process have all their faces here.
        if (is_mine(a) || is_mine(b)) sides_.push_back({std::min(a, b), std::max(a, b), as_index(f), k});
      }
    }
    std::sort(sides_.begin(), sides_.end(), [](const Side& a, const Side& b) {
      return std::tie(a.low, a.high, a.face, a.place) < std::tie(b.low, b.high, b.face, b.place);
    });
  }

  std::size_t corner(Index face, Index node) const {
    const SkinFacet& f = facets_[as_size(face)];
    for (int k = 0; k < f.n; ++k)
      if (f.vertices[as_size(k)] == node) return 4 * as_size(face) + as_size(k);
    return 4 * as_size(face);
  }

  bool join_if_smooth(const Side& one, const Side& other) {
    const Index start_one = facets_[as_size(one.face)].vertices[as_size(one.place)],
                start_other = facets_[as_size(other.face)].vertices[as_size(other.place)];
    const int relative = start_one == start_other ? -1 : 1;
    constexpr double k_rounding = 1e-9;
    if (relative * dot(normals_[as_size(one.face)], normals_[as_size(other.face)]) <
        std::cos(k_smooth_bend) + k_rounding)
      return false;
    for (const Index end : {one.low, one.high})
      fans_.join(corner(one.face, end), corner(other.face, end), relative);
    return true;
  }

  /// The normal of each fan at a vertex of this process: that of the quadric which fits its points.
  void sum_normals() {
    if (mesh_.dimension != 3) return;
    // Corners come in the order of the numbers of their faces.
    std::unordered_map<std::size_t, std::vector<std::size_t>> corners;
    for (std::size_t f = 0; f < facets_.size(); ++f)
      for (int k = 0; k < facets_[f].n; ++k)
        if (is_mine(facets_[f].vertices[as_size(k)]))
          corners[fans_.find(4 * f + as_size(k)).first].push_back(4 * f + as_size(k));
    for (const auto& [fan, of_fan] : corners) {
      const Point& centre = x(vertex(of_fan.front()));
      Point sum{};
      std::vector<Index> around;
      const int first_sign = fans_.find(of_fan.front()).second;
      for (const std::size_t c : of_fan) {
        const SkinFacet& facet = facets_[c / 4];
        const int k = static_cast<int>(c % 4);
        const Point next = minus(x(facet.vertices[as_size((k + 1) % facet.n)]), centre),
                    last = minus(x(facet.vertices[as_size((k + facet.n - 1) % facet.n)]), centre);
        const double weight = first_sign * fans_.find(c).second / (dot(next, next) * dot(last, last));
        const Point n = cross(next, last);
        for (std::size_t i = 0; i < 3; ++i) sum[i] += weight * n[i];
        for (int j = 1; j < facet.n; ++j) around.push_back(facet.vertices[as_size((k + j) % facet.n)]);
      }
      std::vector<Point> points;
      for (std::size_t i = 0; i < around.size(); ++i)
        if (std::find(around.begin(), around.begin() + static_cast<std::ptrdiff_t>(i), around[i]) ==
            around.begin() + static_cast<std::ptrdiff_t>(i))
          points.push_back(minus(x(around[i]), centre));
      if (const std::optional<Point> n = unit(sum)) normal_of_fan_[fan] = normal_of_quadric(*n, points);
    }
  }

  Index vertex(std::size_t corner) const { return facets_[corner / 4].vertices[corner % 4]; }

  /// At the vertex a of an edge, towards b.
  std::optional<Point> tangent(std::size_t edge, Index a, Index b) const {
    const Point chord = minus(x(b), x(a));
    if (!edges_[edge].is_line) {
      // The chord's part in the tangent plane.
      const auto fan = fans_.find(corner(sides_[first_side_[edge]].face, a)).first;
      const auto normal = normal_of_fan_.find(fan);
      if (normal == normal_of_fan_.end()) return std::nullopt;
      const Point& n = normal->second;
      Point t = chord;
      for (std::size_t i = 0; i < 3; ++i) t[i] -= dot(chord, n) * n[i];
      return unit(t);
    }
    // The line goes on through the vertex, or ends there.
    const std::vector<Index>& ends = on_lines_.at(a);
    if (ends.size() != 2) return std::nullopt;
    const Index c = ends[0] == b ? ends[1] : ends[0];
    const Point before = minus(x(a), x(c));
    const double bb = dot(before, before), cc = dot(chord, chord);
    if (dot(before, chord) < std::cos(k_smooth_bend) * std::sqrt(bb * cc)) return std::nullopt;
    Point t{};
    for (std::size_t i = 0; i < 3; ++i) t[i] = before[i] / bb + chord[i] / cc;
    return unit(t);
  }

  const Mesh& mesh_;
  std::vector<SkinFacet> facets_;
  Fans fans_;  ///< of corners, four to a face
  std::vector<Point> normals_;
  std::vector<Side> sides_;
  std::vector<SkinEdge> edges_;
  std::vector<std::size_t> first_side_;  ///< of each edge
  std::unordered_map<Index, std::vector<Index>> on_lines_;
  std::unordered_map<std::size_t, Point> normal_of_fan_;
};

}  // namespace

std::vector<SkinEdge> skin_edges(const Mesh& mesh, const std::vector<ElementBlock>& skin) {
  return Skin(mesh, skin).edges();
}

}  // namespace solidus::mesh
