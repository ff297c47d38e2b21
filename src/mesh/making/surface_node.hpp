/// A node of a mesh of tetrahedra in the surfaces of its bodies, and where it may go in them. Rank 0 only.
#pragma once

#include <set>
#include <vector>

#include "mesh/tetrahedra.hpp"

namespace solidus::mesh {

/// The normal of a face, out of the body of the lower number, times twice the area [m²].
Point normal_of(const Tetrahedra& mesh, const SurfaceFace& face);

/// Neighbours of a node in the surfaces, and along the curves in which surfaces meet or turn by more than 30
/// degrees.
class SurfaceNode {
 public:
  SurfaceNode(const Tetrahedra& mesh, Index node);

  const std::vector<SurfaceFace>& faces() const { return faces_; }
  const std::set<Index>& on_surface() const { return on_surface_; }
  const std::set<Index>& on_curves() const { return on_curves_; }
  /// 0: on no curve, 1: on one, 2: where curves meet or end.
  int importance() const { return on_curves_.empty() ? 0 : on_curves_.size() == 2 ? 1 : 2; }

  /// Places at about a distance from the node that it may be moved to with the bodies' shapes kept up to the
  /// height of the surface over its chords: along the axes inside a body, tangentially and onto the faces
  /// around on a surface, along its edges on a curve that turns by less than 30 degrees; none where curves
  /// meet.
  /// @param step  [m]
  std::vector<Point> places(double step) const;

  /// Whether the faces at the node look to the side that they looked to when this was made: none has folded,
  /// or turned by more than 30 degrees from the mean of its neighbours (15 from itself at a curve).
  bool keeps_surface() const;

 private:
  std::vector<Point> on_surface(double step) const;
  std::vector<Point> on_curve(double step) const;

  const Tetrahedra& mesh_;
  Index node_;
  std::vector<SurfaceFace> faces_;
  std::set<Index> on_surface_, on_curves_;
  std::vector<Point> normals_;  ///< of the faces as they were, of length one
  Point mean_{};                ///< of these, by area
  double turned_ = 1;           ///< the least cosine between one of them and the mean
};

}  // namespace solidus::mesh
