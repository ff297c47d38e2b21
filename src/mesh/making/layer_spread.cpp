/// The body behind a wall follows by sweeps, in which each vertex takes the mean of its neighbours while
/// surfaces hold their vertices.
#include "mesh/making/layer_spread.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "numbers/index_casts.hpp"

namespace solidus::mesh {

namespace {

constexpr double k_one_plane = 1e-4;  ///< sine of the angle of normals that count as one

double dot(const Point& p, const Point& q) {
  return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
}

double normalise(Point& p) {
  const double length = std::sqrt(dot(p, p));
  if (length > 0)
    for (double& c : p) c /= length;
  return length;
}

/// The unit normal of a face, of either sign.
Point normal_of(const RawMesh& mesh, const WallFace& face) {
  const auto x = [&](std::size_t a) -> const Point& { return mesh.x[as_size(face.nodes[a])]; };
  Point s{}, t{};
  for (std::size_t i = 0; i < 3; ++i) s[i] = x(1)[i] - x(0)[i];
  Point n{-s[1], s[0], 0};
  if (face.n_vertices > 2) {
    for (std::size_t i = 0; i < 3; ++i) t[i] = x(2)[i] - x(0)[i];
    n = {s[1] * t[2] - s[2] * t[1], s[2] * t[0] - s[0] * t[2], s[0] * t[1] - s[1] * t[0]};
  }
  normalise(n);
  return n;
}

/// A number for the groups that each face of the boundary belongs to: equal where the groups are the same.
std::unordered_map<FaceKey, std::size_t, FaceKeyHash> groups_of_faces(const RawMesh& mesh) {
  std::unordered_map<FaceKey, std::size_t, FaceKeyHash> groups;
  std::size_t number = 0;
  for (const auto& [name, group] : mesh.groups) {
    ++number;
    if (group.dimension != mesh.dimension - 1) continue;
    for (const RawBlock& block : group.blocks) {
      const int n = vertex_count(block.shape);
      for (std::size_t f = 0; f < block.nodes.size(); f += as_size(node_count(block.shape))) {
        std::size_t& g = groups[face_key(block.nodes.data() + f, n)];
        g = g * 0x9E3779B97F4A7C15ULL + number;
      }
    }
  }
  return groups;
}

}  // namespace

LayerSpread::LayerSpread(const RawMesh& mesh, const RawGroup& body, const WallTopology& wall) {
  find_neighbours(mesh, body);
  find_guides(mesh, body, wall);
  find_owners(wall);
}

void LayerSpread::find_neighbours(const RawMesh& mesh, const RawGroup& body) {
  // All edges in both directions, each once; they weigh the inverse of their length.
  std::vector<Edge> edges;
  for (const RawBlock& block : body.blocks) {
    const std::vector<LocalEdge> local = edges_of(block.shape);
    for (std::size_t e = 0; e < block.nodes.size(); e += as_size(node_count(block.shape)))
      for (const LocalEdge& l : local) {
        const Index a = block.nodes[e + as_size(l.a)], b = block.nodes[e + as_size(l.b)];
        edges.emplace_back(a, b);
        edges.emplace_back(b, a);
      }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  // Compressed rows of neighbours, in the order of the sorted edges.
  first_.assign(mesh.x.size() + 1, 0);
  // Rows and weights in one pass, since the edges are sorted by their first node.
  for (const auto& [a, b] : edges) {
    ++first_[as_size(a) + 1];
    neighbour_.push_back(b);
    Point d{};
    for (std::size_t i = 0; i < 3; ++i) d[i] = mesh.x[as_size(b)][i] - mesh.x[as_size(a)][i];
    weight_.push_back(1 / std::max(std::sqrt(dot(d, d)), 1e-30));
  }
  for (std::size_t i = 0; i < mesh.x.size(); ++i) first_[i + 1] += first_[i];
}

void LayerSpread::find_guides(const RawMesh& mesh, const RawGroup& body, const WallTopology& wall) {
  // Nodes behind a layer move to make room for it. Nodes on the boundary of the body may move along it only:
  // a guide says along which planes.
  const auto groups = groups_of_faces(mesh);
  struct Plane {
    Point normal;
    std::size_t groups;
  };
  std::map<Index, std::vector<Plane>> planes;
  std::map<Index, Guide> guides;
  // The planes at a node are those of the faces around it, each once, in which normals count as one within a
  // small angle.
  for (const WallFace& face : wall.boundary) {
    const Point normal = normal_of(mesh, face);
    const auto found = groups.find(face_key(face.nodes.data(), face.n_vertices));
    const std::size_t of = found == groups.end() ? 0 : found->second;
    for (int a = 0; a < face.n_vertices; ++a) {
      const Index node = face.nodes[as_size(a)];
      if (wall.on_wall[as_size(node)] != 0) continue;
      Guide& guide = guides[node];
      std::vector<Plane>& known = planes[node];
      const auto same = std::find_if(known.begin(), known.end(), [&](const Plane& p) {
        return std::abs(dot(p.normal, normal)) > 1 - 0.5 * k_one_plane * k_one_plane;
      });
      if (same != known.end()) {
        // Where two groups of faces meet in one plane the node is held, since the border between the groups
        // would move.
        if (same->groups != of) guide.fixed = true;
        continue;
      }
      known.push_back({normal, of});
      // The normals are made orthogonal to each other, so that a motion loses its part along each of them.
      Point rest = normal;
      for (const Point& n : guide.normals)
        for (std::size_t i = 0; i < 3; ++i) rest[i] -= dot(normal, n) * n[i];
      if (normalise(rest) > k_one_plane) guide.normals.push_back(rest);
    }
  }
  // A node with as many normals as dimensions is a corner, and a node of another body does not move either.
  for (auto& [node, guide] : guides)
    if (guide.normals.size() >= as_size(mesh.dimension)) guide.fixed = true;
  for (const auto& [name, group] : mesh.groups) {
    if (group.dimension != mesh.dimension || &group == &body) continue;
    for (const RawBlock& block : group.blocks)
      for (const Index node : block.nodes)
        if (const auto guide = guides.find(node); guide != guides.end()) guide->second.fixed = true;
  }
  // All other nodes of the body that are not on the wall move, with the guide that they have.
  for (std::size_t i = 0; i < mesh.x.size(); ++i) {
    if (first_[i] == first_[i + 1] || wall.on_wall[i] != 0) continue;
    const auto guide = guides.find(as_index(i));
    if (guide != guides.end() && guide->second.fixed) continue;
    moving_.push_back(as_index(i));
    guide_of_.push_back(guide == guides.end() ? -1 : static_cast<int>(guides_.size()));
    if (guide != guides.end()) guides_.push_back(guide->second);
  }
}

void LayerSpread::find_owners(const WallTopology& wall) {
  owner_.assign(wall.on_wall.size(), -1);
  std::vector<Index> front;
  for (std::size_t i = 0; i < wall.on_wall.size(); ++i)
    if (wall.on_wall[i] != 0) front.push_back(owner_[i] = as_index(i));
  for (std::size_t next = 0; next < front.size(); ++next) {
    const Index node = front[next];
    for (Index k = first_[as_size(node)]; k < first_[as_size(node) + 1]; ++k) {
      const Index other = neighbour_[as_size(k)];
      if (owner_[as_size(other)] >= 0) continue;
      owner_[as_size(other)] = owner_[as_size(node)];
      front.push_back(other);
    }
  }
}

void LayerSpread::sweep(std::vector<Point>& u, int n_sweeps) const {
  // Gauss-Seidel sweeps: each node takes the weighted mean of its neighbours, without what its guides forbid.
  for (int sweep = 0; sweep < n_sweeps; ++sweep)
    for (std::size_t m = 0; m < moving_.size(); ++m) {
      const Index node = moving_[m];
      Point sum{};
      double weights = 0;
      for (Index k = first_[as_size(node)]; k < first_[as_size(node) + 1]; ++k) {
        weights += weight_[as_size(k)];
        for (std::size_t i = 0; i < 3; ++i)
          sum[i] += weight_[as_size(k)] * u[as_size(neighbour_[as_size(k)])][i];
      }
      for (double& c : sum) c /= weights;
      // Nodes on planes and rims keep to them.
      if (guide_of_[m] >= 0)
        for (const Point& n : guides_[as_size(guide_of_[m])].normals) {
          const double across = dot(sum, n);
          for (std::size_t i = 0; i < 3; ++i) sum[i] -= across * n[i];
        }
      u[as_size(node)] = sum;
    }
}

}  // namespace solidus::mesh
