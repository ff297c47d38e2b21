/// The list of ways in the order in which they are tried.
#include "mesh/making/meshing_ways.hpp"

#include <iterator>

namespace solidus::mesh {

namespace {

// Elements that become as small as a narrow face is may themselves be what is poor: the second way leaves
// them out. Cutting helps where Gmsh finds no mesh of a closed face, and else gives what the first way gave.
constexpr SolidWay k_solid_ways[] = {
    {"as the file is, Delaunay"},
    {"without smaller elements at narrow faces", 6, 1, 0, 1, 4, false},
    {"HXT", 6, 10},
    {"elements of 0.9 of the size", 6, 1, 0, 0.9, 4},
    {"healed, elements of 0.8 of the size", 6, 1, 1e-5, 0.8, 4},
    {"bodies cut along the seams of closed faces", 6, 1, 0, 1, 4, true, true},
    {"healed more, surfaces by MeshAdapt, elements of 0.7 of the size", 1, 1, 1e-4, 0.7, 4},
    {"surfaces by Delaunay, HXT, elements of half the size", 5, 10, 0, 0.5, 4},
    {"healed much, elements of half the size", 6, 1, 1e-3, 0.5, 4}};

constexpr FacetedWay k_faceted_ways[] = {
    {"a new skin, edges of 40 degrees", 40, 1, 1},
    {"a new skin, edges of 40 degrees, HXT", 40, 10, 1},
    {"a new skin, edges of 20 degrees, elements of 0.8 of the size", 20, 1, 0.8},
    {"the triangles of the file", 0, 1, 1},
    {"the triangles of the file, HXT", 0, 10, 1},
    {"a new skin by remeshing", 40, 1, 1, SkinOf::remeshing},
    {"a new skin by remeshing, elements of 0.6 of the size, HXT", 40, 10, 0.6, SkinOf::remeshing},
    {"a new skin around a wrap", 40, 1, 1, SkinOf::wrap}};

constexpr int k_faceted_order[] = {0, 5, 1, 2, 6, 3, 7, 4};
static_assert(std::size(k_faceted_order) == std::size(k_faceted_ways));

}  // namespace

std::span<const SolidWay> solid_ways() {
  return k_solid_ways;
}

std::span<const FacetedWay> faceted_ways() {
  return k_faceted_ways;
}

std::span<const int> faceted_order() {
  return k_faceted_order;
}

bool is_cheap(const SolidWay& way) {
  constexpr double k_fine = 0.8;
  return way.scale >= k_fine && !way.cuts;
}

}  // namespace solidus::mesh
