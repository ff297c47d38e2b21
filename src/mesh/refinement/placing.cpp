/// Offsets are taken back, sweep by sweep, until no child is folded.
#include "mesh/refinement/placing.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "mesh/quadrature.hpp"
#include "numbers/index_casts.hpp"
#include "system/processes.hpp"

namespace solidus::mesh {

namespace {

/// A child keeps at least this part of the Jacobian that it has between straight edges.
constexpr double k_least_share = 0.25;

double squared_distance(const Point& a, const Point& b) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

/// det ∂x/∂ξ at a reference point of an element.
/// @param x  of its nodes
double jacobian(Shape shape, std::span<const Point> x, const Point& xi) {
  std::array<double, 60> g{};
  basis_gradients(shape, xi, g);
  const auto dim = as_size(dimension(shape));
  std::array<std::array<double, 3>, 3> j{};
  for (std::size_t a = 0; a < x.size(); ++a)
    for (std::size_t i = 0; i < dim; ++i)
      for (std::size_t k = 0; k < dim; ++k) j[i][k] += x[a][i] * g[a * dim + k];
  if (dim == 2) return j[0][0] * j[1][1] - j[0][1] * j[1][0];
  return j[0][0] * (j[1][1] * j[2][2] - j[1][2] * j[2][1]) -
         j[0][1] * (j[1][0] * j[2][2] - j[1][2] * j[2][0]) +
         j[0][2] * (j[1][0] * j[2][1] - j[1][1] * j[2][0]);
}

class Placing {
 public:
  Placing(std::unordered_map<Index, Point> offsets, const Sharing& sharing, Level& level)
      : offsets_(std::move(offsets)), sharing_(sharing), level_(level), straight_(level.x) {
    for (std::size_t b = 0; b < level.volumes.size(); ++b)
      for (Index e = 0; e < level.volumes[b].block->size(); ++e)
        if (has_offset(level.volumes[b], e)) touched_.emplace_back(b, e);
  }

  Arcs place() {
    std::int64_t before = n_mine();
    // Taking back an offset may spoil a neighbour, so that all are looked at again; each sweep takes some
    // back, and without offsets no element is folded.
    for (;;) {
      move();
      const std::vector<Index> folded = nodes_of_folded();
      int any = folded.empty() ? 0 : 1;
      processes::largest(std::span(&any, 1));
      if (any == 0) break;
      take_back(folded);
    }
    sharing_.update(level_.x);
    std::int64_t counts[2] = {n_mine(), before - n_mine()};
    processes::sum(std::span<std::int64_t>(counts));
    return {counts[0], counts[1]};
  }

 private:
  bool has_offset(const Cut& cut, Index e) const {
    const auto n = lattice_of(cut.block->shape).points.size();
    return std::any_of(cut.element(e), cut.element(e) + n,
                       [&](Index node) { return offsets_.contains(node); });
  }

  std::int64_t n_mine() const {
    return std::ranges::count_if(offsets_, [&](const auto& offset) { return level_.is_mine(offset.first); });
  }

  void move() {
    for (const auto& [node, offset] : offsets_)
      for (std::size_t i = 0; i < 3; ++i)
        level_.x[as_size(node)][i] = straight_[as_size(node)][i] + offset[i];
    for (const auto& [b, e] : touched_) {
      const Cut& cut = level_.volumes[b];
      const Lattice& lattice = lattice_of(cut.block->shape);
      for (std::size_t p = 0; p < lattice.points.size(); ++p)
        if (const std::size_t n = lattice.points[p].vertices.size(); n > 3 && lattice.points[p].old < 0)
          move_inner(cut, e, p, n == 4 ? 0.5 : 0.25);
    }
  }

