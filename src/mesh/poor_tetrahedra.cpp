#include "mesh/poor_tetrahedra.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "mesh/edge_collapse.hpp"

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
      if (tets_.is_alive(t)) worst = std::min(worst, tets_.quality(t));
    return worst;
  }

  /// One round over all poor elements, the worst first. @return whether any could be improved
  bool improve_once() {
    std::vector<std::pair<double, std::size_t>> poor;
    for (std::size_t t = 0; t < tets_.count(); ++t)
      if (tets_.is_alive(t))
        if (const double quality = tets_.quality(t); quality < below_) poor.emplace_back(quality, t);
    std::sort(poor.begin(), poor.end());
    bool changed = false;
    for (const auto& [quality, t] : poor)
      if (tets_.is_alive(t) && tets_.quality(t) < below_) changed = improve(t) || changed;
    return changed;
  }

  bool improve(std::size_t t) {
    const std::array<Index, 4> nodes = tets_[t].nodes;
    for (const Index node : nodes) move(node);
    if (tets_.quality(t) >= below_) return true;
    constexpr double k_gain = 1.02;
    Change best;
    double gain = k_gain;
    const auto consider = [&](Change change) {
      if (!(change.quality > 0)) return;
      double before = 1;
      for (const std::size_t old : change.old) before = std::min(before, tets_.quality(old));
      const double ratio = std::min(change.quality, below_) / before;
      if (ratio > gain) {
        gain = ratio;
        best = std::move(change);
      }
    };
    for (const auto& [i, j] : k_edges) {
      consider(without_edge(tets_, nodes[i], nodes[j]));
      consider(with_node_on(tets_, nodes[i], nodes[j]));
      consider(with_node_on(tets_, nodes[j], nodes[i]));
    }
    if (best.old.empty()) return false;
    tets_.replace(best.old, best.made);
    return true;
  }

  /// The directions in which a node may go: all of a body, those within a flat face; none at its edges.
  std::vector<Point> directions(Index node) const {
    if (tets_.is_locked(node)) return {};
    const std::vector<SurfaceFace> faces = tets_.surface(node);
    if (faces.empty()) return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const auto cross = [](const Point& u, const Point& v) {
      return Point{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    };
    const auto unit = [](Point v) {
      const double length = std::hypot(v[0], v[1], v[2]);
      for (double& component : v) component /= length;
      return v;
    };
    std::optional<Point> normal;
    for (const SurfaceFace& face : faces) {
      if (face.inside != faces.front().inside && face.inside != faces.front().outside) return {};
      if (face.outside != faces.front().inside && face.outside != faces.front().outside) return {};
      const Point &a = tets_.x(face.nodes[0]), &b = tets_.x(face.nodes[1]), &c = tets_.x(face.nodes[2]);
      const Point n =
          unit(cross({b[0] - a[0], b[1] - a[1], b[2] - a[2]}, {c[0] - a[0], c[1] - a[1], c[2] - a[2]}));
      if (!normal) normal = n;
      constexpr double k_flat = 0.9998;  // the cosine of one degree
      if (std::abs(n[0] * (*normal)[0] + n[1] * (*normal)[1] + n[2] * (*normal)[2]) < k_flat) return {};
    }
    const Point axis = std::abs((*normal)[0]) < 0.6 ? Point{1, 0, 0} : Point{0, 1, 0};
    const Point first = unit(cross(*normal, axis));
    return {first, cross(*normal, first)};
  }

  /// Moves a node to where the worst element around it is better, by a search along its directions.
  void move(Index node) {
    const std::vector<Point> ways = directions(node);
    if (ways.empty()) return;
    double size = 0;
    for (const std::size_t t : tets_.around(node)) {
      const auto& n = tets_[t].nodes;
      size += std::cbrt(volume_6(tets_.x(n[0]), tets_.x(n[1]), tets_.x(n[2]), tets_.x(n[3]))) /
              static_cast<double>(tets_.around(node).size());
    }
    double worst = tets_.quality_around(node);
    for (double step = 0.3 * size; step > 0.01 * size; step /= 2)
      for (const Point& way : ways)
        for (const double sign : {-1.0, 1.0}) {
          const Point before = tets_.x(node);
          Point there = before;
          for (std::size_t i = 0; i < 3; ++i) there[i] += sign * step * way[i];
          tets_.move(node, there);
          if (const double quality = tets_.quality_around(node); quality > worst * (1 + 1e-9))
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
