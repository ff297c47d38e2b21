/// One search for each kind of fault. Places are compared by cells of a tolerance that follows from the
/// size of the mesh.
#include "mesh/surfaces/soundness.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <unordered_map>
#include <unordered_set>

#include "mesh/local_system.hpp"
#include "mesh/surfaces/face_walk.hpp"
#include "mesh/surfaces/faces.hpp"
#include "mesh/surfaces/vertex_sets.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mesh {

namespace {

Point middle(const RawMesh& mesh, const OuterFace& face) {
  return middle_of(mesh, std::span(face.nodes).first(as_size(vertex_count(face.shape))));
}

/// The diagonal of the box around a skin.
double extent_of_skin(const RawMesh& mesh, const std::vector<OuterFace>& skin) {
  Point low = point_of(mesh, skin[0].nodes[0]), high = low;
  for (const OuterFace& face : skin)
    for (const Index node : face.nodes)
      for (std::size_t i = 0; i < 3; ++i) {
        low[i] = std::min(low[i], point_of(mesh, node)[i]);
        high[i] = std::max(high[i], point_of(mesh, node)[i]);
      }
  return length_of(difference(high, low));
}

/// A length below which two points of a skin are one: rounding of files with six digits, and far below the
/// length of any edge.
double tolerance_of(const RawMesh& mesh, const std::vector<OuterFace>& skin) {
  double shortest = 1e300;
  for (const OuterFace& face : skin) {
    const int n = vertex_count(face.shape);
    for (int a = 0; a < n; ++a)
      for (int b = 0; b < a; ++b)
        shortest = std::min(shortest, length_of(difference(point_of(mesh, face.nodes[as_size(a)]),
                                                           point_of(mesh, face.nodes[as_size(b)]))));
  }
  constexpr double k_share = 1e-4, k_rounding = 1e-10;
  return std::max(k_share * shortest, k_rounding * extent_of_skin(mesh, skin));
}

/// Cells of a regular grid by their places.
class Cells {
 public:
  Cells(double size, const Point& origin) : size_(size), origin_(origin) {}

  /// Calls f(key) for the cells that a box touches.
  template <class Function>
  void for_each(const Point& low, const Point& high, Function f) const {
    std::array<std::int64_t, 3> from{}, to{};
    for (std::size_t i = 0; i < 3; ++i) {
      from[i] = static_cast<std::int64_t>(std::floor((low[i] - origin_[i]) / size_));
      to[i] = static_cast<std::int64_t>(std::floor((high[i] - origin_[i]) / size_));
    }
    for (std::int64_t x = from[0]; x <= to[0]; ++x)
      for (std::int64_t y = from[1]; y <= to[1]; ++y)
        for (std::int64_t z = from[2]; z <= to[2]; ++z) f((x * 73856093) ^ (y * 19349663) ^ (z * 83492791));
  }

 private:
  double size_;
  Point origin_;
};

Point moved(const Point& x, double by) {
  return {x[0] + by, x[1] + by, x[2] + by};
}

/// [node] of the nodes of a skin that are in one place the first one; −1 for nodes that are not of the skin.
/// Empty where no two are in one place.
std::vector<Index> first_in_place(const RawMesh& mesh, const std::vector<OuterFace>& skin, double tolerance) {
  std::vector<Index> first(mesh.x.size(), -1), nodes;
  for (const OuterFace& face : skin)
    for (const Index node : face.nodes)
      if (Index& f = first[as_size(node)]; f < 0) {
        f = node;
        nodes.push_back(node);
      }
  // Nodes come together by their cells, which are so large that hardly any node is near the rim of its own.
  constexpr double k_cell = 1000;
  const Cells cells(k_cell * tolerance, point_of(mesh, nodes[0]));
  std::vector<std::pair<std::int64_t, Index>> placed;  // (cell, position in nodes)
  for (std::size_t k = 0; k < nodes.size(); ++k)
    cells.for_each(point_of(mesh, nodes[k]), point_of(mesh, nodes[k]),
                   [&](std::int64_t key) { placed.emplace_back(key, as_index(k)); });
  std::ranges::sort(placed);
  // Each node looks for an earlier one within the tolerance.
  bool any = false;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const Point& x = point_of(mesh, nodes[k]);
    Index same = nodes[k];
    cells.for_each(moved(x, -tolerance), moved(x, tolerance), [&](std::int64_t key) {
      auto other = std::ranges::lower_bound(placed, std::pair<std::int64_t, Index>{key, 0});
      for (; other != placed.end() && other->first == key && other->second < as_index(k); ++other) {
        const Index node = nodes[as_size(other->second)];
        if (length_of(difference(point_of(mesh, node), x)) < tolerance)
          same = std::min(same, first[as_size(node)]);
      }
    });
    first[as_size(nodes[k])] = same;
    any = any || same != nodes[k];
  }
  return any ? first : std::vector<Index>{};
}

