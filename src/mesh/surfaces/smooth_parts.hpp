/// Parts of a skin within which neighbours bend by little.
#pragma once

#include <set>
#include <utility>
#include <vector>

#include "mesh/surfaces/skin.hpp"

namespace solidus::mesh {

/// The number of the smooth part of each face, by edges (in the plane: points) that neighbours share, and
/// which parts meet in an edge. Numbers are those of faces: not in a row.
struct SmoothParts {
  std::vector<std::size_t> of_face;
  std::set<std::pair<std::size_t, std::size_t>> meet;
};

/// @param angle  by which neighbours of one part bend at most [rad]
/// @param drawn  smooth faces of the geometry (RawMesh::drawn_faces): neighbours of the same one are of one
///               part whatever they bend by
SmoothParts smooth_parts(const std::vector<const SkinFace*>& faces, double angle,
                         const std::vector<DrawnFace>& drawn = {});

}  // namespace solidus::mesh
