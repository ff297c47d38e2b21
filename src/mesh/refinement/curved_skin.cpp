/// Tangents at both ends of an edge meet at the process that owns its new node.
#include "mesh/refinement/curved_skin.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "mesh/refinement/vertex_tangents.hpp"
#include "numbers/index_casts.hpp"
#include "system/processes.hpp"

namespace solidus::mesh {

namespace {

double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// What a process tells of an edge whose new node another one owns: the tangent at the end that is its own.
struct Told {
  GlobalIndex a = 0, b = 0;  ///< ends, numbers over all processes
  Point tangent{};
  bool of_a = false, there = false;
};

using Ends = std::pair<GlobalIndex, GlobalIndex>;

struct EndsHash {
  std::size_t operator()(const Ends& ends) const {
    return as_size(ends.first) * 0x9E3779B97F4A7C15ULL + as_size(ends.second);
  }
};

Index new_node_of(const Level& level, const SkinEdge& edge) {
  // The middle of an edge is that of its line of two nodes.
  static const LatticePoint& middle = []() -> const LatticePoint& {
    const std::vector<LatticePoint>& points = lattice_of(Shape::line2).points;
    return *std::find_if(points.begin(), points.end(), [](const LatticePoint& p) { return p.old < 0; });
  }();
  const std::array<Index, 2> ends{edge.a, edge.b};
  return level.table.find(key_of(middle, ends.data(), level.part.mesh.global_node));
}

/// Half of what the arc rises above the middle of its edge, by the tangent at one end; twice that where the
/// other end has none.
/// @param c  direction of the edge
std::optional<Point> rise(const std::optional<Point>& tangent, const Point& c, double length) {
  constexpr double k_steepest = 0.70710678118654752;  // cosine of the angle to the edge
  if (!tangent) return std::nullopt;
  const double along = dot(*tangent, c);
  if (along < k_steepest) return std::nullopt;
  Point r{};
  for (std::size_t i = 0; i < 3; ++i) r[i] = length / 4 * ((*tangent)[i] - along * c[i]) / (1 + along);
  return r;
}

/// From the middle of the edge to that of its arc; nothing where that is next to nothing, so that flat faces
/// stay flat to the last bit.
std::optional<Point> offset_of(const SkinEdge& edge, const Mesh& mesh) {
  const Point &a = mesh.x[as_size(edge.a)], &b = mesh.x[as_size(edge.b)];
  Point c{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  const double length = std::sqrt(dot(c, c));
  for (double& component : c) component /= length;
  const std::optional<Point> of_a = rise(edge.tangent_a, c, length), of_b = rise(edge.tangent_b, c, length);
  // A tangent that is not believed leaves the edge straight; where a line ends the other end's circle is
  // taken.
  const bool refused = (edge.tangent_a && !of_a) || (edge.tangent_b && !of_b) || (!of_a && !of_b);
  if (refused) return std::nullopt;
  Point offset{};
  for (std::size_t i = 0; i < 3; ++i)
    offset[i] = of_a && of_b ? (*of_a)[i] - (*of_b)[i] : of_a ? 2 * (*of_a)[i] : -2 * (*of_b)[i];
  constexpr double k_flat = 1e-9;
  if (!(std::sqrt(dot(offset, offset)) > k_flat * length)) return std::nullopt;
  return offset;
}

/// Tells the owners of new nodes the tangents at ends that are not theirs, and adds what the others tell.
void share_tangents(const Level& level, std::vector<SkinEdge>& edges) {
  const Mesh& mesh = level.part.mesh;
  std::vector<Packer> to(level.first.size() - 1);
  std::vector<std::vector<Told>> told(to.size());
  std::unordered_map<Ends, std::size_t, EndsHash> mine;
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const SkinEdge& edge = edges[k];
    const Index node = new_node_of(level, edge);
    const Ends ends{mesh.global_node[as_size(edge.a)], mesh.global_node[as_size(edge.b)]};
    if (level.is_mine(node)) {
      mine.emplace(ends, k);
      continue;
    }
    for (const bool of_a : {true, false}) {
      const std::optional<Point>& tangent = of_a ? edge.tangent_a : edge.tangent_b;
      if ((of_a ? edge.a : edge.b) < mesh.n_owned_nodes)
        told[as_size(level.owner[as_size(node)])].push_back(
            {ends.first, ends.second, tangent.value_or(Point{}), of_a, tangent.has_value()});
    }
  }
  std::vector<std::vector<char>> messages;
  for (std::size_t r = 0; r < to.size(); ++r) {
    to[r].put(told[r]);
    messages.push_back(std::move(to[r]).buffer());
  }
  for (const std::vector<char>& message : exchange(std::move(messages))) {
    Unpacker unpacker(message);
    for (const Told& news : unpacker.vector<Told>()) {
      const auto edge = mine.find({news.a, news.b});
      if (edge == mine.end() || !news.there) continue;
      (news.of_a ? edges[edge->second].tangent_a : edges[edge->second].tangent_b) = news.tangent;
    }
  }
}

}  // namespace

std::unordered_map<Index, Point> arc_offsets(const Level& level, const Sharing& sharing) {
  std::vector<SkinEdge> edges = skin_edges(level.part.mesh, level.part.skin);
  share_tangents(level, edges);
  // Owners know both ends; then all who hold a node learn of its place.
  std::vector<Point> all(as_size(level.n_nodes()), Point{});
  for (const SkinEdge& edge : edges) {
    const Index node = new_node_of(level, edge);
    if (!level.is_mine(node)) continue;
    if (const std::optional<Point> offset = offset_of(edge, level.part.mesh)) all[as_size(node)] = *offset;
  }
  sharing.update(all);
  std::unordered_map<Index, Point> offsets;
  for (Index i = level.n_old(); i < level.n_nodes(); ++i)
    if (all[as_size(i)] != Point{}) offsets.emplace(i, all[as_size(i)]);
  return offsets;
}

}  // namespace solidus::mesh