/// Whether a point lies in a face or an edge, away from its corners.
bool lies_in(const Point& x, const RawMesh& mesh, const OuterFace& face, double tolerance) {
  const int n = vertex_count(face.shape);
  const auto corner = [&](int a) -> const Point& { return point_of(mesh, face.nodes[as_size(a)]); };
  const auto in_segment = [&](const Point& a, const Point& b) {
    const Point ab = difference(b, a), ax = difference(x, a);
    const double length = length_of(ab), along = dot_product(ab, ax) / length;
    return along > tolerance && along < length - tolerance &&
           length_of(cross_product(ab, ax)) / length < tolerance;
  };
  if (n == 2) return in_segment(corner(0), corner(1));
  for (int a = 0; a < n; ++a)
    if (in_segment(corner(a), corner((a + 1) % n))) return true;
  for (int a = 1; a + 1 < n; ++a) {  // triangles of a fan
    const Point p = corner(0), u = difference(corner(a), p), v = difference(corner(a + 1), p),
                w = difference(x, p);
    const Point normal = cross_product(u, v);
    const double area = length_of(normal);
    if (!(area > 0) || std::abs(dot_product(normal, w)) / area > tolerance) continue;
    const double s = dot_product(cross_product(w, v), normal) / (area * area),
                 t = dot_product(cross_product(u, w), normal) / (area * area);
    if (s > 0 && t > 0 && s + t < 1) return true;
  }
  return false;
}

}  // namespace

// Elements are compared by their sets of vertices.
std::size_t drop_repeated(RawGroup& group) {
  std::vector<VertexSet> sets;
  append_element_vertex_sets(group, sets);
  const std::vector<Index> first_equal = first_equal_set(sets);
  const auto is_repeated = [&](std::size_t k) { return as_size(first_equal[k]) != k; };
  std::size_t dropped = 0;
  for (std::size_t k = 0; k < sets.size(); ++k) dropped += is_repeated(k) ? 1 : 0;
  if (dropped == 0) return 0;
  // What is there twice is left out of its block; blocks that become empty go.
  std::size_t k = 0;
  for (RawBlock& block : group.blocks) {
    const auto n = static_cast<std::ptrdiff_t>(node_count(block.shape));
    RawBlock kept{block.shape, {}, {}};
    for (std::size_t e = 0; e < block.nodes.size() / as_size(n); ++e) {
      if (is_repeated(k++)) continue;
      const auto first = block.nodes.begin() + static_cast<std::ptrdiff_t>(e) * n;
      kept.nodes.insert(kept.nodes.end(), first, first + n);
      if (!block.input_element.empty()) kept.input_element.push_back(block.input_element[e]);
    }
    block = std::move(kept);
  }
  std::erase_if(group.blocks, [](const RawBlock& block) { return block.nodes.empty(); });
  return dropped;
}

