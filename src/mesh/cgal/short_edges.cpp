/// Short edges are drawn together where the surface keeps its shape; sharp edges of the drawing stay.
#include "mesh/cgal/short_edges.hpp"

#include <CGAL/boost/graph/Euler_operations.h>

#include <cmath>
#include <utility>
#include <vector>

namespace solidus::mesh {

namespace {

using Sharp = TriangleSurface::Property_map<TriangleSurface::Edge_index, bool>;
using Vertex = TriangleSurface::Vertex_index;

class ShortEdges {
 public:
  ShortEdges(TriangleSurface& surface, double length, const Sharp& sharp)
      : surface_(surface), squared_(length * length), sharp_(sharp) {}

  /// @return whether any edge could be taken away
  bool collapse_once() {
    std::vector<TriangleSurface::Edge_index> edges;
    for (const TriangleSurface::Edge_index edge : surface_.edges())
      if (is_short(edge)) edges.push_back(edge);
    bool changed = false;
    for (const TriangleSurface::Edge_index edge : edges)
      if (!surface_.is_removed(edge) && is_short(edge)) changed = collapse(edge) || changed;
    return changed;
  }

 private:
  bool is_short(TriangleSurface::Edge_index edge) const {
    return CGAL::squared_distance(surface_.point(surface_.vertex(edge, 0)),
                                  surface_.point(surface_.vertex(edge, 1))) < squared_;
  }

  int sharp_edges(Vertex vertex) const {
    int count = 0;
    for (const TriangleSurface::Halfedge_index h : CGAL::halfedges_around_target(vertex, surface_))
      count += sharp_[surface_.edge(h)] ? 1 : 0;
    return count;
  }

  /// Whether no triangle around a vertex, but for those that have both ends, turns by more than 60 degrees
  /// where the vertex moves to a place.
  bool keeps_triangles(Vertex vertex, Vertex other, const Kernel::Point_3& place) const {
    for (const TriangleSurface::Halfedge_index h : CGAL::halfedges_around_target(vertex, surface_)) {
      const Vertex a = surface_.source(h), b = surface_.target(surface_.next(h));
      if (a == other || b == other) continue;
      const Kernel::Point_3 &p = surface_.point(a), &q = surface_.point(b);
      const Kernel::Vector_3 before = CGAL::cross_product(surface_.point(vertex) - q, p - q);
      const Kernel::Vector_3 after = CGAL::cross_product(place - q, p - q);
      constexpr double k_cosine = 0.5;
      if (!(before * after > k_cosine * std::sqrt(before.squared_length() * after.squared_length())))
        return false;
    }
    return true;
  }

  bool collapse(TriangleSurface::Edge_index edge) {
    if (!CGAL::Euler::does_satisfy_link_condition(edge, surface_)) return false;
    Vertex stays = surface_.vertex(edge, 0), goes = surface_.vertex(edge, 1);
    if (sharp_edges(goes) > sharp_edges(stays)) std::swap(stays, goes);
    const Kernel::Point_3 first = surface_.point(stays), second = surface_.point(goes);
    for (const Kernel::Point_3& place : {first, second, CGAL::midpoint(first, second)})
      if (keeps_triangles(stays, goes, place) && keeps_triangles(goes, stays, place)) {
        surface_.point(CGAL::Euler::collapse_edge(edge, surface_)) = place;
        return true;
      }
    return false;
  }

  TriangleSurface& surface_;
  double squared_;
  const Sharp& sharp_;
};

}  // namespace

void collapse_short_edges(TriangleSurface& surface, double length, const Sharp& sharp) {
  constexpr int k_rounds = 5;
  if (!first_crossing(surface).empty()) return;  // it crosses itself as it is
  // Where walls or gaps are narrow, edges that are drawn together may pull one side through the other.
  for (const double share : {1.0, 0.4, 0.1}) {
    TriangleSurface trial = surface;  // with the numbers of edges that `sharp` knows
    ShortEdges edges(trial, share * length, sharp);
    for (int round = 0; round < k_rounds && edges.collapse_once(); ++round) {
    }
    trial.collect_garbage();
    if (!first_crossing(trial).empty()) continue;
    surface = std::move(trial);
    return;
  }
}

}  // namespace solidus::mesh
