/// Inner nodes of poor elements are tried along each axis in halved steps; a place is kept if the worst
/// element around the node becomes better.
#include "mesh/making/smoothing.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "mesh/quality.hpp"
#include "mesh/shape.hpp"
#include "mesh/surfaces/skin.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mesh {

namespace {

class Smoothing {
 public:
  explicit Smoothing(RawMesh& mesh) : mesh_(mesh), around_(mesh.x.size()), fixed_(mesh.x.size(), 0) {
    // Nodes of anything but tetrahedra, and of the skin, are fixed.
    for (const auto& [name, group] : mesh.groups)
      for (const RawBlock& block : group.blocks) {
        const bool moves = group.dimension == mesh.dimension && block.shape == Shape::tet4;
        if (!moves)
          for (const Index node : block.nodes) fixed_[as_size(node)] = 1;
        for (std::size_t e = 0; moves && e < block.nodes.size(); e += 4) {
          for (std::size_t a = 0; a < 4; ++a) around_[as_size(block.nodes[e + a])].push_back(tets_.size());
          tets_.push_back(block.nodes.data() + e);
        }
      }
    for (const auto& [name, group] : mesh.groups)
      if (group.dimension == mesh.dimension)
        for (const SkinFace& face : skin_of(mesh, name))
          for (const Index node : face.nodes) fixed_[as_size(node)] = 1;
  }

  double least() const {
    double worst = 1;
    for (std::size_t t = 0; t < tets_.size(); ++t) worst = std::min(worst, quality(t));
    return worst;
  }

  /// @return whether a node has moved
  bool sweep(double below) {
    std::set<Index> nodes;
    for (std::size_t t = 0; t < tets_.size(); ++t)
      if (quality(t) < below)
        for (std::size_t a = 0; a < 4; ++a)
          if (fixed_[as_size(tets_[t][a])] == 0) nodes.insert(tets_[t][a]);
    bool moved = false;
    for (const Index node : nodes) moved = improve(as_size(node)) || moved;
    return moved;
  }

 private:
  /// Meshes may be mirrored before validate_and_orient().
  double quality(std::size_t tet) const { return std::abs(element_quality(mesh_, Shape::tet4, tets_[tet])); }

  double volume(std::size_t tet) const {
    const auto x = [&](std::size_t a) { return mesh_.x[as_size(tets_[tet][a])]; };
    const Point o = x(0);
    std::array<Point, 3> e{};
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t i = 0; i < 3; ++i) e[a][i] = x(a + 1)[i] - o[i];
    return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
           e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
           e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
  }

  double worst_around(std::size_t node, const std::vector<bool>& positive) const {
    double worst = 1;
    for (std::size_t k = 0; k < around_[node].size(); ++k) {
      if ((volume(around_[node][k]) > 0) != positive[k]) return 0;  // turned inside out
      worst = std::min(worst, quality(around_[node][k]));
    }
    return worst;
  }

  bool improve(std::size_t node) {
    double size = 0;  // the mean edge
    // The sense of each element as it is must be kept.
    std::vector<bool> positive;
    for (const std::size_t tet : around_[node]) {
      positive.push_back(volume(tet) > 0);
      size += std::cbrt(std::abs(volume(tet))) / static_cast<double>(around_[node].size());
    }
    Point& x = mesh_.x[node];
    double worst = worst_around(node, positive);
    bool moved = false;
    // Along each axis in halved steps, as long as the worst element around becomes better.
    for (double step = 0.3 * size; step > 0.01 * size; step /= 2)
      for (std::size_t i = 0; i < 3; ++i)
        for (const double sign : {-1.0, 1.0}) {
          const double before = x[i];
          x[i] += sign * step;
          if (const double there = worst_around(node, positive); there > worst * (1 + 1e-9)) {
            worst = there;
            moved = true;
          } else {
            x[i] = before;
          }
        }
    return moved;
  }

  RawMesh& mesh_;
  std::vector<const Index*> tets_;
  std::vector<std::vector<std::size_t>> around_;  ///< tetrahedra at each node
  std::vector<char> fixed_;                       ///< nodes
};

}  // namespace

double smooth_poor_tetrahedra(RawMesh& mesh, double below) {
  Smoothing smoothing(mesh);
  constexpr int k_sweeps = 8;
  for (int sweep = 0; sweep < k_sweeps && smoothing.sweep(below); ++sweep) {
  }
  return smoothing.least();
}

}  // namespace solidus::mesh