InnerFaces inner_faces(const RawMesh& mesh, const std::vector<std::string>& bodies,
                       const std::vector<std::vector<OuterFace>>& skins, const RawGroup& surface) {
  std::vector<char> on_surface(mesh.x.size(), 0);
  InnerFaces inner;
  std::unordered_set<FaceKey, FaceKeyHash> faces;
  for_each_element(surface, [&](std::span<const Index> nodes, std::span<const Index> vertices) {
    for (const Index node : nodes) on_surface[as_size(node)] = 1;
    faces.insert(face_key(vertices.data(), static_cast<int>(vertices.size())));
    ++inner.n_all;
  });
  const auto all_on_surface = [&](std::span<const Index> nodes) {
    return std::ranges::all_of(nodes, [&](Index i) { return on_surface[as_size(i)] != 0; });
  };
  // What is on the skin of a body is right, and that is all of most surfaces: their inside is not looked at.
  for (const std::vector<OuterFace>& skin : skins)
    for (const OuterFace& face : skin)
      if (const int n = vertex_count(face.shape); all_on_surface({face.nodes.data(), as_size(n)}))
        faces.erase(face_key(face.nodes.data(), n));
  if (faces.empty()) return inner;
  // Of the others those of a body's elements lie inside of it; the rest is on no body at all.
  std::unordered_set<FaceKey, FaceKeyHash> inside;
  for (const std::string& body : bodies)
    for_each_face(mesh, body, [&](std::span<const Index> vertices, const Face&) {
      if (!all_on_surface(vertices)) return;
      const FaceKey key = face_key(vertices.data(), static_cast<int>(vertices.size()));
      if (faces.contains(key)) inside.insert(key);
    });
  for_each_element(surface, [&](std::span<const Index>, std::span<const Index> vertices) {
    const int n = static_cast<int>(vertices.size());
    if (inside.contains(face_key(vertices.data(), n)) && inner.n++ == 0)
      inner.where = middle_of(mesh, vertices);
  });
  return inner;
}

Crack find_crack(const RawMesh& mesh, const std::vector<OuterFace>& skin,
                 const std::vector<char>& kept_apart) {
  Crack crack;
  if (skin.empty()) return crack;
  const double tolerance = tolerance_of(mesh, skin);
  if (!(tolerance > 0) || !std::isfinite(tolerance)) return crack;
  const std::vector<Index> first = first_in_place(mesh, skin, tolerance);
  if (first.empty()) return crack;
  // Faces of the skin by the first nodes in place of their own: two with one key lie in one place.
  std::unordered_map<FaceKey, const OuterFace*, FaceKeyHash> faces;
  std::vector<Index> nodes;
  for (const OuterFace& face : skin) {
    const bool apart = std::ranges::any_of(face.nodes, [&](Index i) { return kept_apart[as_size(i)] != 0; });
    if (apart) continue;
    nodes.clear();
    for (const Index i : face.nodes) nodes.push_back(first[as_size(i)]);
    const auto [other, is_new] = faces.emplace(face_key(nodes.data(), vertex_count(face.shape)), &face);
    if (is_new) continue;
    if (crack.n_pairs++ == 0) {
      crack.where = middle(mesh, face);
      crack.replaced.resize(mesh.x.size());
      std::iota(crack.replaced.begin(), crack.replaced.end(), 0);
    }
    // Their nodes are to be merged.
    for (const OuterFace* side : {other->second, &face})
      for (const Index i : side->nodes) crack.replaced[as_size(i)] = first[as_size(i)];
  }
  return crack;
}

void replace_nodes(RawMesh& mesh, const std::vector<Index>& replaced) {
  for (auto& [name, group] : mesh.groups)
    for (RawBlock& block : group.blocks)
      for (Index& node : block.nodes) node = replaced[as_size(node)];
  for (DrawnFace& face : mesh.drawn_faces)
    for (std::array<Index, 4>& facet : face.facets) {
      for (Index& node : facet)
        if (node >= 0) node = replaced[as_size(node)];
      std::ranges::sort(facet);
    }
}

