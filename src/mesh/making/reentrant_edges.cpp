/// Boundary faces of all bodies together, pairs of them at each edge, and the angle that the bodies fill
/// there.
#include "mesh/making/reentrant_edges.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <unordered_map>

#include "mesh/surfaces/faces.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mesh {

namespace {

/// a + scale × b.
Point plus(const Point& a, const Point& b, double scale = 1) {
  return {a[0] + scale * b[0], a[1] + scale * b[1], a[2] + scale * b[2]};
}
Point times(double scale, const Point& a) {
  return {scale * a[0], scale * a[1], scale * a[2]};
}
Point from_to(const Point& a, const Point& b) {
  return plus(b, a, -1);
}
double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Point unit(const Point& a) {
  const double length = std::sqrt(dot(a, a));
  return length > 0 ? times(1 / length, a) : a;
}
/// The part of `a` across the unit vector `t`, of length one.
Point across(const Point& a, const Point& t) {
  return unit(plus(a, t, -dot(a, t)));
}

/// A face of the boundary: its vertices and the centre of its element.
struct BoundaryFace {
  std::array<Index, 4> vertices{-1, -1, -1, -1};
  int n = 0;
  Point inside{};
  int n_elements = 0;
};

using Faces = std::unordered_map<FaceKey, BoundaryFace, FaceKeyHash>;

const Point& place(const Mesh& mesh, Index node) {
  return mesh.x[as_size(node)];
}

template <class Nodes>
Point centre_of(const Mesh& mesh, const Nodes& nodes, int n) {
  Point sum{};
  for (int a = 0; a < n; ++a) sum = plus(sum, place(mesh, nodes[as_size(a)]));
  return times(1.0 / n, sum);
}

/// The vector area of the face (in the plane the length) with its vertices in this order.
Point vector_area(const Mesh& mesh, const BoundaryFace& face) {
  const auto corner = [&](int a) { return place(mesh, face.vertices[as_size(a)]); };
  if (face.n == 2) {
    const Point edge = from_to(corner(0), corner(1));
    return {edge[1], -edge[0], 0};
  }
  Point sum{};
  for (int a = 1; a + 1 < face.n; ++a)
    sum = plus(sum, cross(from_to(corner(0), corner(a)), from_to(corner(0), corner(a + 1))));
  return times(0.5, sum);
}

template <class Visit>
void for_faces(const Mesh& mesh, const Visit& visit) {
  for (const ElementBlock& block : mesh.blocks)
    for (Index e = 0; e < block.size(); ++e)
      for (int f = 0; f < face_count(block.shape); ++f) {
        BoundaryFace face;
        const std::span<const int> local = face_nodes(block.shape, f);
        face.n = vertex_count(face_shape(block.shape));
        for (std::size_t a = 0; a < as_size(face.n); ++a) face.vertices[a] = block.element(e)[local[a]];
        visit(block, e, face);
      }
}

/// Nodes at which the faces of their elements do not close: those of the boundary, and few others. Only
/// between such nodes are faces collected, which saves the memory of all others.
std::vector<char> open_nodes(const Mesh& mesh) {
  std::vector<Point> sum(mesh.x.size(), Point{});
  std::vector<double> size(mesh.x.size(), 0.0);
  for_faces(mesh, [&](const ElementBlock&, Index, const BoundaryFace& face) {
    const Point area = vector_area(mesh, face);
    for (int a = 0; a < face.n; ++a) {
      const auto i = as_size(face.vertices[as_size(a)]);
      sum[i] = plus(sum[i], area);
      size[i] += std::sqrt(dot(area, area));
    }
  });
  constexpr double k_rounding = 1e-9;
  std::vector<char> open(mesh.x.size());
  for (std::size_t i = 0; i < open.size(); ++i)
    open[i] = std::sqrt(dot(sum[i], sum[i])) > k_rounding * size[i];
  return open;
}

Faces boundary_faces(const Mesh& mesh) {
  const std::vector<char> open = open_nodes(mesh);
  Faces faces;
  for_faces(mesh, [&](const ElementBlock& block, Index e, const BoundaryFace& face) {
    for (int a = 0; a < face.n; ++a)
      if (open[as_size(face.vertices[as_size(a)])] == 0) return;
    BoundaryFace& kept = faces[face_key(face.vertices.data(), face.n)];
    if (kept.n_elements++ > 0) return;
    kept = face;
    kept.inside = centre_of(mesh, block.element(e), vertex_count(block.shape));
    kept.n_elements = 1;
  });
  std::erase_if(faces, [](const auto& entry) { return entry.second.n_elements > 1; });
  return faces;
}

/// The wedge between two faces at an edge through `at`; angle 0 where it is not re-entrant.
Wedge wedge_between(const Mesh& mesh, const BoundaryFace& a, const BoundaryFace& b, const Point& at,
                    const Point& tangent) {
  const Point along = across(from_to(at, centre_of(mesh, a.vertices, a.n)), tangent);
  Point inward = across(from_to(at, a.inside), tangent);
  inward = unit(plus(inward, along, -dot(inward, along)));
  const Point other = across(from_to(at, centre_of(mesh, b.vertices, b.n)), tangent);
  double angle = std::atan2(dot(other, inward), dot(other, along));
  if (angle < 0) angle += 2 * std::numbers::pi;
  if (angle < k_reentrant_angle) return {};
  return {plus(times(std::cos(angle / 2), along), inward, std::sin(angle / 2)), tangent, angle};
}

/// The wedge of a node from those of the edges that meet there.
Wedge joined(const std::vector<Wedge>& wedges) {
  if (wedges.size() == 1) return wedges.front();
  if (wedges.size() != 2) return {};
  const Wedge &a = wedges[0], &b = wedges[1];
  const double sense = dot(a.tangent, b.tangent) < 0 ? -1 : 1;
  if (sense * dot(a.tangent, b.tangent) < std::numbers::sqrt2 / 2) return {};
  const Point tangent = unit(plus(a.tangent, b.tangent, sense));
  return {across(plus(a.bisector, b.bisector), tangent), tangent, (a.angle + b.angle) / 2};
}

}  // namespace

