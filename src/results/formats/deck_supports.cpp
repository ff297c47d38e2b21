/// Rigid motions that supports leave free are found by elimination, body by body, and held at as few
/// entries as possible.
#include "results/formats/deck_supports.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>

#include "numbers/index_casts.hpp"

namespace solidus::results {

namespace {

constexpr std::size_t k_most_modes = 6;
/// Displacement of a degree of freedom in each rigid motion; rotations are about the centre, over the size of
/// the part.
using Row = std::array<double, k_most_modes>;

double dot(const Row& a, const Row& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// Motions that are held, as an orthonormal basis.
class Held {
 public:
  /// Returns the part of a row that is orthogonal to the motions held already.
  Row rest(Row row) const {
    for (int pass = 0; pass < 2; ++pass)  // a second time for rounding
      for (const Row& held : basis_) {
        const double part = dot(held, row);
        for (std::size_t i = 0; i < k_most_modes; ++i) row[i] -= part * held[i];
      }
    return row;
  }
  /// False where the row, of length one or so, adds nothing.
  bool add(const Row& row) {
    constexpr double k_nothing = 1e-6;
    Row rest = this->rest(row);
    const double length = std::sqrt(dot(rest, rest));
    if (!(length > k_nothing)) return false;
    for (double& value : rest) value /= length;
    basis_.push_back(rest);
    return true;
  }
  std::size_t size() const { return basis_.size(); }

 private:
  std::vector<Row> basis_;
};

/// For each node the least node of its connected part; −1 where nothing is.
std::vector<Index> connected_parts(const mesh::Mesh& mesh, const linear::ActiveSet& active) {
  std::vector<Index> part(mesh.x.size(), -1);
  // The root of a set is the node that is its own parent.
  const auto root = [&part](Index node) {
    while (part[as_size(node)] != node) node = part[as_size(node)];
    return node;
  };
  for (const mesh::ElementBlock& block : mesh.blocks) {
    if (!active.body(block.body)) continue;
    const int n = mesh::node_count(block.shape);
    for (Index e = 0; e < block.size(); ++e)
      for (int a = 0; a < n; ++a) {
        // Disjoint sets of nodes: an element joins its nodes, and the smaller number is the root.
        const Index node = block.element(e)[a];
        if (part[as_size(node)] < 0) part[as_size(node)] = node;
        const Index mine = root(node), first = root(block.element(e)[0]);
        part[as_size(std::max(mine, first))] = std::min(mine, first);
        part[as_size(node)] = std::min(mine, first);
      }
  }
  // At last every node names its root directly.
  for (std::size_t i = 0; i < part.size(); ++i)
    if (part[i] >= 0) part[i] = root(as_index(i));
  return part;
}

/// A connected part: its nodes, and its centre and size, about and over which it turns.
struct Part {
  std::vector<Index> nodes;
  mesh::Point centre{};
  double size = 0;
};

class Motions {
 public:
  Motions(const mesh::Mesh& mesh, AnalysisKind kind, const Part& part)
      : mesh_(mesh), kind_(kind), part_(part) {}

  std::size_t count() const {
    return kind_ == AnalysisKind::solid ? 6 : kind_ == AnalysisKind::plane_strain ? 3 : 1;
  }
  Row row(Index node, std::size_t component) const {
    Row row{};
    mesh::Point r = mesh_.x[as_size(node)];
    // Places are scaled by the part's size, so that translations and rotations weigh alike.
    for (std::size_t i = 0; i < 3; ++i) r[i] = (r[i] - part_.centre[i]) / part_.size;
    switch (kind_) {
      case AnalysisKind::axisymmetric:
        row[0] = component == 1 ? 1 : 0;
        break;
      case AnalysisKind::plane_strain:
        row[component] = 1;
        row[2] = component == 0 ? -r[1] : r[0];
        break;
      case AnalysisKind::solid:
        row[component] = 1;
        // e_i × r of the rotations about the three axes.
        row[3] = component == 1 ? -r[2] : component == 2 ? r[1] : 0;
        row[4] = component == 0 ? r[2] : component == 2 ? -r[0] : 0;
        row[5] = component == 0 ? -r[1] : component == 1 ? r[0] : 0;
        break;
    }
    return row;
  }

 private:
  const mesh::Mesh& mesh_;
  AnalysisKind kind_;
  const Part& part_;
};

std::map<Index, Part> parts_of(const mesh::Mesh& mesh, const std::vector<Index>& part_of) {
  std::map<Index, Part> parts;
  for (std::size_t i = 0; i < part_of.size(); ++i)
    if (part_of[i] >= 0) parts[part_of[i]].nodes.push_back(as_index(i));
  for (auto& [first, part] : parts) {
    for (const Index node : part.nodes)
      for (std::size_t i = 0; i < 3; ++i)
        part.centre[i] += mesh.x[as_size(node)][i] / static_cast<double>(part.nodes.size());
    for (const Index node : part.nodes) {
      const mesh::Point& x = mesh.x[as_size(node)];
      part.size = std::max(part.size,
                           std::hypot(x[0] - part.centre[0], x[1] - part.centre[1], x[2] - part.centre[2]));
    }
  }
  return parts;
}

}  // namespace

std::vector<Index> missing_supports(const mesh::Mesh& mesh, const linear::ActiveSet& active,
                                    AnalysisKind kind, std::span<const char> fixed,
                                    std::span<const std::vector<Index>> constraints) {
  const auto components = as_size(displacement_components(kind));
  const std::vector<Index> part_of = connected_parts(mesh, active);
  std::vector<Index> supports;
  for (const auto& [first, part] : parts_of(mesh, part_of)) {
    const Motions motions(mesh, kind, part);
    Held held;
    // What the case holds already takes away some of the free motions.
    for (const Index node : part.nodes)
      for (std::size_t k = 0; k < components && held.size() < motions.count(); ++k)
        if (fixed[as_size(node) * components + k] != 0) held.add(motions.row(node, k));
    // Where degrees of freedom move as one, their differences are held; those of other parts hold nothing
    // here.
    for (const std::vector<Index>& group : constraints) {
      const auto n = as_index(components);
      if (part_of[as_size(group[0] / n)] != first) continue;
      const Row leader = motions.row(group[0] / n, as_size(group[0] % n));
      for (const Index entry : group) {
        if (part_of[as_size(entry / n)] != first) continue;
        Row row = motions.row(entry / n, as_size(entry % n));
        for (std::size_t i = 0; i < k_most_modes; ++i) row[i] -= leader[i];
        if (held.size() < motions.count()) held.add(row);
      }
    }
    // Each missing support is where the remaining motions move the most: far from those that are
    // there.
    while (held.size() < motions.count()) {
      double most = 0;
      Row best{};
      Index entry = -1;
      for (const Index node : part.nodes)
        for (std::size_t k = 0; k < components; ++k) {
          const Row row = motions.row(node, k), rest = held.rest(row);
          if (const double length = dot(rest, rest); length > most * (1 + 1e-9)) {
            most = length;
            best = row;
            entry = node * as_index(components) + as_index(k);
          }
        }
      if (entry < 0 || !held.add(best)) break;  // a part of one point or line
      supports.push_back(entry);
    }
  }
  return supports;
}

}  // namespace solidus::results