HangingNodes hanging_nodes(const RawMesh& mesh, const std::vector<OuterFace>& skin,
                           const std::vector<char>& kept_apart) {
  HangingNodes hanging;
  if (skin.empty()) return hanging;
  const double tolerance = tolerance_of(mesh, skin);
  // Cells of the size of the faces.
  double size = 0;
  for (const OuterFace& face : skin)
    size += length_of(difference(point_of(mesh, face.nodes[1]), point_of(mesh, face.nodes[0])));
  size /= static_cast<double>(skin.size());
  constexpr double k_least = 1e-9;  // of the extent: more cells than that are none
  if (!(size > k_least * extent_of_skin(mesh, skin)) || !std::isfinite(size)) return hanging;
  // Corners of faces by cells.
  const Cells cells(2 * size, point_of(mesh, skin[0].nodes[0]));
  std::unordered_map<std::int64_t, std::vector<Index>> corners;
  std::unordered_set<Index> seen;
  for (const OuterFace& face : skin)
    for (int a = 0; a < vertex_count(face.shape); ++a)
      if (const Index node = face.nodes[as_size(a)];
          kept_apart[as_size(node)] == 0 && seen.insert(node).second)
        cells.for_each(point_of(mesh, node), point_of(mesh, node),
                       [&](std::int64_t key) { corners[key].push_back(node); });
  // A node within a face or edge that it is no corner of hangs there.
  std::unordered_set<Index> found;
  for (const OuterFace& face : skin) {
    Point low = point_of(mesh, face.nodes[0]), high = low;
    for (int a = 1; a < vertex_count(face.shape); ++a)
      for (std::size_t i = 0; i < 3; ++i) {
        low[i] = std::min(low[i], point_of(mesh, face.nodes[as_size(a)])[i]);
        high[i] = std::max(high[i], point_of(mesh, face.nodes[as_size(a)])[i]);
      }
    cells.for_each(moved(low, -tolerance), moved(high, tolerance), [&](std::int64_t key) {
      const auto there = corners.find(key);
      if (there == corners.end()) return;
      for (const Index node : there->second) {
        if (std::ranges::find(face.nodes, node) != face.nodes.end() || found.contains(node)) continue;
        const Point& x = point_of(mesh, node);
        bool near = true;
        for (std::size_t i = 0; i < 3; ++i)
          near = near && x[i] > low[i] - tolerance && x[i] < high[i] + tolerance;
        if (near && lies_in(x, mesh, face, tolerance)) found.insert(node);
      }
    });
  }
  hanging.n = found.size();
  if (!found.empty()) hanging.where = point_of(mesh, *std::ranges::min_element(found));
  return hanging;
}

// Disjoint sets of nodes: an element joins all of its own.
std::size_t n_pieces(const RawMesh& mesh, const std::string& body) {
  std::vector<Index> root(mesh.x.size(), -1);
  const auto find = [&](Index i) {
    while (root[as_size(i)] != i) {
      Index& up = root[as_size(i)];
      up = root[as_size(up)];
      i = up;
    }
    return i;
  };
  std::size_t pieces = 0;
  for (const RawBlock& block : mesh.groups.at(body).blocks) {
    const auto n = as_size(node_count(block.shape));
    for (std::size_t first = 0; first < block.nodes.size(); first += n) {
      for (std::size_t a = 0; a < n; ++a)
        if (Index& r = root[as_size(block.nodes[first + a])]; r < 0) {
          r = block.nodes[first + a];
          ++pieces;
        }
      for (std::size_t a = 1; a < n; ++a) {
        const Index one = find(block.nodes[first]), other = find(block.nodes[first + a]);
        if (one == other) continue;
        root[as_size(std::max(one, other))] = std::min(one, other);
        --pieces;
      }
    }
  }
  return pieces;
}

}  // namespace solidus::mesh
