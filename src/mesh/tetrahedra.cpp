/// Tetrahedra with a list of those around each node; changes replace a few of them and are put back if they
/// do not help.
#include "mesh/tetrahedra.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>

#include "mesh/shape.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mesh {

namespace {

Point minus(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

double squared(const Point& a) {
  return a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
}

Triangle sorted(Triangle t) {
  std::sort(t.begin(), t.end());
  return t;
}

}  // namespace

bool Tetrahedron::has(Index node) const {
  return std::find(nodes.begin(), nodes.end(), node) != nodes.end();
}

std::pair<Index, Index> Tetrahedron::beside(Index a, Index b) const {
  const Triangle face = across(a);
  for (std::size_t i = 0; i < 3; ++i)
    if (face[i] == b) return {face[(i + 1) % 3], face[(i + 2) % 3]};  // (a, face) has a positive volume
  assert(false);
  return {};
}

Triangle Tetrahedron::across(Index node) const {
  const auto& [a, b, c, d] = nodes;
  if (node == a) return {b, c, d};
  if (node == b) return {a, d, c};
  if (node == c) return {a, b, d};
  return {a, c, b};
}

double volume_6(const Point& a, const Point& b, const Point& c, const Point& d) {
  const Point u = minus(b, a), v = minus(c, a), w = minus(d, a);
  return u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) +
         u[2] * (v[0] * w[1] - v[1] * w[0]);
}

/// 12 (3 V)^(2/3) over the sum of the squared edges (A. Liu, B. Joe 1994), with the sign of the volume: 1 for
/// a regular tetrahedron, 0 for a flat one.
double mean_ratio(const Point& a, const Point& b, const Point& c, const Point& d) {
  const double edges = squared(minus(b, a)) + squared(minus(c, a)) + squared(minus(d, a)) +
                       squared(minus(c, b)) + squared(minus(d, b)) + squared(minus(d, c));
  if (!(edges > 0)) return 0;
  const double v = volume_6(a, b, c, d), cubic = std::cbrt(std::abs(v) / 2);
  return std::copysign(12 * cubic * cubic / edges, v);
}

Tetrahedra::Tetrahedra(RawMesh& mesh) : mesh_(mesh), locked_(mesh.x.size(), 0), around_(mesh.x.size()) {
  // Nodes of anything but tetrahedra may not move; tetrahedra are oriented.
  for (const auto& [name, group] : mesh.groups) {
    if (group.dimension == mesh.dimension) bodies_.push_back(name);
    for (const RawBlock& block : group.blocks) {
      const bool changes = group.dimension == 3 && mesh.dimension == 3 && block.shape == Shape::tet4;
      if (!changes) {
        for (const Index node : block.nodes) locked_[as_size(node)] = 1;
        continue;
      }
      for (std::size_t e = 0; e < block.nodes.size() / 4; ++e) {
        Tetrahedron tet;
        std::copy_n(block.nodes.begin() + static_cast<std::ptrdiff_t>(4 * e), 4, tet.nodes.begin());
        tet.body = static_cast<int>(bodies_.size()) - 1;
        if (volume_6(x(tet.nodes[0]), x(tet.nodes[1]), x(tet.nodes[2]), x(tet.nodes[3])) < 0)
          std::swap(tet.nodes[2], tet.nodes[3]);
        for (const Index node : tet.nodes) around_[as_size(node)].push_back(tets_.size());
        tets_.push_back(tet);
        number_.push_back(block.input_element.empty() ? 0 : block.input_element[e]);
        next_number_ = std::max(next_number_, number_.back() + 1);
      }
    }
  }
  alive_.assign(tets_.size(), 1);
}

