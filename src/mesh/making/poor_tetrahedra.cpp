/// The worst tetrahedra are changed first, by whichever local change helps the most; passes go on while
/// they help.
#include "mesh/making/poor_tetrahedra.hpp"

#include <algorithm>
#include <cmath>

#include "mesh/making/edge_collapse.hpp"
#include "mesh/making/surface_node.hpp"

namespace solidus::mesh {

namespace {

constexpr std::array<std::pair<std::size_t, std::size_t>, 6> k_edges = {
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

class Repair {
 public:
  Repair(RawMesh& mesh, double below) : tets_(mesh), below_(below) {}

  double run() {
    constexpr int k_rounds = 12;
    bool changed = false;
    for (int round = 0; round < k_rounds && improve_once(); ++round) changed = true;
    const double worst = least();
    if (changed) tets_.put_back();
    return worst;
  }

 private:
  double least() const {
    double worst = 1;
    for (std::size_t t = 0; t < tets_.count(); ++t)
      if (tets_.is_alive(t)) worst = std::min(worst, mesh::quality(tets_, t));
    return worst;
  }

  /// One round over all poor elements, the worst first. @return whether any could be improved
  bool improve_once() {
    std::vector<std::pair<double, std::size_t>> poor;
    for (std::size_t t = 0; t < tets_.count(); ++t)
      if (tets_.is_alive(t))
        if (const double quality = mesh::quality(tets_, t); quality < below_) poor.emplace_back(quality, t);
    std::sort(poor.begin(), poor.end());
    bool changed = false;
    for (const auto& [quality, t] : poor)
      if (tets_.is_alive(t) && mesh::quality(tets_, t) < below_) changed = improve(t) || changed;
    return changed;
  }

  bool improve(std::size_t t) {
    // Moving its nodes is tried first; if that does not do, the best of all changes at its edges that gains
    // enough.
    const std::array<Index, 4> nodes = tets_[t].nodes;
    for (const Index node : nodes) move(node);
    if (mesh::quality(tets_, t) >= below_) return true;
    constexpr double k_gain = 1.02;
    Change best;
    double gain = k_gain;
    // A change counts by how much it raises the worst quality among what it replaces.
    const auto consider = [&](Change change) {
      if (!(change.quality > 0)) return;
      double before = 1;
      for (const std::size_t old : change.old) before = std::min(before, mesh::quality(tets_, old));
      const double ratio = std::min(change.quality, below_) / before;
      if (ratio > gain) {
        gain = ratio;
        best = std::move(change);
      }
    };
    // At each edge: without it, and drawn together to either end.
    for (const auto& [i, j] : k_edges) {
      consider(without_edge(tets_, nodes[i], nodes[j]));
      consider(with_node_on(tets_, nodes[i], nodes[j]));
      consider(with_node_on(tets_, nodes[j], nodes[i]));
    }
    if (best.old.empty()) return false;
    tets_.replace(best.old, best.made);
    return true;
  }

  /// Moves a node to where the worst element around it is better, by a search along its ways.
  void move(Index node) {
    const SurfaceNode ways(tets_, node);
    // Steps are measured by the size of the elements around.
    double size = 0;
    for (const std::size_t t : tets_.around(node)) {
      const auto& n = tets_[t].nodes;
      size += std::cbrt(volume_6(tets_.x(n[0]), tets_.x(n[1]), tets_.x(n[2]), tets_.x(n[3]))) /
              static_cast<double>(tets_.around(node).size());
    }
    double worst = quality_around(tets_, node);
    for (double step = 0.3 * size; step > 0.01 * size; step /= 2)
      for (std::size_t k = 0; k < ways.places(step).size(); ++k) {
        const Point before = tets_.x(node);
        tets_.move(node, ways.places(step)[k]);
        const double quality = quality_around(tets_, node);
        if (quality > worst * (1 + 1e-9) && ways.keeps_surface())
          worst = quality;
        else
          tets_.move(node, before);
      }
  }

  Tetrahedra tets_;
  double below_;
};

}  // namespace

double repair_poor_tetrahedra(RawMesh& mesh, double below) {
  return Repair(mesh, below).run();
}

}  // namespace solidus::mesh
