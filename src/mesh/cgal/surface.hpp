/// Shells of triangles as surfaces of CGAL. For the sources of this folder alone: CGAL is under the GPL, as
/// Gmsh is, and only the reader of meshes is linked with either.
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include "mesh/making/closed_shells.hpp"

namespace solidus::mesh {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using TriangleSurface = CGAL::Surface_mesh<Kernel::Point_3>;

/// The triangles of a shell; corners in which parts of it meet in a point alone are one for each part.
TriangleSurface surface_of(const ClosedShells& all, const Shell& shell);

/// Appends the connected parts of a closed surface as shells with a name; nothing is known of what lies
/// inside of what (nest_shells()).
void append_shells(const TriangleSurface& surface, const std::string& name, ClosedShells& all);

/// "(12.3, 4, 5)": a place for messages.
std::string place_text(const Kernel::Point_3& p);

/// The middle of the first triangle that meets another one of the surface otherwise than in a common edge or
/// corner; empty text where there is none.
std::string first_crossing(const TriangleSurface& surface);

}  // namespace solidus::mesh