void Tetrahedra::put_back() {
  // Tetrahedra that are left go back into the groups. All of a body go to its first block of tetrahedra,
  // other blocks get none.
  std::vector<char> used(mesh_.x.size(), 0);
  for (auto& [name, group] : mesh_.groups) {
    bool is_first = true;  // which gets all of them
    for (RawBlock& block : group.blocks) {
      if (group.dimension == 3 && block.shape == Shape::tet4) {
        const bool numbered = !block.input_element.empty();
        block.nodes.clear();
        block.input_element.clear();
        for (std::size_t t = 0; is_first && t < tets_.size(); ++t) {
          if (!is_alive(t) || bodies_[as_size(tets_[t].body)] != name) continue;
          block.nodes.insert(block.nodes.end(), tets_[t].nodes.begin(), tets_[t].nodes.end());
          if (numbered) block.input_element.push_back(number_[t]);
        }
        is_first = false;
      }
      for (const Index node : block.nodes) used[as_size(node)] = 1;
    }
  }
  // Nodes that nothing uses any more are dropped, and all others move up in their order.
  std::vector<Index> renumbered(mesh_.x.size(), -1);
  std::size_t n = 0;
  for (std::size_t i = 0; i < mesh_.x.size(); ++i) {
    if (used[i] == 0) continue;
    renumbered[i] = as_index(n);
    mesh_.x[n] = mesh_.x[i];
    if (!mesh_.input_node.empty()) mesh_.input_node[n] = mesh_.input_node[i];
    ++n;
  }
  mesh_.x.resize(n);
  // References follow the new numbers.
  if (!mesh_.input_node.empty()) mesh_.input_node.resize(n);
  for (auto& [name, group] : mesh_.groups)
    for (RawBlock& block : group.blocks)
      for (Index& node : block.nodes) node = renumbered[as_size(node)];
}

double Tetrahedra::quality(const std::array<Index, 4>& n) const {
  return mean_ratio(x(n[0]), x(n[1]), x(n[2]), x(n[3]));
}

/// Old tetrahedra stay in the list as dead ones, so that numbers of others remain; new ones get new numbers
/// in the input.
void Tetrahedra::replace(const std::vector<std::size_t>& old, const std::vector<Tetrahedron>& made) {
  for (const std::size_t t : old) {
    alive_[t] = 0;
    for (const Index node : tets_[t].nodes) std::erase(around_[as_size(node)], t);
  }
  for (const Tetrahedron& tet : made) {
    for (const Index node : tet.nodes) around_[as_size(node)].push_back(tets_.size());
    tets_.push_back(tet);
    number_.push_back(next_number_++);
    alive_.push_back(1);
  }
}

double quality(const Tetrahedra& tets, std::size_t t) {
  return tets.quality(tets[t].nodes);
}

/// The least quality of the tetrahedra at a node, by which a change there is judged.
double quality_around(const Tetrahedra& tets, Index node) {
  double least = 1;
  for (const std::size_t t : tets.around(node)) least = std::min(least, quality(tets, t));
  return least;
}

std::vector<std::size_t> around_edge(const Tetrahedra& tets, Index a, Index b) {
  std::vector<std::size_t> found;
  for (const std::size_t t : tets.around(a))
    if (tets[t].has(b)) found.push_back(t);
  return found;
}

std::set<Index> neighbours(const Tetrahedra& tets, Index node) {
  std::set<Index> all;
  for (const std::size_t t : tets.around(node)) all.insert(tets[t].nodes.begin(), tets[t].nodes.end());
  all.erase(node);
  return all;
}

std::vector<SurfaceFace> surface_at(const Tetrahedra& tets, Index node) {
  // Of the faces at the node those that one tetrahedron alone has, or two of different bodies.
  std::map<Triangle, std::vector<std::pair<int, Triangle>>> sides;
  for (const std::size_t t : tets.around(node))
    for (const Index other : tets[t].nodes)
      if (other != node) {
        const Triangle face = tets[t].across(other);
        sides[sorted(face)].emplace_back(tets[t].body, face);
      }
  std::vector<SurfaceFace> faces;
  for (const auto& [key, of] : sides) {
    if (of.size() == 1)
      faces.push_back({of[0].second, of[0].first, -1});
    else if (of[0].first != of[1].first)
      faces.push_back({of[0].second, of[0].first, of[1].first});
  }
  return faces;
}

}  // namespace solidus::mesh