  /// A node in the middle of a face or an element: by the edges between vertices of that. Its own source
  /// alone places it, so that it lies at the same bits whatever else is here.
  void move_inner(const Cut& cut, Index e, std::size_t p, double share) {
    const Lattice& lattice = lattice_of(cut.block->shape);
    const Index node = cut.element(e)[p];
    const Source& source = level_.source[as_size(node - level_.n_old())];
    if (level_.volumes[as_size(source.block)].block != cut.block || source.element != e) return;
    const std::vector<int>& vertices = lattice.points[p].vertices;
    Point sum{};
    for (std::size_t q = 0; q < lattice.points.size(); ++q) {
      const LatticePoint& edge = lattice.points[q];
      if (edge.old >= 0 || edge.vertices.size() != 2) continue;
      if (!std::ranges::all_of(edge.vertices,
                               [&](int v) { return std::ranges::find(vertices, v) != vertices.end(); }))
        continue;
      const auto offset = offsets_.find(cut.element(e)[q]);
      if (offset == offsets_.end()) continue;
      for (std::size_t i = 0; i < 3; ++i) sum[i] += offset->second[i];
    }
    for (std::size_t i = 0; i < 3; ++i)
      level_.x[as_size(node)][i] = straight_[as_size(node)][i] + share * sum[i];
  }

  /// Nodes of edges with offsets, of this process' own, around elements of which a child is folded.
  std::vector<Index> nodes_of_folded() const {
    std::set<Index> nodes;
    for (const auto& [b, e] : touched_) {
      const Cut& cut = level_.volumes[b];
      if (!has_offset(cut, e) || !is_folded(cut, e)) continue;
      const auto n = lattice_of(cut.block->shape).points.size();
      for (std::size_t p = 0; p < n; ++p)
        if (const Index node = cut.element(e)[p]; level_.is_mine(node) && offsets_.contains(node))
          nodes.insert(node);
    }
    return {nodes.begin(), nodes.end()};
  }

  bool is_folded(const Cut& cut, Index e) const {
    const Shape shape = cut.block->shape;
    const Lattice& lattice = lattice_of(shape);
    const Index* nodes = cut.element(e);
    const Rule corners = nodal_rule(shape);
    // The Jacobian of a linear simplex is the same everywhere.
    const bool simplex = vertex_count(shape) == dimension(shape) + 1;
    const auto n = as_size(node_count(shape));
    std::vector<Point> moved(n), straight(n);
    for (const std::vector<int>& child : lattice.choices[choice_of(lattice, nodes, level_.x)]) {
      for (std::size_t a = 0; a < n; ++a) {
        moved[a] = level_.x[as_size(nodes[child[a]])];
        straight[a] = straight_[as_size(nodes[child[a]])];
      }
      for (std::size_t a = 0; a < (simplex ? 1 : n); ++a) {
        const double j = jacobian(shape, straight, corners[a].xi);
        if (j > 0 && jacobian(shape, moved, corners[a].xi) < k_least_share * j) return true;
      }
    }
    return false;
  }

  /// Takes back the offsets of nodes that their owners name.
  void take_back(const std::vector<Index>& mine) {
    std::vector<char> back(as_size(level_.n_nodes()), 0);
    for (const Index node : mine) back[as_size(node)] = 1;
    sharing_.update(back);
    std::erase_if(offsets_, [&](const auto& offset) {
      if (back[as_size(offset.first)] == 0) return false;
      level_.x[as_size(offset.first)] = straight_[as_size(offset.first)];
      return true;
    });
  }

  std::unordered_map<Index, Point> offsets_;
  const Sharing& sharing_;
  Level& level_;
  std::vector<Point> straight_;
  std::vector<std::pair<std::size_t, Index>> touched_;  ///< block and element
};

}  // namespace

std::size_t choice_of(const Lattice& lattice, const Index* nodes, std::span<const Point> x) {
  std::size_t best = 0;
  double least = 0;
  for (std::size_t i = 0; i < lattice.diagonals.size(); ++i) {
    const auto [a, b] = lattice.diagonals[i];
    const double d = squared_distance(x[as_size(nodes[a])], x[as_size(nodes[b])]);
    if (i > 0 && !(d < least)) continue;
    best = i;
    least = d;
  }
  return best;
}

Arcs place_on_arcs(std::unordered_map<Index, Point> offsets, const Sharing& sharing, Level& level) {
  return Placing(std::move(offsets), sharing, level).place();
}

}  // namespace solidus::mesh
