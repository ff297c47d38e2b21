/// Faces that see each other, of all processes, as flat polygons, and their clusters.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"
#include "numbers/types.hpp"

namespace solidus::heat {

struct RadiatingFace {
  std::array<mesh::Point, 4> corners{};  ///< in three dimensions three or four, else the first two
  int n_corners = 0;
  mesh::Point normal{};  ///< out of the body, of length one
  mesh::Point middle{};
  double area = 0;  ///< with 2πr about an axis [m²]
  int surface = 0;  ///< number of the surface that it belongs to
  std::size_t cluster = 0;
};

/// The faces of some surfaces over all processes, in an order that does not depend on how many there are, and
/// where this process's own are among them.
struct RadiatingFaces {
  std::vector<RadiatingFace> all;
  /// Of each surface the number in `all` of each of its faces here, [surface][block and face in a row].
  std::vector<std::vector<std::size_t>> of_surface;
  std::size_t n_clusters = 0;
  std::optional<mesh::Point> twice;  ///< the middle of a face that is in two of the surfaces
};

/// Collects faces and makes at most so many clusters of them: faces of one surface that lie near each other
/// and look alike; where there are fewer faces, each is one by itself. Collective.
/// @param surfaces  with faces of this process, ghosts included
RadiatingFaces radiating_faces(const mesh::Mesh& mesh, AnalysisKind kind,
                               std::span<const mesh::Surface> surfaces, std::size_t most_clusters);

}  // namespace solidus::heat
