/// Each shell is remeshed by itself, then all of them are checked together: they may not cross, and the
/// enclosed volume may not change.
#include "mesh/cgal/remeshed_skin.hpp"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "mesh/cgal/short_edges.hpp"
#include "mesh/cgal/surface.hpp"
#include "mesh/cgal/wrapped_surface.hpp"
#include "system/errors.hpp"

namespace solidus::mesh {

namespace {

namespace PMP = CGAL::Polygon_mesh_processing;

using Tree =
    CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_face_graph_triangle_primitive<TriangleSurface>>>;

/// Gives the edges of a closed surface one length, but for those that are kept for their angle.
void remesh(TriangleSurface& surface, double size, double angle) {
  constexpr unsigned k_rounds = 4, k_relaxations = 2;
  PMP::remove_degenerate_faces(surface);
  const auto sharp = surface.add_property_map<TriangleSurface::Edge_index, bool>("e:sharp", false).first;
  PMP::detect_sharp_edges(surface, angle, sharp);
  PMP::isotropic_remeshing(surface.faces(), size, surface,
                           PMP::parameters::number_of_iterations(k_rounds)
                               .edge_is_constrained_map(sharp)
                               .protect_constraints(false)
                               .number_of_relaxation_steps(k_relaxations));
  constexpr double k_short = 0.25;  // of the size: what is shorter spoils the elements at both of its ends
  collapse_short_edges(surface, k_short * size, sharp);
}

/// Whether a skin encloses what the facets do, to k_skin_tolerance.
bool keeps_volume(const TriangleSurface& skin, const TriangleSurface& facets) {
  const double wanted = std::abs(PMP::volume(facets));
  return std::abs(std::abs(PMP::volume(skin)) - wanted) <= k_skin_tolerance * wanted;
}

/// A new skin of one shell. Triangles that are long for a thin wall cut through it, or off a part of its
/// round: where a new skin crosses itself or loses volume, smaller ones are tried, and in the end the wrap as
/// it is, which never crosses itself.
/// @param size  of edges, in units of the file
TriangleSurface new_skin(const TriangleSurface& facets, const SkinRemeshing& how, double size) {
  constexpr std::array<double, 3> k_shares{1, 0.5, 0.25};
  TriangleSurface wrap, skin;
  bool crosses = false;
  for (const double share : k_shares) {
    if (how.wraps) wrap = wrapped_surface(facets, share * size);
    skin = how.wraps ? wrap : facets;
    remesh(skin, share * size, how.angle);
    crosses = !first_crossing(skin).empty();
    if (!crosses && keeps_volume(skin, facets)) break;
  }
  return how.wraps && crosses ? wrap : skin;
}

/// The largest distance of the corners of a surface, and of the middles of its triangles, from another one.
double distance_from(const TriangleSurface& from, const TriangleSurface& to) {
  Tree tree(to.faces().begin(), to.faces().end(), to);
  tree.accelerate_distance_queries();
  double most = 0;
  for (const TriangleSurface::Vertex_index v : from.vertices())
    most = std::max(most, tree.squared_distance(from.point(v)));
  for (const TriangleSurface::Face_index f : from.faces()) {
    const TriangleSurface::Halfedge_index h = from.halfedge(f);
    const Kernel::Point_3 middle = CGAL::centroid(from.point(from.source(h)), from.point(from.target(h)),
                                                  from.point(from.target(from.next(h))));
    most = std::max(most, tree.squared_distance(middle));
  }
  return std::sqrt(most);
}

/// A share of a whole as "-0.4 %".
std::string change_text(double value, double of) {
  return fmt::format("{:+.1f} %", 100 * (value / of - 1));
}

}  // namespace

RemeshedSkin remeshed_skin(const ClosedShells& all, const SkinRemeshing& how, const std::string& path) {
  RemeshedSkin made;
  TriangleSurface whole;
  SkinDeviation& d = made.deviation;
  // Each shell for itself; cavities count as negative volume.
  for (std::size_t s = 0; s < all.shells.size(); ++s) {
    const TriangleSurface facets = surface_of(all, all.shells[s]);
    const TriangleSurface skin = new_skin(facets, how, how.sizes[s]);
    const double sign = all.shells[s].depth % 2 == 0 ? 1 : -1;
    d.facets_volume += sign * std::abs(PMP::volume(facets));
    d.volume += sign * std::abs(PMP::volume(skin));
    d.facets_area += PMP::area(facets);
    d.area += PMP::area(skin);
    // The distance between both skins is measured both ways, since either may leave out a detail of
    // the other.
    d.distance = std::max({d.distance, distance_from(skin, facets), distance_from(facets, skin)});
    append_shells(skin, all.shells[s].name, made.shells);
    CGAL::copy_face_graph(skin, whole);
  }
  // The new skin must neither cross itself nor enclose another volume.
  if (const std::string place = first_crossing(whole); !place.empty())
    throw InputError({path}, "the new skin crosses itself near " + place);
  // Volume is the measure that matters for heat: a wall that is thinned by meshing cools faster.
  if (std::abs(d.volume - d.facets_volume) > k_skin_tolerance * d.facets_volume)
    throw InputError({path}, fmt::format("the new skin encloses another volume than the facets, by {}",
                                         change_text(d.volume, d.facets_volume)));
  nest_shells(made.shells);
  return made;
}

std::string deviation_text(const RemeshedSkin& skin, double unit) {
  const SkinDeviation& d = skin.deviation;
  std::size_t triangles = 0;
  for (const Shell& shell : skin.shells.shells) triangles += shell.triangles.size();
  return fmt::format(
      "a new skin of {} triangles stands for the facets: it encloses {:.4g} cm3 ({} of theirs), has {:.4g} "
      "cm2 "
      "({}), and neither lies farther than {:.2g} mm from the other",
      triangles, 1e6 * unit * unit * unit * d.volume, change_text(d.volume, d.facets_volume),
      1e4 * unit * unit * d.area, change_text(d.area, d.facets_area), 1e3 * unit * d.distance);
}

}  // namespace solidus::mesh
