/// An edge may be drawn together if the neighbourhood stays a mesh and the boundary keeps its shape.
#include "mesh/making/edge_collapse.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "mesh/making/surface_node.hpp"

namespace solidus::mesh {

namespace {

Point minus(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
double dot(const Point& u, const Point& v) {
  return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}
Point cross(const Point& u, const Point& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

using Edge = std::pair<Index, Index>;

Edge edge_of(Index a, Index b) {
  return {std::min(a, b), std::max(a, b)};
}

bool has(const SurfaceFace& face, Index node) {
  return std::find(face.nodes.begin(), face.nodes.end(), node) != face.nodes.end();
}

template <class T>
std::set<T> common(const std::set<T>& a, const std::set<T>& b) {
  std::set<T> both;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::inserter(both, both.end()));
  return both;
}

/// Edges across from a node in its tetrahedra: the edges of its link.
std::set<Edge> link_edges(const Tetrahedra& mesh, Index node, Index without) {
  std::set<Edge> edges;
  for (const std::size_t t : mesh.around(node)) {
    const Triangle f = mesh[t].across(node);
    for (std::size_t i = 0; i < 3; ++i)
      if (f[i] != without && f[(i + 1) % 3] != without) edges.insert(edge_of(f[i], f[(i + 1) % 3]));
  }
  return edges;
}

bool keeps_topology(const Tetrahedra& mesh, Index from, Index to, const std::vector<std::size_t>& between,
                    const SurfaceNode& here) {
  const std::vector<SurfaceFace>& faces = here.faces();
  std::set<Index> ring;
  std::set<Edge> ring_edges;
  // The links of both nodes may share only what lies around their edge (the link condition), in the volume
  // and on the surface.
  for (const std::size_t t : between) {
    const auto [p, q] = mesh[t].beside(from, to);
    ring.insert({p, q});
    ring_edges.insert(edge_of(p, q));
  }
  if (common(neighbours(mesh, from), neighbours(mesh, to)) != ring) return false;
  if (common(link_edges(mesh, from, to), link_edges(mesh, to, from)) != ring_edges) return false;
  if (faces.empty()) return true;
  // On the surface the other end must be a neighbour there too, and the less important node goes.
  const SurfaceNode there(mesh, to);
  if (there.on_surface().empty()) return false;
  if (here.on_surface().count(to) == 0) return false;
  std::set<Index> thirds;  // of the faces with both
  for (const SurfaceFace& face : faces)
    if (has(face, to))
      for (const Index node : face.nodes)
        if (node != from && node != to) thirds.insert(node);
  if (common(here.on_surface(), there.on_surface()) != thirds) return false;
  if (here.importance() > there.importance()) return false;  // the other way round, then
  if (here.on_curves().empty()) return true;
  return here.on_curves().count(to) > 0 && common(here.on_curves(), there.on_curves()).empty();
}

/// Whether the faces that go along with the node stay about where they are.
bool keeps_shape(const Tetrahedra& mesh, Index from, Index to, const std::vector<SurfaceFace>& faces) {
  constexpr double k_turn = 0.966;  // the cosine of 15 degrees
  constexpr double k_flat = 0.05;   // of the square root of a face's area
  const Point &a = mesh.x(from), &b = mesh.x(to);
  // Every face at the node that does not vanish with the edge must keep its direction, and the node
  // stay near its plane.
  for (const SurfaceFace& face : faces) {
    if (has(face, to)) continue;
    std::array<Point, 3> before{}, after{};
    for (std::size_t i = 0; i < 3; ++i) {
      before[i] = mesh.x(face.nodes[i]);
      after[i] = face.nodes[i] == from ? b : before[i];
    }
    const Point n = cross(minus(before[1], before[0]), minus(before[2], before[0])),
                m = cross(minus(after[1], after[0]), minus(after[2], after[0]));
    const double nn = std::sqrt(dot(n, n)), mm = std::sqrt(dot(m, m));
    if (!(mm > 0) || dot(n, m) < k_turn * nn * mm) return false;
    if (std::abs(dot(m, minus(a, b))) > k_flat * mm * std::sqrt(mm)) return false;
  }
  return true;
}

}  // namespace

Change with_node_on(const Tetrahedra& mesh, Index from, Index to) {
  // The change takes the edge away by moving `from` onto `to`. It is empty where the node is held, or where
  // nothing would be won.
  if (mesh.is_locked(from)) return {};
  const std::vector<std::size_t> between = around_edge(mesh, from, to);
  if (between.empty()) return {};
  Change change;
  change.quality = 1;
  // No edge may get much longer than those that were there, or elements would grow beyond the size that was
  // asked for.
  const auto length = [&](Index a, Index b) {
    const Point d = minus(mesh.x(b), mesh.x(a));
    return std::sqrt(dot(d, d));
  };
  double longest_before = 0, longest_after = 0, sum = 0;
  for (const Index other : neighbours(mesh, from)) {
    longest_before = std::max(longest_before, length(from, other));
    if (other != to) longest_after = std::max(longest_after, length(to, other));
    sum += length(from, other);
  }
  constexpr double k_stretch = 1.4;
  if (longest_after > k_stretch * longest_before) return {};
  // The tetrahedra at the edge vanish, the others at `from` get `to` in its place. One of no volume ends the
  // try.
  for (const std::size_t t : mesh.around(from)) {
    change.old.push_back(t);
    if (mesh[t].has(to)) continue;
    Tetrahedron tet = mesh[t];
    std::replace(tet.nodes.begin(), tet.nodes.end(), from, to);
    change.quality = std::min(change.quality, mesh.quality(tet.nodes));
    if (!(change.quality > 0)) return {};
    change.made.push_back(tet);
  }
  // On the surface the topology has to stay that of the body, and its shape has to stay within a tolerance
  // unless the edge is very short.
  const SurfaceNode here(mesh, from);
  if (!keeps_topology(mesh, from, to, between, here)) return {};
  constexpr double k_short = 0.25;  // of the mean of the edges around
  const bool is_short = length(from, to) < k_short * sum / static_cast<double>(neighbours(mesh, from).size());
  if (!is_short && !keeps_shape(mesh, from, to, here.faces())) return {};
  return change;
}

}  // namespace solidus::mesh
