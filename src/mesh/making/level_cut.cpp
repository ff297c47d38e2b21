#include "mesh/making/level_cut.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "mesh/making/unused_parts.hpp"
#include "mesh/making/wall_topology.hpp"
#include "mesh/tetrahedra.hpp"
#include "numbers/index_casts.hpp"
#include "system/errors.hpp"

namespace solidus::mesh {

namespace {

using Corners = std::array<Index, 4>;
using Prism = std::array<Index, 6>;

Point between(const Point& a, const Point& b, double share) {
  return {a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]), a[2] + share * (b[2] - a[2])};
}

/// The six vertices of a prism in an order in which the least one comes first, and each of the upper triangle
/// stands over its own of the lower one.
Prism turned(const Prism& prism) {
  constexpr std::array<std::array<std::size_t, 6>, 6> k_order = {{{0, 1, 2, 3, 4, 5},
                                                                  {1, 2, 0, 4, 5, 3},
                                                                  {2, 0, 1, 5, 3, 4},
                                                                  {3, 5, 4, 0, 2, 1},
                                                                  {4, 3, 5, 1, 0, 2},
                                                                  {5, 4, 3, 2, 1, 0}}};
  const auto least = as_size(std::ranges::min_element(prism) - prism.begin());
  Prism result;
  for (std::size_t i = 0; i < 6; ++i) result[i] = prism[k_order[least][i]];
  return result;
}

/// Three tetrahedra for a prism: the diagonal of each of its quadrilaterals begins at the vertex of the least
/// number, so that the element on the other side draws the same one.
std::array<Corners, 3> split(const Prism& prism) {
  const Prism p = turned(prism);
  if (std::min(p[1], p[5]) < std::min(p[2], p[4]))
    return {{{p[0], p[1], p[2], p[5]}, {p[0], p[1], p[5], p[4]}, {p[0], p[4], p[5], p[3]}}};
  return {{{p[0], p[1], p[2], p[4]}, {p[0], p[4], p[2], p[5]}, {p[0], p[4], p[5], p[3]}}};
}

class LevelCut {
 public:
  LevelCut(RawMesh& mesh, const std::string& body, const LevelFunction& level, const std::string& source)
      : mesh_(mesh), body_(mesh.groups.at(body)), level_(level) {
    // All elements are looked at first, so that a mesh that cannot be cut is refused whole.
    for (const RawBlock& block : body_.blocks) {
      if (block.shape != Shape::tet4 && block.shape != Shape::tet10)
        throw InputError({source},
                         "the body '" + body + "' has elements of " + std::string(mesh::name(block.shape)) +
                             ", which cannot be cut into coats",
                         "tetrahedra");
      order_ = block.shape == Shape::tet10 ? 2 : order_;
    }
    read_tetrahedra();
    find_held_nodes(body);
  }

  void cut(RawGroup& below) {
    // The function is looked at once for each node of the body, as each look is a search for the nearest
    // face.
    for (std::size_t i = 0; i < mesh_.x.size(); ++i)
      if (!around_[i].empty()) value_[i] = level_(mesh_.x[i]);
    // The order matters: edges are split while nodes are where the mesher had them, planes are found in the
    // split mesh, and nodes move last, since a moved node changes both.
    split_edges_across();
    find_planes();
    draw_nodes_onto_surface();
    std::vector<Corners> lower, upper;
    for (const Corners& tet : tets_) cut(tet, lower, upper);
    find_middles();
    write(below, lower, true);
    write(body_, upper, false);
  }

