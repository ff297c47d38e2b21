#include "mesh/soundness.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <unordered_map>
#include <unordered_set>

#include "mesh/body_partition.hpp"
#include "mesh/faces.hpp"
#include "mesh/local_system.hpp"

namespace solidus::mesh {

namespace {

const Point& at(const RawMesh& mesh, Index node) {
  return mesh.x[static_cast<std::size_t>(node)];
}

Point middle(const RawMesh& mesh, const Index* nodes, int n) {
  Point c{};
  for (int a = 0; a < n; ++a)
    for (std::size_t i = 0; i < 3; ++i) c[i] += at(mesh, nodes[a])[i] / n;
  return c;
}
Point middle(const RawMesh& mesh, const BodyFace& face) {
  return middle(mesh, face.nodes.data(), vertex_count(face.shape));
}

/// Calls f(block, element, face number, its nodes) for all faces of the elements of a body.
template <class Function>
void for_each_face(const RawMesh& mesh, const std::string& body, Function f) {
  std::vector<Index> nodes;
  for (const RawBlock& block : mesh.groups.at(body).blocks) {
    const auto n = static_cast<std::size_t>(node_count(block.shape));
    for (std::size_t e = 0; e * n < block.nodes.size(); ++e)
      for (int k = 0; k < face_count(block.shape); ++k) {
        nodes.clear();
        for (const int a : face_nodes(block.shape, k))
          nodes.push_back(block.nodes[e * n + static_cast<std::size_t>(a)]);
        f(face_shape(block.shape), nodes);
      }
  }
}

/// The diagonal of the box around a skin.
double extent_of_skin(const RawMesh& mesh, const std::vector<BodyFace>& skin) {
  Point low = at(mesh, skin[0].nodes[0]), high = low;
  for (const BodyFace& face : skin)
    for (const Index node : face.nodes)
      for (std::size_t i = 0; i < 3; ++i) {
        low[i] = std::min(low[i], at(mesh, node)[i]);
        high[i] = std::max(high[i], at(mesh, node)[i]);
      }
  return length_of(difference(high, low));
}

/// A length below which two points of a skin are one: rounding of files with six digits, and far below the
/// length of any edge.
double tolerance_of(const RawMesh& mesh, const std::vector<BodyFace>& skin) {
  double shortest = 1e300;
  for (const BodyFace& face : skin) {
    const int n = vertex_count(face.shape);
    for (int a = 0; a < n; ++a)
      for (int b = 0; b < a; ++b)
        shortest =
            std::min(shortest, length_of(difference(at(mesh, face.nodes[static_cast<std::size_t>(a)]),
                                                    at(mesh, face.nodes[static_cast<std::size_t>(b)]))));
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

/// Whether a point lies in a face or an edge, away from its corners.
bool lies_in(const Point& x, const RawMesh& mesh, const BodyFace& face, double tolerance) {
  const int n = vertex_count(face.shape);
  const auto corner = [&](int a) -> const Point& {
    return at(mesh, face.nodes[static_cast<std::size_t>(a)]);
  };
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

std::size_t drop_repeated(RawGroup& group) {
  const std::vector<std::uint64_t> keys = element_keys(group);
  std::vector<std::uint64_t> sorted = keys;
  std::ranges::sort(sorted);
  if (std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end()) return 0;
  std::unordered_set<std::uint64_t> seen;
  std::size_t dropped = 0, k = 0;
  for (RawBlock& block : group.blocks) {
    const auto n = static_cast<std::ptrdiff_t>(node_count(block.shape));
    RawBlock kept{block.shape, {}, {}};
    for (std::size_t e = 0; e < block.nodes.size() / static_cast<std::size_t>(n); ++e) {
      if (!seen.insert(keys[k++]).second) {
        ++dropped;
        continue;
      }
      const auto first = block.nodes.begin() + static_cast<std::ptrdiff_t>(e) * n;
      kept.nodes.insert(kept.nodes.end(), first, first + n);
      if (!block.input_element.empty()) kept.input_element.push_back(block.input_element[e]);
    }
    block = std::move(kept);
  }
  std::erase_if(group.blocks, [](const RawBlock& block) { return block.nodes.empty(); });
  return dropped;
}

std::vector<BodyFace> faces_on_skin(const RawMesh& mesh, const std::string& body) {
  std::vector<std::uint64_t> keys;
  for_each_face(mesh, body, [&](Shape shape, const std::vector<Index>& nodes) {
    keys.push_back(FaceKeyHash()(face_key(nodes.data(), vertex_count(shape))));
  });
  std::vector<std::uint64_t> sorted = keys;
  std::ranges::sort(sorted);
  const auto is_single = [&](std::uint64_t key) {
    const auto range = std::equal_range(sorted.begin(), sorted.end(), key);
    return range.second - range.first == 1;
  };
  std::vector<BodyFace> skin;
  std::size_t k = 0;
  for_each_face(mesh, body, [&](Shape shape, const std::vector<Index>& nodes) {
    if (is_single(keys[k++])) skin.push_back({shape, nodes});
  });
  return skin;
}

InnerFaces inner_faces(const RawMesh& mesh, const std::vector<std::string>& bodies, const RawGroup& surface) {
  std::vector<char> marked(mesh.x.size(), 0);
  InnerFaces inner;
  for (const RawBlock& block : surface.blocks) {
    for (const Index node : block.nodes) marked[static_cast<std::size_t>(node)] = 1;
    inner.n_all += block.nodes.size() / static_cast<std::size_t>(node_count(block.shape));
  }
  std::unordered_set<FaceKey, FaceKeyHash> twice;
  for (const std::string& body : bodies) {
    std::unordered_set<FaceKey, FaceKeyHash> once;
    for_each_face(mesh, body, [&](Shape shape, const std::vector<Index>& nodes) {
      const int n = vertex_count(shape);
      if (!std::all_of(nodes.begin(), nodes.begin() + n,
                       [&](Index i) { return marked[static_cast<std::size_t>(i)] != 0; }))
        return;
      const FaceKey key = face_key(nodes.data(), n);
      if (!once.insert(key).second) twice.insert(key);
    });
  }
  for (const RawBlock& block : surface.blocks) {
    const auto n = static_cast<std::size_t>(node_count(block.shape));
    const int vertices = vertex_count(block.shape);
    for (std::size_t first = 0; first < block.nodes.size(); first += n)
      if (twice.contains(face_key(block.nodes.data() + first, vertices)) && inner.n++ == 0)
        inner.where = middle(mesh, block.nodes.data() + first, vertices);
  }
  return inner;
}

Crack find_crack(const RawMesh& mesh, const std::vector<BodyFace>& skin,
                 const std::vector<char>& kept_apart) {
  Crack crack;
  if (skin.empty()) return crack;
  const double tolerance = tolerance_of(mesh, skin);
  if (!(tolerance > 0) || !std::isfinite(tolerance)) return crack;
  // Of nodes in one place the first one stands for all.
  constexpr double k_cell = 1000;
  const Cells cells(k_cell * tolerance, at(mesh, skin[0].nodes[0]));
  std::unordered_map<std::int64_t, std::vector<Index>> in_cell;
  std::unordered_map<Index, Index> first;
  bool any = false;
  for (const BodyFace& face : skin)
    for (const Index node : face.nodes) {
      if (first.contains(node)) continue;
      const Point& x = at(mesh, node);
      Index same = node;
      cells.for_each(moved(x, -tolerance), moved(x, tolerance), [&](std::int64_t key) {
        for (const Index other : in_cell[key])
          if (length_of(difference(at(mesh, other), x)) < tolerance) same = std::min(same, first.at(other));
      });
      first[node] = same;
      any = any || same != node;
      cells.for_each(x, x, [&](std::int64_t key) { in_cell[key].push_back(node); });
    }
  if (!any) return crack;
  std::unordered_map<FaceKey, const BodyFace*, FaceKeyHash> faces;
  std::vector<Index> nodes;
  for (const BodyFace& face : skin) {
    const bool apart = std::ranges::any_of(
        face.nodes, [&](Index i) { return kept_apart[static_cast<std::size_t>(i)] != 0; });
    if (apart) continue;
    nodes.clear();
    for (const Index i : face.nodes) nodes.push_back(first.at(i));
    const auto [other, is_new] = faces.emplace(face_key(nodes.data(), vertex_count(face.shape)), &face);
    if (is_new) continue;
    if (crack.n_pairs++ == 0) {
      crack.where = middle(mesh, face);
      crack.replaced.resize(mesh.x.size());
      std::iota(crack.replaced.begin(), crack.replaced.end(), 0);
    }
    for (const BodyFace* side : {other->second, &face})
      for (const Index i : side->nodes) crack.replaced[static_cast<std::size_t>(i)] = first.at(i);
  }
  return crack;
}

void replace_nodes(RawMesh& mesh, const std::vector<Index>& replaced) {
  for (auto& [name, group] : mesh.groups)
    for (RawBlock& block : group.blocks)
      for (Index& node : block.nodes) node = replaced[static_cast<std::size_t>(node)];
  for (DrawnFace& face : mesh.drawn_faces)
    for (std::array<Index, 4>& facet : face.facets) {
      for (Index& node : facet)
        if (node >= 0) node = replaced[static_cast<std::size_t>(node)];
      std::ranges::sort(facet);
    }
}

HangingNodes hanging_nodes(const RawMesh& mesh, const std::vector<BodyFace>& skin,
                           const std::vector<char>& kept_apart) {
  HangingNodes hanging;
  if (skin.empty()) return hanging;
  const double tolerance = tolerance_of(mesh, skin);
  // Cells of the size of the faces.
  double size = 0;
  for (const BodyFace& face : skin)
    size += length_of(difference(at(mesh, face.nodes[1]), at(mesh, face.nodes[0])));
  size /= static_cast<double>(skin.size());
  constexpr double k_least = 1e-9;  // of the extent: more cells than that are none
  if (!(size > k_least * extent_of_skin(mesh, skin)) || !std::isfinite(size)) return hanging;
  const Cells cells(2 * size, at(mesh, skin[0].nodes[0]));
  std::unordered_map<std::int64_t, std::vector<Index>> corners;
  std::unordered_set<Index> seen;
  for (const BodyFace& face : skin)
    for (int a = 0; a < vertex_count(face.shape); ++a)
      if (const Index node = face.nodes[static_cast<std::size_t>(a)];
          kept_apart[static_cast<std::size_t>(node)] == 0 && seen.insert(node).second)
        cells.for_each(at(mesh, node), at(mesh, node),
                       [&](std::int64_t key) { corners[key].push_back(node); });
  std::unordered_set<Index> found;
  for (const BodyFace& face : skin) {
    Point low = at(mesh, face.nodes[0]), high = low;
    for (int a = 1; a < vertex_count(face.shape); ++a)
      for (std::size_t i = 0; i < 3; ++i) {
        low[i] = std::min(low[i], at(mesh, face.nodes[static_cast<std::size_t>(a)])[i]);
        high[i] = std::max(high[i], at(mesh, face.nodes[static_cast<std::size_t>(a)])[i]);
      }
    cells.for_each(moved(low, -tolerance), moved(high, tolerance), [&](std::int64_t key) {
      const auto there = corners.find(key);
      if (there == corners.end()) return;
      for (const Index node : there->second) {
        if (std::ranges::find(face.nodes, node) != face.nodes.end() || found.contains(node)) continue;
        const Point& x = at(mesh, node);
        bool near = true;
        for (std::size_t i = 0; i < 3; ++i)
          near = near && x[i] > low[i] - tolerance && x[i] < high[i] + tolerance;
        if (near && lies_in(x, mesh, face, tolerance)) found.insert(node);
      }
    });
  }
  hanging.n = found.size();
  if (!found.empty()) hanging.where = at(mesh, *std::ranges::min_element(found));
  return hanging;
}

std::size_t n_pieces(const RawMesh& mesh, const std::string& body) {
  std::vector<Index> root(mesh.x.size(), -1);
  const auto find = [&](Index i) {
    while (root[static_cast<std::size_t>(i)] != i) {
      Index& up = root[static_cast<std::size_t>(i)];
      up = root[static_cast<std::size_t>(up)];
      i = up;
    }
    return i;
  };
  std::size_t pieces = 0;
  for (const RawBlock& block : mesh.groups.at(body).blocks) {
    const auto n = static_cast<std::size_t>(node_count(block.shape));
    for (std::size_t first = 0; first < block.nodes.size(); first += n) {
      for (std::size_t a = 0; a < n; ++a)
        if (Index& r = root[static_cast<std::size_t>(block.nodes[first + a])]; r < 0) {
          r = block.nodes[first + a];
          ++pieces;
        }
      for (std::size_t a = 1; a < n; ++a) {
        const Index one = find(block.nodes[first]), other = find(block.nodes[first + a]);
        if (one == other) continue;
        root[static_cast<std::size_t>(std::max(one, other))] = std::min(one, other);
        --pieces;
      }
    }
  }
  return pieces;
}

double share_inside(const RawMesh& mesh, const std::string& body, const std::vector<BodyFace>& skin) {
  std::vector<Point> middles;
  for (const RawBlock& block : mesh.groups.at(body).blocks) {
    const auto n = static_cast<std::size_t>(node_count(block.shape)), n_elements = block.nodes.size() / n;
    constexpr std::size_t k_samples = 40;
    const std::size_t step = std::max<std::size_t>(1, n_elements / k_samples);
    for (std::size_t e = 0; e < n_elements; e += step)
      middles.push_back(middle(mesh, block.nodes.data() + e * n, vertex_count(block.shape)));
  }
  // A line in a direction of no meaning crosses the skin an odd number of times.
  const Point ray = mesh.dimension == 2 ? Point{0.8191, 0.5736, 0} : Point{0.5771, 0.3119, 0.7548};
  std::size_t inside = 0;
  for (const Point& x : middles) {
    int crossings = 0;
    for (const BodyFace& face : skin) {
      const int n = vertex_count(face.shape);
      const Point& p = at(mesh, face.nodes[0]);
      if (n == 2) {
        const Point u = difference(at(mesh, face.nodes[1]), p), w = difference(p, x);
        const double d = ray[0] * u[1] - ray[1] * u[0];
        if (d == 0) continue;
        const double along = (w[0] * u[1] - w[1] * u[0]) / d, share = (w[0] * ray[1] - w[1] * ray[0]) / d;
        if (along > 0 && share >= 0 && share < 1) ++crossings;
        continue;
      }
      for (int a = 1; a + 1 < n; ++a) {
        const Point u = difference(at(mesh, face.nodes[static_cast<std::size_t>(a)]), p),
                    v = difference(at(mesh, face.nodes[static_cast<std::size_t>(a + 1)]), p),
                    w = difference(x, p);
        const Point h = cross_product(ray, v);
        const double d = dot_product(u, h);
        if (d == 0) continue;
        const Point q = cross_product(w, u);
        const double s = dot_product(w, h) / d, t = dot_product(ray, q) / d;
        if (s >= 0 && t >= 0 && s + t < 1 && dot_product(v, q) / d > 0) ++crossings;
      }
    }
    if (crossings % 2 == 1) ++inside;
  }
  return middles.empty() ? 0 : static_cast<double>(inside) / static_cast<double>(middles.size());
}

}  // namespace solidus::mesh
