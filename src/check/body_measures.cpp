/// Volumes, faces and edges are summed on each process and reduced at the end.
#include "check/body_measures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "mesh/block_geometry.hpp"
#include "mesh/block_part.hpp"
#include "mesh/body_faces.hpp"
#include "mesh/quadrature.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"

namespace solidus::check {

namespace {

/// Set of the bodies that meet at a node, as bits; bodies beyond the 63rd count as one.
using BodySet = std::uint64_t;

BodySet bit(int body) {
  return BodySet{1} << std::min(body, 63);
}

double distance(const mesh::Point& a, const mesh::Point& b) {
  const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  return std::sqrt(x * x + y * y + z * z);
}

const mesh::Point& at(const mesh::Mesh& mesh, Index node) {
  return mesh.x[as_size(node)];
}

}  // namespace

double skin_area(const mesh::Mesh& mesh, std::span<const Index> vertices, AnalysisKind kind) {
  const mesh::Point& a = at(mesh, vertices[0]);
  const mesh::Point& b = at(mesh, vertices[1]);
  if (vertices.size() == 2)
    return distance(a, b) *
           (kind == AnalysisKind::axisymmetric ? std::numbers::pi * (std::abs(a[0]) + std::abs(b[0])) : 1.0);
  const auto triangle = [](const mesh::Point& p, const mesh::Point& q, const mesh::Point& r) {
    const mesh::Point u{q[0] - p[0], q[1] - p[1], q[2] - p[2]}, v{r[0] - p[0], r[1] - p[1], r[2] - p[2]};
    return 0.5 * std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]);
  };
  double area = triangle(a, b, at(mesh, vertices[2]));
  if (vertices.size() == 4) area += triangle(a, at(mesh, vertices[2]), at(mesh, vertices[3]));
  return area;
}

double element_volume(const mesh::BlockGeometry& geometry, Index element) {
  double volume = 0;
  for (int p = 0; p < geometry.n_points; ++p)
    volume += geometry.weight_at(element / k_lanes, p)[element % k_lanes];
  return volume;
}

namespace {

/// Adds the skins, and the areas that bodies share.
void measure_skins(const mesh::Mesh& mesh, AnalysisKind kind, std::vector<BodyMeasures>& bodies) {
  mesh::each_body_face(mesh, [&](const mesh::BodyFace& face, std::span<const mesh::BodyFace> same) {
    const double area = skin_area(mesh, face.vertices(), kind);
    BodyMeasures& body = bodies[as_size(face.body)];
    body.skin += area;
    for (const mesh::BodyFace& other : same)
      if (other.body != face.body) body.shared[as_size(other.body)] += area;
  });
}

/// Calls visit(p, q) for the edges of an element, from vertex p to vertex q: twice where two of its faces
/// share each.
template <class Visit>
void each_edge(mesh::Shape shape, const Visit& visit) {
  const int n_vertices = mesh::vertex_count(shape);
  if (n_vertices == mesh::dimension(shape) + 1) {  // all pairs of a simplex, once
    for (int p = 0; p < n_vertices; ++p)
      for (int q = p + 1; q < n_vertices; ++q) visit(p, q);
    return;
  }
  const int corners = mesh::vertex_count(mesh::face_shape(shape));
  for (int f = 0; f < mesh::face_count(shape); ++f) {
    const auto local = mesh::face_nodes(shape, f);
    for (int i = 0; i < (corners == 2 ? 1 : corners); ++i)
      visit(local[as_size(i)], local[as_size((i + 1) % corners)]);
  }
}

void measure_part(const mesh::Mesh& mesh, AnalysisKind kind, const mesh::ElementBlock& block,
                  BodyMeasures& body, double& edges, double& n_edges) {
  const mesh::BlockGeometry geometry(mesh, block, kind, mesh::stiffness_rule(block.shape));
  for (Index e = 0; e < block.n_counted; ++e) {
    // One element at a time: its volume, then its edges, of which the shortest and longest tell how
    // flat it is. Mid-side nodes do not count, since an edge is measured from corner to corner.
    body.volume += element_volume(geometry, e);
    const Index* const nodes = block.element(e);
    double shortest = std::numeric_limits<double>::max(), longest = 0;
    // The flattest element has the largest ratio of its edges.
    each_edge(block.shape, [&](int p, int q) {
      const double length = distance(at(mesh, nodes[p]), at(mesh, nodes[q]));
      shortest = std::min(shortest, length);
      longest = std::max(longest, length);
      edges += length, ++n_edges;
    });
    // The extremes of the body are over all elements; the mean edge is formed at the end from the
    // two sums.
    body.shortest_edge = std::min(body.shortest_edge, shortest);
    body.longest_edge = std::max(body.longest_edge, longest);
    if (shortest > 0) body.flattest = std::max(body.flattest, longest / shortest);
  }
}

/// Boxes and numbers of nodes, those that bodies share included.
void measure_nodes(const mesh::Mesh& mesh, std::vector<BodyMeasures>& bodies) {
  std::vector<BodySet> of_node(mesh.x.size(), 0);
  // Which bodies a node belongs to, as bits: a node on a common face has several.
  for (const mesh::ElementBlock& block : mesh.blocks)
    for (const Index node : block.nodes) of_node[as_size(node)] |= bit(block.body);
  for (Index i = 0; i < mesh.n_owned_nodes; ++i)
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      const BodySet here = of_node[as_size(i)];
      if ((here & bit(static_cast<int>(b))) == 0) continue;
      ++bodies[b].nodes;
      for (std::size_t d = 0; d < 3; ++d) {
        bodies[b].low[d] = std::min(bodies[b].low[d], at(mesh, i)[d]);
        bodies[b].high[d] = std::max(bodies[b].high[d], at(mesh, i)[d]);
      }
      // A node of two bodies counts for the pair in both directions, since either may be asked for
      // the other.
      for (std::size_t other = 0; other < bodies.size(); ++other)
        if (other != b && (here & bit(static_cast<int>(other))) != 0) ++bodies[b].shared_nodes[other];
    }
}

