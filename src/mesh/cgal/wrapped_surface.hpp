/// A closed surface around another one that may cross itself. For the sources of this folder alone.
#pragma once

#include "mesh/cgal/surface.hpp"

namespace solidus::mesh {

/// Wraps a surface from outside and draws the wrap back onto it. What is hollow and has no opening wider than
/// `size` is filled.
/// @param size  of the elements that the wrap is for, in units of the file
TriangleSurface wrapped_surface(const TriangleSurface& facets, double size);

}  // namespace solidus::mesh