 private:
  void read_tetrahedra() {
    around_.resize(mesh_.x.size());
    value_.assign(mesh_.x.size(), 0);
    for (const RawBlock& block : body_.blocks) {
      const auto n = as_size(node_count(block.shape));
      for (std::size_t e = 0; e < block.nodes.size(); e += n) {
        Corners tet;
        std::copy_n(block.nodes.begin() + static_cast<std::ptrdiff_t>(e), 4, tet.begin());
        // The lists of elements around each node make moving and splitting a matter of the neighbourhood.
        for (const Index node : tet) around_[as_size(node)].push_back(tets_.size());
        tets_.push_back(upright(tet));
      }
    }
    // New nodes and elements get numbers beyond all that the file has, so that no number names two things.
    last_node_ = *std::ranges::max_element(mesh_.input_node);
    for (const auto& [name, group] : mesh_.groups)
      for (const RawBlock& block : group.blocks)
        for (const GlobalIndex number : block.input_element) last_element_ = std::max(last_element_, number);
  }

  double volume(const Corners& t) const {
    return volume_6(mesh_.x[as_size(t[0])], mesh_.x[as_size(t[1])], mesh_.x[as_size(t[2])],
                    mesh_.x[as_size(t[3])]);
  }
  double quality(const Corners& t) const {
    return mean_ratio(mesh_.x[as_size(t[0])], mesh_.x[as_size(t[1])], mesh_.x[as_size(t[2])],
                      mesh_.x[as_size(t[3])]);
  }
  Corners upright(Corners tet) const {
    // The mesh may have elements that are inside out; two corners that change places set them right.
    if (volume(tet) < 0) std::swap(tet[2], tet[3]);
    return tet;
  }

  /// Nodes of other groups stay where they are, and so do the edges between them that these groups have.
  void find_held_nodes(const std::string& body) {
    held_.assign(mesh_.x.size(), 0);
    for (const auto& [name, group] : mesh_.groups) {
      // The body's own elements do not hold it, or nothing could move.
      if (name == body) continue;
      for (const RawBlock& block : group.blocks) {
        const auto n = as_size(node_count(block.shape));
        const std::vector<LocalEdge> edges = edges_of(block.shape);
        for (std::size_t e = 0; e < block.nodes.size(); e += n) {
          for (std::size_t a = 0; a < n; ++a) held_[as_size(block.nodes[e + a])] = 1;
          for (const LocalEdge& edge : edges) {
            const Index a = block.nodes[e + as_size(edge.a)], b = block.nodes[e + as_size(edge.b)];
            if (!around_[as_size(a)].empty() && !around_[as_size(b)].empty())
              held_edges_.insert(edge_key(a, b));
          }
        }
      }
    }
  }

  /// Edges both of whose ends lie on one side of the surface and the middle well on the other get a node
  /// there: elements that reach across a narrow space between two parts of the surface would fill it.
  void split_edges_across() {
    constexpr int k_passes = 3;
    constexpr double k_well = 0.1;  // of the edge
    // A split edge has halves that may reach across in their turn, which the next pass finds.
    for (int pass = 0; pass < k_passes; ++pass) {
      std::set<Edge> across;
      for (const Corners& tet : tets_)
        for (const auto& e : k_edges) {
          const Edge edge = edge_key(tet[e[0]], tet[e[1]]);
          // Held edges are left alone: a node in one would lie in the face of another group that does not
          // have it.
          if (value_[as_size(edge.first)] * value_[as_size(edge.second)] <= 0 || held_edges_.contains(edge))
            continue;
          const Point &a = mesh_.x[as_size(edge.first)], &b = mesh_.x[as_size(edge.second)];
          const double length = std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
          // The function changes by no more than the distance: most edges need no further look.
          if (std::abs(value_[as_size(edge.first)]) > length) continue;
          const double middle = level_(between(a, b, 0.5));
          if (middle * value_[as_size(edge.first)] < 0 && std::abs(middle) > k_well * length)
            across.insert(edge);
        }
      if (across.empty()) return;
      for (const Edge& edge : across) split_edge(edge);
    }
  }
  void split_edge(const Edge& edge) {
    const auto [a, b] = edge;
    // The new node belongs to no other group; it gets its value at once, for the next pass reads it.
    const Index middle = add_node(between(mesh_.x[as_size(a)], mesh_.x[as_size(b)], 0.5));
    value_.push_back(level_(mesh_.x.back()));
    held_.push_back(0);
    around_.emplace_back();
    // Every element at the edge is in the lists of both ends: the first end keeps its elements, and the
    // second one trades each of them for the new half.
    const std::vector<std::size_t> with_a = around_[as_size(a)];
    for (const std::size_t t : with_a) {
      if (std::ranges::find(tets_[t], b) == tets_[t].end()) continue;
      Corners other = tets_[t];
      // Each element at the edge becomes two: the old one keeps the first end, the new one the second, and
      // both get the middle.
      std::ranges::replace(tets_[t], b, middle);
      std::ranges::replace(other, a, middle);
      std::erase(around_[as_size(b)], t);
      around_[as_size(middle)].push_back(t);
      for (const Index node : other) around_[as_size(node)].push_back(tets_.size());
      tets_.push_back(other);
    }
  }