GlobalIndex global_count(GlobalIndex n) {
  return static_cast<GlobalIndex>(std::llround(parallel::global_sum(static_cast<double>(n))));
}

/// From this process's part to that of all.
void reduce(BodyMeasures& body, double edges, double n_edges) {
  for (std::size_t d = 0; d < 3; ++d) {
    body.low[d] = parallel::global_min(body.low[d]);
    body.high[d] = parallel::global_max(body.high[d]);
  }
  body.volume = parallel::global_sum(body.volume);
  body.skin = parallel::global_sum(body.skin);
  for (double& area : body.shared) area = parallel::global_sum(area);
  for (GlobalIndex& n : body.shared_nodes) n = global_count(n);
  body.shortest_edge = parallel::global_min(body.shortest_edge);
  body.longest_edge = parallel::global_max(body.longest_edge);
  body.flattest = parallel::global_max(body.flattest);
  body.mean_edge = parallel::global_sum(edges) / std::max(1.0, parallel::global_sum(n_edges));
  body.nodes = global_count(body.nodes);
  body.elements = global_count(body.elements);
}

}  // namespace

std::vector<BodyMeasures> measure_bodies(const mesh::Mesh& mesh, AnalysisKind kind) {
  constexpr double k_huge = std::numeric_limits<double>::max();
  const std::size_t n = mesh.bodies.size();
  // Minima start at the largest number and maxima at its negative, so that a process without a node
  // of the body changes nothing when they are reduced.
  BodyMeasures none;
  none.low.fill(k_huge);
  none.high.fill(-k_huge);
  none.shortest_edge = k_huge;
  none.shared.assign(n, 0.0);
  none.shared_nodes.assign(n, 0);
  std::vector<BodyMeasures> bodies(n, none);
  std::vector<double> edges(n, 0.0), n_edges(n, 0.0);
  // Sums over the own nodes, faces and elements first, reduced over the processes at last.
  measure_nodes(mesh, bodies);
  measure_skins(mesh, kind, bodies);
  // Elements in parts, since the geometry of all elements of a large block at once would be most of
  // the memory of a check.
  for (const mesh::ElementBlock& block : mesh.blocks) {
    const auto b = as_size(block.body);
    bodies[b].elements += block.n_counted;
    mesh::for_parts(block, [&](const mesh::ElementBlock& part, Index) {
      measure_part(mesh, kind, part, bodies[b], edges[b], n_edges[b]);
    });
  }
  for (std::size_t b = 0; b < n; ++b) reduce(bodies[b], edges[b], n_edges[b]);
  return bodies;
}

double share_between(const mesh::Mesh& mesh, AnalysisKind kind, int body, const std::vector<char>& marked) {
  double all = 0, between = 0;
  for (const mesh::ElementBlock& block : mesh.blocks) {
    if (block.body != body) continue;
    // An element lies between when all of its nodes are marked.
    mesh::for_parts(block, [&](const mesh::ElementBlock& part, Index) {
      const mesh::BlockGeometry geometry(mesh, part, kind, mesh::stiffness_rule(part.shape));
      // Counted elements are those of which this process owns the first node, so that none enters
      // the sums twice.
      for (Index e = 0; e < part.n_counted; ++e) {
        const double volume = element_volume(geometry, e);
        const Index* nodes = part.element(e);
        all += volume;
        if (std::all_of(nodes, nodes + mesh::node_count(part.shape),
                        [&](Index node) { return marked[as_size(node)] != 0; }))
          between += volume;
      }
    });
  }
  all = parallel::global_sum(all);
  return all > 0 ? parallel::global_sum(between) / all : 0.0;
}

}  // namespace solidus::check
