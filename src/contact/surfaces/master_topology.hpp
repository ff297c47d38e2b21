/// Topology of a surface: neighbours of its faces over edges and around vertices, and its free boundaries.
#pragma once

#include <span>
#include <vector>

#include "contact/surfaces/surface.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::contact {

/// The part of a face's rim that a point of it lies on.
struct Feature {
  enum class Kind { interior, edge, vertex } kind = Kind::interior;
  int local = 0;                 ///< number of the edge or vertex in the face
  std::span<const Index> faces;  ///< that share it, sorted
  bool free = false;             ///< it lies on the free boundary of the surface
};

class MasterTopology {
 public:
  explicit MasterTopology(const ContactSurface& surface);
  /// The face and those that share a node with it, sorted.
  std::span<const Index> around(Index face) const { return row(around_, first_around_, face); }
  /// Returns the edge or vertex of the face that ξ lies on, or its interior, with a tolerance of 1e-12. The
  /// vertices of lines are vertices.
  Feature feature(Index face, const Point& xi) const;
  /// The local number of a node in a face, −1 when it is not there.
  int local_vertex(Index face, Index node) const;
  /// Node of a face's vertex.
  Index vertex(Index face, int local) const;
  int n_edges(Index face) const;  ///< zero for lines
  /// The faces at edge `e`: one, or two; a free edge has one.
  std::span<const Index> at_edge(Index face, int e) const;

 private:
  static std::span<const Index> row(const std::vector<Index>& data, const std::vector<std::size_t>& first,
                                    Index i) {
    const auto k = as_size(i);
    return std::span(data).subspan(first[k], first[k + 1] - first[k]);
  }
  std::size_t slot(Index face, int local) const { return as_size(face) * 4 + as_size(local); }
  const ContactSurface& surface_;
  std::vector<Index> around_, at_vertex_, at_edge_;
  std::vector<std::size_t> first_around_, first_at_vertex_, first_at_edge_;
  std::vector<Index> vertex_row_;  ///< [face][4]
  std::vector<char> free_vertex_;  ///< [vertex row]
};

/// The direction of edge `e` of a shape in reference coordinates.
Point edge_direction(mesh::Shape shape, int e);

}  // namespace solidus::contact
