#include "check/body_measures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>
#include <tuple>

#include "mesh/block_geometry.hpp"
#include "mesh/quadrature.hpp"
#include "parallel/parallel.hpp"

namespace solidus::model {

namespace {

/// Set of the bodies that meet at a node, as bits; bodies beyond the 63rd count as one.
using BodySet = std::uint64_t;

BodySet bit(int body) {
  return BodySet{1} << std::min(body, 63);
}

double distance(const mesh::Point& a, const mesh::Point& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

const mesh::Point& at(const mesh::Mesh& mesh, Index node) {
  return mesh.x[static_cast<std::size_t>(node)];
}

/// A face of an element, by its vertices in rising order of their numbers over all processes.
struct BoundaryFace {
  std::array<GlobalIndex, 4> key{-1, -1, -1, -1};
  int body = 0;
  std::array<Index, 4> nodes{};  ///< its vertices in the order of the element
  int n_vertices = 0;
  bool operator<(const BoundaryFace& other) const {
    return std::tie(key, body) < std::tie(other.key, other.body);
  }
};

/// Length or area by the vertices, per metre of thickness or over the revolution.
double area_of(const mesh::Mesh& mesh, std::span<const Index> vertices, AnalysisKind kind) {
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

/// The place of a face in the mesh.
struct FacePlace {
  Index element = 0;
  int block = 0, face = 0;
};

/// Calls visit(place, lowest) for every face; `lowest` is the vertex whose number over all processes is the
/// lowest.
template <class Visit>
void each_face(const mesh::Mesh& mesh, Visit&& visit) {
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const mesh::ElementBlock& block = mesh.blocks[b];
    const auto n_vertices = static_cast<std::size_t>(mesh::vertex_count(mesh::face_shape(block.shape)));
    for (Index e = 0; e < block.size(); ++e)
      for (int f = 0; f < mesh::face_count(block.shape); ++f) {
        const std::span<const int> local = mesh::face_nodes(block.shape, f).first(n_vertices);
        const auto number = [&](int vertex) {
          return mesh.global_node[static_cast<std::size_t>(block.element(e)[vertex])];
        };
        visit(FacePlace{e, static_cast<int>(b), f}, block.element(e)[std::ranges::min(local, {}, number)]);
      }
  }
}

/// Faces sorted by their lowest vertex, of the vertices from `first` to before `last`. Where these are owned
/// here, all elements that have the face are held here.
struct FacesOfNodes {
  std::vector<std::size_t> start;  ///< of each vertex in `places`; one more at the end
  std::vector<FacePlace> places;
};

FacesOfNodes faces_of_nodes(const mesh::Mesh& mesh, Index first, Index last) {
  const auto slot = [&](Index node) { return static_cast<std::size_t>(node - first); };
  const auto among = [&](Index node) { return node >= first && node < last; };
  FacesOfNodes faces;
  faces.start.assign(slot(last) + 1, 0);
  each_face(mesh, [&](const FacePlace&, Index lowest) {
    if (among(lowest)) ++faces.start[slot(lowest) + 1];
  });
  std::partial_sum(faces.start.begin(), faces.start.end(), faces.start.begin());
  faces.places.resize(faces.start.back());
  std::vector<std::size_t> next(faces.start.begin(), faces.start.end() - 1);
  each_face(mesh, [&](const FacePlace& place, Index lowest) {
    if (among(lowest)) faces.places[next[slot(lowest)]++] = place;
  });
  return faces;
}

BoundaryFace face_at(const mesh::Mesh& mesh, const FacePlace& place) {
  const mesh::ElementBlock& block = mesh.blocks[static_cast<std::size_t>(place.block)];
  const std::span<const int> local = mesh::face_nodes(block.shape, place.face);
  BoundaryFace face;
  face.body = block.body;
  face.n_vertices = mesh::vertex_count(mesh::face_shape(block.shape));
  for (std::size_t i = 0; i < static_cast<std::size_t>(face.n_vertices); ++i) {
    face.nodes[i] = block.element(place.element)[local[i]];
    face.key[i] = mesh.global_node[static_cast<std::size_t>(face.nodes[i])];
  }
  std::sort(face.key.begin(), face.key.begin() + face.n_vertices);
  return face;
}

/// Adds the areas of the faces that one element alone of a body has, of faces with the same lowest vertex.
void measure_alone(const mesh::Mesh& mesh, AnalysisKind kind, std::span<const BoundaryFace> faces,
                   std::vector<BodyMeasures>& bodies) {
  for (std::size_t i = 0, end = 0; i < faces.size(); i = end) {
    while (end < faces.size() && faces[end].key == faces[i].key) ++end;
    const std::span<const BoundaryFace> same = faces.subspan(i, end - i);
    for (const BoundaryFace& face : same) {
      const auto inside = std::ranges::count(same, face.body, &BoundaryFace::body);
      if (inside > 1) continue;
      const double area =
          area_of(mesh, std::span(face.nodes).first(static_cast<std::size_t>(face.n_vertices)), kind);
      BodyMeasures& body = bodies[static_cast<std::size_t>(face.body)];
      body.skin += area;
      for (const BoundaryFace& other : same)
        if (other.body != face.body) body.shared[static_cast<std::size_t>(other.body)] += area;
    }
  }
}

/// Adds the skins, and the areas that bodies share. A face is counted by the owner of its lowest vertex. The
/// vertices are taken in few portions: each costs a pass through the mesh and holds its faces.
void measure_skins(const mesh::Mesh& mesh, AnalysisKind kind, std::vector<BodyMeasures>& bodies) {
  constexpr Index k_portion = 4'000'000;
  std::vector<BoundaryFace> of_node;
  for (Index first = 0; first < mesh.n_owned_nodes; first += k_portion) {
    const Index last = std::min(mesh.n_owned_nodes, first + k_portion);
    const FacesOfNodes faces = faces_of_nodes(mesh, first, last);
    for (std::size_t n = 0; n + 1 < faces.start.size(); ++n) {
      of_node.clear();
      for (std::size_t k = faces.start[n]; k < faces.start[n + 1]; ++k)
        of_node.push_back(face_at(mesh, faces.places[k]));
      std::sort(of_node.begin(), of_node.end());
      measure_alone(mesh, kind, of_node, bodies);
    }
  }
}

/// Volume of an element [m³].
double volume_of(const mesh::BlockGeometry& geometry, Index element) {
  double volume = 0;
  for (int p = 0; p < geometry.n_points; ++p)
    volume += geometry.weight_at(element / k_lanes, p)[element % k_lanes];
  return volume;
}

void measure_block(const mesh::Mesh& mesh, AnalysisKind kind, const mesh::ElementBlock& block,
                   BodyMeasures& body, double& edges, double& n_edges) {
  const mesh::BlockGeometry geometry(mesh, block, kind, mesh::stiffness_rule(block.shape));
  for (Index e = 0; e < block.n_counted; ++e) {
    body.volume += volume_of(geometry, e);
    const mesh::Shape face = mesh::face_shape(block.shape);
    const int corners = mesh::vertex_count(face);
    double shortest = std::numeric_limits<double>::max(), longest = 0;
    for (int f = 0; f < mesh::face_count(block.shape); ++f)
      for (int i = 0; i < (corners == 2 ? 1 : corners); ++i) {
        const auto local = mesh::face_nodes(block.shape, f);
        const double length =
            distance(at(mesh, block.element(e)[local[static_cast<std::size_t>(i)]]),
                     at(mesh, block.element(e)[local[static_cast<std::size_t>((i + 1) % corners)]]));
        shortest = std::min(shortest, length);
        longest = std::max(longest, length);
        edges += length, ++n_edges;
      }
    body.shortest_edge = std::min(body.shortest_edge, shortest);
    body.longest_edge = std::max(body.longest_edge, longest);
    if (shortest > 0) body.flattest = std::max(body.flattest, longest / shortest);
  }
}

/// Boxes and numbers of nodes, those that bodies share included.
void measure_nodes(const mesh::Mesh& mesh, std::vector<BodyMeasures>& bodies) {
  std::vector<BodySet> of_node(mesh.x.size(), 0);
  for (const mesh::ElementBlock& block : mesh.blocks)
    for (const Index node : block.nodes) of_node[static_cast<std::size_t>(node)] |= bit(block.body);
  for (Index i = 0; i < mesh.n_owned_nodes; ++i)
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      const BodySet here = of_node[static_cast<std::size_t>(i)];
      if ((here & bit(static_cast<int>(b))) == 0) continue;
      ++bodies[b].nodes;
      for (std::size_t d = 0; d < 3; ++d) {
        bodies[b].low[d] = std::min(bodies[b].low[d], at(mesh, i)[d]);
        bodies[b].high[d] = std::max(bodies[b].high[d], at(mesh, i)[d]);
      }
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
  BodyMeasures none;
  none.low.fill(k_huge);
  none.high.fill(-k_huge);
  none.shortest_edge = k_huge;
  none.shared.assign(n, 0.0);
  none.shared_nodes.assign(n, 0);
  std::vector<BodyMeasures> bodies(n, none);
  std::vector<double> edges(n, 0.0), n_edges(n, 0.0);
  measure_nodes(mesh, bodies);
  measure_skins(mesh, kind, bodies);
  for (const mesh::ElementBlock& block : mesh.blocks) {
    const auto b = static_cast<std::size_t>(block.body);
    bodies[b].elements += block.n_counted;
    measure_block(mesh, kind, block, bodies[b], edges[b], n_edges[b]);
  }
  for (std::size_t b = 0; b < n; ++b) reduce(bodies[b], edges[b], n_edges[b]);
  return bodies;
}

double share_between(const mesh::Mesh& mesh, AnalysisKind kind, int body, const std::vector<char>& marked) {
  double all = 0, between = 0;
  for (const mesh::ElementBlock& block : mesh.blocks) {
    if (block.body != body) continue;
    const mesh::BlockGeometry geometry(mesh, block, kind, mesh::stiffness_rule(block.shape));
    for (Index e = 0; e < block.n_counted; ++e) {
      const double volume = volume_of(geometry, e);
      const Index* nodes = block.element(e);
      all += volume;
      if (std::all_of(nodes, nodes + mesh::node_count(block.shape),
                      [&](Index node) { return marked[static_cast<std::size_t>(node)] != 0; }))
        between += volume;
    }
  }
  all = parallel::global_sum(all);
  return all > 0 ? parallel::global_sum(between) / all : 0.0;
}

}  // namespace solidus::model
