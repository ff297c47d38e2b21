/// Faces that one element alone has make the skin; rays from points count how often they cross it.
#include "mesh/surfaces/body_skin.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "mesh/local_system.hpp"
#include "mesh/surfaces/face_walk.hpp"
#include "mesh/surfaces/vertex_sets.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mesh {

namespace {

/// The number of faces of all elements, those between two elements counted twice.
std::size_t count_faces(const RawGroup& group) {
  std::size_t n = 0;
  for (const RawBlock& block : group.blocks)
    n += block.nodes.size() / as_size(node_count(block.shape)) * as_size(face_count(block.shape));
  return n;
}

/// The middles of some forty elements of a group, from its first to its last.
std::vector<Point> middles_of_some(const RawMesh& mesh, const RawGroup& group) {
  std::vector<Point> middles;
  constexpr std::size_t k_samples = 40;
  for (const RawBlock& block : group.blocks) {
    const auto n = as_size(node_count(block.shape)), n_elements = block.nodes.size() / n;
    const std::size_t step = std::max<std::size_t>(1, n_elements / k_samples);
    const auto n_vertices = as_size(vertex_count(block.shape));
    for (std::size_t e = 0; e < n_elements; e += step)
      middles.push_back(middle_of(mesh, std::span(block.nodes).subspan(e * n, n_vertices)));
  }
  return middles;
}

/// Counts how often a half-line from a point crosses a skin: an odd number of times from its inside.
class RayCount {
 public:
  RayCount(const RawMesh& mesh, const std::vector<OuterFace>& skin) : mesh_(mesh), skin_(skin) {
    // The direction has no meaning, so that hardly any half-line meets an edge. Seen along it a face covers a
    // small part of the plane: only faces whose shadow holds the point's are looked at.
    ray_ = mesh.dimension == 2 ? Point{0.8191, 0.5736, 0} : Point{0.5771, 0.3119, 0.7548};
    across_[0] = {-ray_[1], ray_[0], 0};
    across_[1] = mesh.dimension == 2 ? Point{} : cross_product(ray_, across_[0]);
    for (const OuterFace& face : skin) {
      Shadow& shadow = shadows_.emplace_back();
      for (const Index node : face.nodes)
        for (std::size_t i = 0; i < 2; ++i) {
          const double s = dot_product(across_[i], point_of(mesh, node));
          shadow.low[i] = std::min(shadow.low[i], s);
          shadow.high[i] = std::max(shadow.high[i], s);
        }
    }
  }

  int crossings(const Point& x) const {
    const std::array<double, 2> s{dot_product(across_[0], x), dot_product(across_[1], x)};
    int n = 0;
    for (std::size_t k = 0; k < shadows_.size(); ++k)
      if (shadows_[k].holds(s))
        n += vertex_count(skin_[k].shape) == 2 ? crosses_edge(x, skin_[k]) : crosses_face(x, skin_[k]);
    return n;
  }

 private:
  /// The bounds of a face in the plane across the ray.
  struct Shadow {
    static constexpr double k_none = std::numeric_limits<double>::max();
    std::array<double, 2> low{k_none, k_none}, high{-k_none, -k_none};
    bool holds(const std::array<double, 2>& s) const {
      return s[0] >= low[0] && s[0] <= high[0] && s[1] >= low[1] && s[1] <= high[1];
    }
  };

  /// Whether the half-line meets an edge of a plane body: both lines' parameters from a 2 × 2 system.
  int crosses_edge(const Point& x, const OuterFace& edge) const {
    const Point& p = point_of(mesh_, edge.nodes[0]);
    const Point u = difference(point_of(mesh_, edge.nodes[1]), p), w = difference(p, x);
    const double d = ray_[0] * u[1] - ray_[1] * u[0];
    if (d == 0) return 0;
    const double along = (w[0] * u[1] - w[1] * u[0]) / d, share = (w[0] * ray_[1] - w[1] * ray_[0]) / d;
    return along > 0 && share >= 0 && share < 1 ? 1 : 0;
  }

  /// Of the triangles of a fan around the first corner.
  int crosses_face(const Point& x, const OuterFace& face) const {
    const Point& p = point_of(mesh_, face.nodes[0]);
    int n = 0;
    for (std::size_t a = 1; a + 1 < as_size(vertex_count(face.shape)); ++a) {
      const Point u = difference(point_of(mesh_, face.nodes[a]), p),
                  v = difference(point_of(mesh_, face.nodes[a + 1]), p), w = difference(x, p);
      const Point h = cross_product(ray_, v);
      const double d = dot_product(u, h);
      if (d == 0) continue;
      const Point q = cross_product(w, u);
      const double s = dot_product(w, h) / d, t = dot_product(ray_, q) / d;
      if (s >= 0 && t >= 0 && s + t < 1 && dot_product(v, q) / d > 0) ++n;
    }
    return n;
  }

  const RawMesh& mesh_;
  const std::vector<OuterFace>& skin_;
  Point ray_{};
  std::array<Point, 2> across_{};
  std::vector<Shadow> shadows_;
};

}  // namespace

std::vector<Face> outer_faces(const RawMesh& mesh, const std::string& body) {
  // Faces are equal where their vertices are; the numbers of equal sets are found by sorting. What two
  // elements have is inside, what one has alone is outside.
  std::vector<VertexSet> sets;
  sets.reserve(count_faces(mesh.groups.at(body)));
  for_each_face(mesh, body,
                [&](std::span<const Index> vertices, const Face&) { sets.push_back(vertex_set(vertices)); });
  const std::vector<Index> first = first_equal_set(sets);
  std::vector<char> shared(sets.size(), 0);
  for (std::size_t k = 0; k < sets.size(); ++k)
    if (const auto other = as_size(first[k]); other != k) shared[k] = shared[other] = 1;
  std::vector<Face> outer;
  std::size_t k = 0;
  for_each_face(mesh, body, [&](std::span<const Index>, const Face& face) {
    if (shared[k++] == 0) outer.push_back(face);
  });
  return outer;
}

std::vector<OuterFace> faces_on_skin(const RawMesh& mesh, const std::string& body) {
  std::vector<OuterFace> skin;
  for (const Face& face : outer_faces(mesh, body)) skin.push_back({face.shape, face.nodes()});
  return skin;
}

double share_inside(const RawMesh& mesh, const std::string& body, const std::vector<OuterFace>& skin) {
  const std::vector<Point> samples = middles_of_some(mesh, mesh.groups.at(body));
  if (samples.empty() || skin.empty()) return 0;
  const RayCount rays(mesh, skin);
  const auto inside =
      std::ranges::count_if(samples, [&](const Point& x) { return rays.crossings(x) % 2 == 1; });
  return static_cast<double>(inside) / static_cast<double>(samples.size());
}

}  // namespace solidus::mesh
