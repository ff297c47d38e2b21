/// Ways of meshing a geometry, which mesh_casting() (casting_geometry.hpp) tries one after the other.
#pragma once

#include <cstddef>
#include <span>

#include "numbers/index_casts.hpp"

namespace solidus::mesh {

/// A way to mesh solids of a CAD program.
struct SolidWay {
  const char* what;               ///< for messages: "healed, elements of 0.8 of the size"
  int surfaces = 6, volumes = 1;  ///< Gmsh's numbers of algorithms: frontal, Delaunay
  double healing = 0;             ///< tolerance, of the extent of the parts; 0: none
  double scale = 1;               ///< of all sizes
  int rounds = 1;                 ///< of optimisation
  bool details = true;            ///< smaller elements at narrow faces and short curves
  bool cuts = false;              ///< bodies are cut along the seams of faces that cannot be meshed
};

/// The library that makes new triangles of facets: Gmsh, which needs minutes where facets are many or long;
/// CGAL, of one size on each skin (mesh/cgal/remeshed_skin.hpp); CGAL on a wrap around them, where they cross
/// each other.
enum class SkinOf { gmsh, remeshing, wrap };

/// A way to mesh what skins of triangles enclose.
struct FacetedWay {
  const char* what;
  double angle = 0;  ///< of edges between faces that get new elements [degree]; 0: triangles stay
  int volumes = 1;   ///< Gmsh's number of the algorithm
  double scale = 1;  ///< of all sizes
  SkinOf skin = SkinOf::gmsh;
};

/// All ways, by number; solids are meshed in this order.
std::span<const SolidWay> solid_ways();
std::span<const FacetedWay> faceted_ways();
/// The numbers of all ways to mesh skins, in the order in which they are tried: numbers are written in case
/// files and stay.
std::span<const int> faceted_order();
/// Processor time that Gmsh has to make new skins of facets, in all ways together [s]: beyond it CGAL makes
/// them.
inline constexpr double k_time_of_direct_ways = 120;
/// Whether a way is tried whatever the quality of the meshes before is.
bool is_cheap(const SolidWay& way);

/// The way of an attempt, from zero; the last one beyond.
template <class Way>
const Way& way_of(std::span<const Way> ways, int attempt) {
  const auto asked = as_size(attempt);
  return asked < ways.size() ? ways[asked] : ways.back();
}

}  // namespace solidus::mesh