  /// Nodes on the outside of the mesh stay in the planes of the faces that they are in.
  void find_planes() {
    // A face that one element alone has is on the outside of the body.
    std::map<std::array<Index, 3>, int> count;
    constexpr std::array<std::array<std::size_t, 3>, 4> k_faces = {
        {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
    for (const Corners& tet : tets_)
      for (const auto& f : k_faces) {
        std::array<Index, 3> face = {tet[f[0]], tet[f[1]], tet[f[2]]};
        std::ranges::sort(face);
        ++count[face];
      }
    for (const auto& [face, n] : count) {
      if (n > 1) continue;
      const Point &a = mesh_.x[as_size(face[0])], &b = mesh_.x[as_size(face[1])],
                  &c = mesh_.x[as_size(face[2])];
      const Point u = {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, v = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
      Point normal = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
      const double length = std::hypot(normal[0], normal[1], normal[2]);
      for (double& component : normal) component /= length;
      for (const Index node : face) planes_[node].push_back(normal);
    }
  }

  bool may_go(Index node, const Point& along) const {
    constexpr double k_in_plane = 1e-9;
    if (held_[as_size(node)] != 0) return false;
    const auto planes = planes_.find(node);
    if (planes == planes_.end()) return true;
    // A step is allowed if it stays in all planes around the node, up to rounding in proportion to its
    // length: on an edge of the outside that leaves its direction, in a corner none.
    const double length = std::hypot(along[0], along[1], along[2]);
    return std::ranges::all_of(planes->second, [&](const Point& n) {
      return std::abs(n[0] * along[0] + n[1] * along[1] + n[2] * along[2]) <= k_in_plane * length;
    });
  }

  /// How far along the edge from a node below to one above the surface it is crossed, as a share, by halving.
  double crossing(Index below, Index above) const {
    constexpr int k_halvings = 20;
    double low = 0, high = 1;
    // After twenty halvings the place is known to a millionth of the edge, which is far below the size of any
    // element.
    for (int i = 0; i < k_halvings; ++i) {
      const double middle = 0.5 * (low + high);
      (level_(between(mesh_.x[as_size(below)], mesh_.x[as_size(above)], middle)) < 0 ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }

  /// Each node goes along the edge on which the surface is nearest, in the order of the nodes, unless an
  /// element around it would become poor by it.
  void draw_nodes_onto_surface() {
    constexpr double k_near = 0.3, k_least_quality = 0.2;
    for (std::size_t i = 0; i < mesh_.x.size(); ++i) {
      const auto node = as_index(i);
      if (around_[i].empty() || held_[i] != 0 || value_[i] == 0) continue;
      // Beyond this share of the edge a node would go too far: the edge is cut in place of that.
      double nearest = k_near;
      Point place = mesh_.x[i];
      std::set<Index> seen;
      for (const std::size_t t : around_[i])
        for (const Index other : tets_[t]) {
          // Only edges that the surface crosses count, each of them once.
          if (value_[as_size(other)] * value_[i] >= 0 || !seen.insert(other).second) continue;
          const bool is_below = value_[i] < 0;
          const double t_below = is_below ? crossing(node, other) : crossing(other, node);
          const double share = is_below ? t_below : 1 - t_below;
          const Point there = between(mesh_.x[i], mesh_.x[as_size(other)], share);
          const Point along = {there[0] - mesh_.x[i][0], there[1] - mesh_.x[i][1], there[2] - mesh_.x[i][2]};
          if (share < nearest && may_go(node, along)) nearest = share, place = there;
        }
      if (nearest == k_near) continue;
      // The node is moved for a trial; if an element around it becomes poor, it goes back and its edges are
      // cut.
      const Point before = std::exchange(mesh_.x[i], place);
      const bool sound = std::ranges::all_of(
          around_[i], [&](std::size_t t) { return quality(tets_[t]) >= k_least_quality; });
      if (sound)
        value_[i] = 0;
      else
        mesh_.x[i] = before;
    }
  }

  /// The node in which the surface crosses an edge: the lower end where that lies on it.
  Index cut_node(Index below, Index above) {
    // A node that lies on the surface counts as below; two elements at one edge share the node that cuts it,
    // so that no gap opens.
    if (value_[as_size(below)] == 0) return below;
    const auto [place, is_new] = cut_nodes_.emplace(edge_key(below, above), -1);
    if (is_new) {
      place->second = as_index(mesh_.x.size());
      const Point x = between(mesh_.x[as_size(below)], mesh_.x[as_size(above)], crossing(below, above));
      add_node(x);
    }
    return place->second;
  }
  Index add_node(const Point& x) {
    mesh_.x.push_back(x);
    mesh_.input_node.push_back(++last_node_);
    return as_index(mesh_.x.size()) - 1;
  }

  void cut(const Corners& tet, std::vector<Corners>& lower, std::vector<Corners>& upper) {
    std::vector<Index> below, above;
    bool any_below = false;
    for (const Index node : tet) {
      // A node on the surface can go with either side, and so it is a node below that decides whether the
      // element is cut.
      any_below = any_below || value_[as_size(node)] < 0;
      (value_[as_size(node)] <= 0 ? below : above).push_back(node);
    }
    // An element all of whose nodes lie on the surface goes to the side of its middle.
    if (above.empty() || !any_below) {
      bool is_below = any_below;
      if (above.empty() && !any_below) {
        Point middle{};
        for (const Index node : tet)
          for (std::size_t i = 0; i < 3; ++i) middle[i] += mesh_.x[as_size(node)][i] / 4;
        is_below = level_(middle) < 0;
      }
      (is_below ? lower : upper).push_back(tet);
      return;
    }
    // One vertex alone on its side is a tetrahedron and leaves a prism; two and two are two prisms.
    if (below.size() == 1) {
      const Index a = cut_node(below[0], above[0]), b = cut_node(below[0], above[1]),
                  c = cut_node(below[0], above[2]);
      keep(lower, Corners{below[0], a, b, c});
      keep(upper, Prism{a, b, c, above[0], above[1], above[2]});
    } else if (above.size() == 1) {
      const Index a = cut_node(below[0], above[0]), b = cut_node(below[1], above[0]),
                  c = cut_node(below[2], above[0]);
      keep(upper, Corners{above[0], a, b, c});
      keep(lower, Prism{below[0], below[1], below[2], a, b, c});
    } else {
      const Index ik = cut_node(below[0], above[0]), il = cut_node(below[0], above[1]),
                  jk = cut_node(below[1], above[0]), jl = cut_node(below[1], above[1]);
      keep(lower, Prism{below[0], ik, il, below[1], jk, jl});
      keep(upper, Prism{above[0], ik, jk, above[1], il, jl});
    }
  }
  /// Elements of which two vertices are one have no volume.
  void keep(std::vector<Corners>& side, const Corners& tet) {
    // Such elements come from nodes that lie on the surface themselves, and their neighbours close the space
    // without them.
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t b = 0; b < a; ++b)
        if (tet[a] == tet[b]) return;
    side.push_back(upright(tet));
  }
  void keep(std::vector<Corners>& side, const Prism& prism) {
    for (const Corners& tet : split(prism)) keep(side, tet);
  }

  /// The nodes in the middles of the edges of all second-order tetrahedra, as they were.
  void find_middles() {
    if (order_ == 1) return;
    // Middles of all groups are known first, so that faces of other groups keep the nodes that they have.
    for (const auto& [name, group] : mesh_.groups)
      for (const RawBlock& block : group.blocks) {
        if (block.shape != Shape::tet10) continue;
        for (std::size_t e = 0; e < block.nodes.size(); e += 10)
          for (std::size_t k = 0; k < 6; ++k)
            middles_.emplace(edge_key(block.nodes[e + k_edges[k][0]], block.nodes[e + k_edges[k][1]]),
                             block.nodes[e + 4 + k]);
      }
    // Edges whose ends have been drawn onto the surface are straight.
    for (const auto& [edge, node] : middles_)
      if (held_[as_size(node)] == 0)
        mesh_.x[as_size(node)] = between(mesh_.x[as_size(edge.first)], mesh_.x[as_size(edge.second)], 0.5);
  }
  Index middle(Index a, Index b) {
    // An edge that is new gets its middle once, for all elements around it.
    const auto [place, is_new] = middles_.emplace(edge_key(a, b), -1);
    if (is_new) place->second = add_node(between(mesh_.x[as_size(a)], mesh_.x[as_size(b)], 0.5));
    return place->second;
  }

  void write(RawGroup& group, const std::vector<Corners>& tets, bool adds) {
    RawBlock block{order_ == 2 ? Shape::tet10 : Shape::tet4, {}, {}};
    for (const Corners& tet : tets) {
      block.nodes.insert(block.nodes.end(), tet.begin(), tet.end());
      for (std::size_t k = 0; order_ == 2 && k < 6; ++k)
        block.nodes.push_back(middle(tet[k_edges[k][0]], tet[k_edges[k][1]]));
      block.input_element.push_back(++last_element_);
    }
    // The upper side takes the place of the body; the lower one is added to a group that may hold another
    // part already.
    if (!adds) group.blocks.clear();
    group.dimension = 3;
    if (!block.nodes.empty()) group.blocks.push_back(std::move(block));
  }

  /// Of a second-order tetrahedron, in Gmsh's order.
  static constexpr std::array<std::array<std::size_t, 2>, 6> k_edges = {
      {{0, 1}, {1, 2}, {2, 0}, {3, 0}, {3, 2}, {3, 1}}};

  RawMesh& mesh_;
  RawGroup& body_;
  const LevelFunction& level_;
  int order_ = 1;
  std::vector<Corners> tets_;                     ///< of the body, with positive volumes
  std::vector<std::vector<std::size_t>> around_;  ///< [node]: which of them it is in
  std::vector<double> value_;                   ///< [node] of the function; zero where drawn onto the surface
  std::vector<char> held_;                      ///< [node]: of other groups too
  std::set<Edge> held_edges_;                   ///< that other groups have
  std::map<Index, std::vector<Point>> planes_;  ///< normals of the outside at its nodes
  std::map<Edge, Index> cut_nodes_, middles_;
  GlobalIndex last_node_ = 0, last_element_ = 0;
};

}  // namespace

void cut_at_level(RawMesh& mesh, const std::string& body, const std::string& below,
                  const LevelFunction& level, const std::string& source) {
  LevelCut(mesh, body, level, source).cut(mesh.groups[below]);
  leave_out_unused(mesh);
}

}  // namespace solidus::mesh
