/// The way between lists of triangles and surfaces of CGAL: nodes are numbered as triangles ask for them,
/// and parts that hang together become shells.
#include "mesh/cgal/surface.hpp"

#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <fmt/format.h>

#include <map>
#include <utility>

#include "numbers/index_casts.hpp"

namespace solidus::mesh {

namespace PMP = CGAL::Polygon_mesh_processing;

TriangleSurface surface_of(const ClosedShells& all, const Shell& shell) {
  // Points and triangles as a soup, which is then turned into a surface that knows its neighbours.
  std::vector<Kernel::Point_3> points;
  std::vector<std::vector<std::size_t>> triangles;
  std::map<Index, std::size_t> number_of;
  // Nodes are numbered as triangles ask for them; then all triangles look the same way.
  for (const std::array<Index, 3>& nodes : shell.triangles) {
    std::vector<std::size_t>& triangle = triangles.emplace_back();
    for (const Index node : nodes) {
      const auto [place, is_new] = number_of.emplace(node, points.size());
      triangle.push_back(place->second);
      if (!is_new) continue;
      const Point& p = all.points[as_size(node)];
      points.emplace_back(p[0], p[1], p[2]);
    }
  }
  // STL gives triangles in any sense; a surface needs them all alike.
  PMP::orient_polygon_soup(points, triangles);
  TriangleSurface surface;
  PMP::polygon_soup_to_polygon_mesh(points, triangles, surface);
  return surface;
}

void append_shells(const TriangleSurface& surface, const std::string& name, ClosedShells& all) {
  std::map<TriangleSurface::Face_index, std::size_t> part_of;
  // Parts that hang together by edges get a number each.
  const std::size_t n_parts =
      PMP::connected_components(surface, boost::associative_property_map<decltype(part_of)>(part_of));
  const std::size_t first = all.shells.size();
  for (std::size_t p = 0; p < n_parts; ++p) all.shells.emplace_back().name = name;
  // Vertices are appended as triangles ask for them.
  std::map<TriangleSurface::Vertex_index, Index> number_of;
  // A shell of its own for each connected part.
  for (const TriangleSurface::Face_index face : surface.faces()) {
    std::array<Index, 3> triangle{};
    std::size_t k = 0;
    for (const TriangleSurface::Vertex_index v :
         CGAL::vertices_around_face(surface.halfedge(face), surface)) {
      const auto [place, is_new] = number_of.emplace(v, as_index(all.points.size()));
      if (is_new) {
        const Kernel::Point_3& p = surface.point(v);
        all.points.push_back({p.x(), p.y(), p.z()});
      }
      triangle[k++] = place->second;
    }
    all.shells[first + part_of.at(face)].triangles.push_back(triangle);
  }
}

std::string place_text(const Kernel::Point_3& p) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", p.x(), p.y(), p.z());
}

std::string first_crossing(const TriangleSurface& surface) {
  std::vector<std::pair<TriangleSurface::Face_index, TriangleSurface::Face_index>> pairs;
  PMP::self_intersections(surface, std::back_inserter(pairs));
  if (pairs.empty()) return {};
  const auto corners = CGAL::vertices_around_face(surface.halfedge(pairs.front().first), surface);
  auto corner = corners.begin();
  const Kernel::Point_3 a = surface.point(*corner++), b = surface.point(*corner++),
                        c = surface.point(*corner);
  return place_text(CGAL::centroid(a, b, c));
}

}  // namespace solidus::mesh
