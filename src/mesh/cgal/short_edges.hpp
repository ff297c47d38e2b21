/// Edges of a surface that are far shorter than the elements that it is for. For the sources of this folder
/// alone.
#pragma once

#include "mesh/cgal/surface.hpp"

namespace solidus::mesh {

/// Draws the ends of edges shorter than a length together where no triangle turns over by it and the surface
/// stays closed and does not cross itself; where it would, only edges of 0.4 or 0.1 of the length are taken
/// away, or none. Of the two ends that one stays at which more edges meet that are kept for their angle.
/// @param sharp  whether an edge is one of these
void collapse_short_edges(TriangleSurface& surface, double length,
                          const TriangleSurface::Property_map<TriangleSurface::Edge_index, bool>& sharp);

}  // namespace solidus::mesh
