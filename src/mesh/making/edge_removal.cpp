/// The ring of tetrahedra around an edge is replaced by the best triangulation of the ring, found by
/// dynamic programming.
#include "mesh/making/edge_removal.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace solidus::mesh {

namespace {

struct RingPart {
  std::vector<Index> nodes;  ///< of the polygon, in order about the edge
  int body = 0;
};

/// The best triangulation of a polygon, each triangle (i, k, j) of which gives two tetrahedra, with either
/// end of the edge.
class BestTriangulation {
 public:
  BestTriangulation(const Tetrahedra& mesh, Index a, Index b, const RingPart& part)
      : a_(a), b_(b), part_(part), n_(part.nodes.size()), best_(n_ * n_, 1.0), middle_(n_ * n_, 0) {
    // The best triangulation of the ring by dynamic programming: that between two nodes is the best of all
    // third nodes, and its quality that of the worst tetrahedron.
    for (std::size_t length = 2; length < n_; ++length)
      for (std::size_t i = 0; i + length < n_; ++i) {
        const std::size_t j = i + length;
        double& best = best_[i * n_ + j];
        best = -1;
        for (std::size_t k = i + 1; k < j; ++k) {
          const double q = std::min({best_[i * n_ + k], best_[k * n_ + j], mesh.quality(upper(i, k, j)),
                                     mesh.quality(lower(i, k, j))});
          if (q > best) {
            best = q;
            middle_[i * n_ + j] = k;
          }
        }
      }
  }

  double quality() const { return n_ > 2 ? best_[n_ - 1] : 1; }
  void append(std::vector<Tetrahedron>& made) const { append(made, 0, n_ - 1); }

 private:
  std::array<Index, 4> upper(std::size_t i, std::size_t k, std::size_t j) const {
    return {part_.nodes[i], part_.nodes[k], part_.nodes[j], b_};
  }
  std::array<Index, 4> lower(std::size_t i, std::size_t k, std::size_t j) const {
    return {part_.nodes[i], part_.nodes[j], part_.nodes[k], a_};
  }
  void append(std::vector<Tetrahedron>& made, std::size_t i, std::size_t j) const {
    if (j < i + 2) return;
    const std::size_t k = middle_[i * n_ + j];
    made.push_back({upper(i, k, j), part_.body});
    made.push_back({lower(i, k, j), part_.body});
    append(made, i, k);
    append(made, k, j);
  }

