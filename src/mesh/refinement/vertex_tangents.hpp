/// The directions in which a smooth surface, or the line where two of them meet, leaves its vertices along
/// the edges of a skin.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "mesh/mesh.hpp"

namespace solidus::mesh {

/// An edge of the skin, with what this process knows of its ends.
struct SkinEdge {
  Index a = -1, b = -1;  ///< its vertices; the one with the lower number in the input first
  bool is_line = false;  ///< the skin has no one smooth surface here; in the plane: always
  /// Unit tangents at the two ends, from a to b, of ends that this process owns. Absent: the line has none
  /// there, or the end is another process's.
  std::optional<Point> tangent_a, tangent_b;
};

/// @param skin  faces of a part's skin (skin_faces), linear
std::vector<SkinEdge> skin_edges(const Mesh& mesh, const std::vector<ElementBlock>& skin);

}  // namespace solidus::mesh
