/// CGAL wraps the surface from outside; the points of the wrapping are then drawn back to the facets.
#include "mesh/cgal/wrapped_surface.hpp"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/alpha_wrap_3.h>

namespace solidus::mesh {

namespace {

using Tree =
    CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_face_graph_triangle_primitive<TriangleSurface>>>;

/// Moves the corners of a wrap onto the facets where these are near.
TriangleSurface drawn_back(TriangleSurface wrap, const TriangleSurface& facets, double reach) {
  Tree tree(facets.faces().begin(), facets.faces().end(), facets);
  tree.accelerate_distance_queries();
  for (const TriangleSurface::Vertex_index v : wrap.vertices()) {
    const Kernel::Point_3 place = tree.closest_point(wrap.point(v));
    if (CGAL::squared_distance(place, wrap.point(v)) < reach * reach) wrap.point(v) = place;
  }
  return wrap;
}

}  // namespace

TriangleSurface wrapped_surface(const TriangleSurface& facets, double size) {
  constexpr double k_opening = 0.5, k_offset = 0.03;  // radius and distance, of the size
  std::vector<Kernel::Point_3> points;
  std::vector<std::vector<std::size_t>> triangles;
  for (const TriangleSurface::Vertex_index v : facets.vertices()) points.push_back(facets.point(v));
  for (const TriangleSurface::Face_index f : facets.faces()) {
    std::vector<std::size_t>& triangle = triangles.emplace_back();
    for (const TriangleSurface::Vertex_index v : CGAL::vertices_around_face(facets.halfedge(f), facets))
      triangle.push_back(static_cast<std::size_t>(v));
  }
  TriangleSurface wrap;
  CGAL::alpha_wrap_3(points, triangles, k_opening * size, k_offset * size, wrap);
  // Corners of the wrap lie on the offset but where it spans an opening.
  TriangleSurface back = drawn_back(wrap, facets, 2 * k_offset * size);
  return first_crossing(back).empty() ? back : wrap;
}

}  // namespace solidus::mesh