  Index a_, b_;
  const RingPart& part_;
  std::size_t n_;
  std::vector<double> best_;  ///< [i][j] of the polygon from i to j
  std::vector<std::size_t> middle_;
};

/// The polygons around an edge, one of each body; empty where the edge is of more surfaces than one.
std::vector<RingPart> ring_parts(const Tetrahedra& mesh, Index a, Index b,
                                 const std::vector<std::size_t>& around) {
  // Each tetrahedron at the edge leads from one node of the ring to the next.
  std::map<Index, std::pair<Index, int>> next;  // and the body on the way there
  std::map<Index, int> before;
  for (const std::size_t t : around) {
    const auto [p, q] = mesh[t].beside(a, b);
    next[p] = {q, mesh[t].body};
    before[q] = mesh[t].body;
  }
  if (next.size() != around.size()) return {};
  // Begins where a body does, else anywhere.
  Index first = next.begin()->first;
  std::size_t n_starts = 0;
  for (const auto& [node, to] : next)
    if (const auto from = before.find(node); from == before.end() || from->second != to.second) {
      first = node;
      ++n_starts;
    }
  // A ring that does not close lies at the skin of the mesh; more than two changes of bodies have
  // no triangulation.
  const bool open = before.count(first) == 0;
  if (n_starts > (open ? 1U : 2U)) return {};
  std::vector<RingPart> parts;
  Index node = first;
  // The walk around the edge cuts the ring into one part for each body.
  for (std::size_t i = 0; i < around.size(); ++i) {
    const auto to = next.find(node);
    if (to == next.end()) return {};
    if (parts.empty() || parts.back().body != to->second.second) parts.push_back({{node}, to->second.second});
    node = to->second.first;
    parts.back().nodes.push_back(node);
  }
  if (!open && n_starts == 0) parts.front().nodes.pop_back();  // a ring that closes
  return parts;
}

/// Whether the faces (a, b, c) and (b, a, d) may be replaced by (a, d, c) and (b, c, d): how far the surface
/// moves, and that it does not fold.
bool may_turn(const Tetrahedra& mesh, Index a, Index b, Index c, Index d) {
  const auto edge = [&](Index from, Index to) {
    return Point{mesh.x(to)[0] - mesh.x(from)[0], mesh.x(to)[1] - mesh.x(from)[1],
                 mesh.x(to)[2] - mesh.x(from)[2]};
  };
  const auto cross = [](const Point& u, const Point& v) {
    return Point{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  };
  const auto dot = [](const Point& u, const Point& v) { return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]; };
  const Point ab = edge(a, b), cd = edge(c, d), across = cross(ab, cd);
  const double area = std::sqrt(dot(across, across)), least = std::sqrt(std::min(dot(ab, ab), dot(cd, cd)));
  constexpr double k_flat = 0.05;  // of the shorter diagonal
  if (!(area > 0) || std::abs(dot(across, edge(a, c))) > k_flat * least * area) return false;
  // The diagonals have to cross: all four triangles look the same way. Where c lies as good as on (a, b) the
  // side to which (a, b, c) looks means nothing, as that of a step of a hundredth of an element.
  const auto is_cap = [&](Index node) {
    const Point to = edge(a, node), n = cross(ab, to);
    const double share = dot(ab, to) / dot(ab, ab);
    return std::sqrt(dot(n, n)) < k_flat * least * std::sqrt(dot(ab, ab)) && share > 0 && share < 1;
  };
  const Point of_c = cross(ab, edge(a, c)), of_d = cross(edge(b, a), edge(b, d));
  const bool flat_c = is_cap(c), flat_d = is_cap(d);
  if (flat_c && flat_d) return false;
  const Point& normal = flat_c ? of_d : of_c;
  if (!flat_c && !flat_d && !(dot(of_c, of_d) > 0)) return false;
  for (const Point& n : {cross(edge(a, d), edge(a, c)), cross(edge(b, c), edge(b, d))})
    if (!(dot(normal, n) > 0)) return false;
  return true;
}

}  // namespace

Change without_edge(const Tetrahedra& mesh, Index a, Index b) {
  Change change;
  change.old = around_edge(mesh, a, b);
  constexpr std::size_t k_most = 12;
  // Large rings have too many triangulations to be worth it; locked ends stay.
  if (change.old.empty() || change.old.size() > k_most || (mesh.is_locked(a) && mesh.is_locked(b))) return {};
  const std::vector<RingPart> parts = ring_parts(mesh, a, b, change.old);
  if (parts.empty()) return {};
  // On the surface two faces turn about the edge, which must be allowed there.
  const bool of_surface = parts.size() > 1 || parts.front().nodes.size() == change.old.size() + 1;
  if (of_surface) {
    const Index c = parts.front().nodes.front(), d = parts.front().nodes.back();
    if (mesh.is_locked(c) || mesh.is_locked(d) || !may_turn(mesh, a, b, c, d)) return {};
    for (const std::size_t t : around_edge(mesh, c, d))  // the new edge may be there only in what goes
      if (std::find(change.old.begin(), change.old.end(), t) == change.old.end() &&
          (parts.front().nodes.size() > 2 && parts.back().nodes.size() > 2))
        return {};
  }
  // Every part gets its best triangulation; the worst of all tetrahedra decides.
  change.quality = 1;
  for (const RingPart& part : parts) {
    const BestTriangulation best(mesh, a, b, part);
    change.quality = std::min(change.quality, best.quality());
    if (!(change.quality > 0)) return {};
    best.append(change.made);
  }
  if (change.made.empty()) return {};
  return change;
}

}  // namespace solidus::mesh
