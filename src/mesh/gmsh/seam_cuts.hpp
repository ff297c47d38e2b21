/// Cuts the bodies of a geometry where a face closes upon itself, as that of a whole cylinder does. In the
/// reader's process, while Gmsh has the geometry open.
///
/// Gmsh meshes such a face in its parameters, which jump at its seam; where other faces touch the face
/// next to the seam it may find no mesh ("Impossible to mesh periodic surface"). Halves of the face have no
/// seam.
#pragma once

#include <set>
#include <vector>

#include "mesh/gmsh/casting_parts.hpp"

namespace solidus::mesh {

/// Cuts all bodies by a plane through the seam and the centre of each of these faces that has a seam, so that
/// a body becomes several volumes that share the faces of the cut. Volumes and faces get other numbers.
/// @param faces  numbers of surfaces
/// Returns whether a body was cut.
bool cut_along_seams(std::vector<BodyVolumes>& parts, const std::set<int>& faces);

}  // namespace solidus::mesh