std::vector<std::pair<Index, Wedge>> reentrant_wedges(const Mesh& mesh) {
  const Faces faces = boundary_faces(mesh);
  // The faces at each edge, or at each node in the plane, that an owned node belongs to.
  std::map<std::pair<Index, Index>, std::vector<const BoundaryFace*>> at_edge;
  for (const auto& [key, face] : faces)
    for (int a = 0; a < face.n; ++a) {
      Index i = face.vertices[as_size(a)];
      Index j = face.n == 2 ? i : face.vertices[as_size((a + 1) % face.n)];
      if (i > j) std::swap(i, j);
      if (i < mesh.n_owned_nodes) at_edge[{i, j}].push_back(&face);
    }
  std::map<Index, std::vector<Wedge>> at_node;
  for (const auto& [edge, meeting] : at_edge) {
    // Two faces at an edge bound one angle; more of them are edges where bodies touch.
    if (meeting.size() != 2) continue;
    const auto [i, j] = edge;
    const bool plane = i == j;
    const Point at = times(0.5, plus(place(mesh, i), place(mesh, j)));
    const Point tangent = plane ? Point{0, 0, 1} : unit(from_to(place(mesh, i), place(mesh, j)));
    // The first is that with the smaller key, so that the answer does not depend on the order of the table.
    const auto [a, b] = std::minmax(meeting[0], meeting[1], [](const BoundaryFace* l, const BoundaryFace* r) {
      return face_key(l->vertices.data(), l->n).vertices < face_key(r->vertices.data(), r->n).vertices;
    });
    const Wedge wedge = wedge_between(mesh, *a, *b, at, tangent);
    // An angle of less than half a turn is no wedge.
    if (wedge.angle == 0) continue;
    at_node[i].push_back(wedge);
    if (!plane && j < mesh.n_owned_nodes) at_node[j].push_back(wedge);
  }
  // Wedges of several edges at one node are joined to one.
  std::vector<std::pair<Index, Wedge>> result;
  for (const auto& [node, wedges] : at_node)
    if (const Wedge wedge = joined(wedges); wedge.angle > 0) result.emplace_back(node, wedge);
  return result;
}

}  // namespace solidus::mesh
