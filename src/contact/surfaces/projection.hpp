/// Projection of a point on one face: the closest point (monograph 3.4) and the point along a direction.
#pragma once

#include "contact/surfaces/face.hpp"

namespace solidus::contact {

struct Projection {
  bool found = false;   ///< the iteration converged to a point of the face (extended by the tolerance)
  Point xi{};           ///< reference coordinates ξ̄ on the face
  Point y{};            ///< the point ȳ = x(ξ̄) [m]
  double distance = 0;  ///< closest point: |p − ȳ|; along a direction d: (ȳ − p)·d, signed [m]
};

/// Edge `e` of a face as a line with its own nodes, from vertex e to the next.
Face edge_of(const Face& face, std::size_t e);

/// The closest point of the face, its edges and vertices included: minimises |x(ξ) − p| over the reference
/// shape by Newton's method with the exact Hessian, guarded by steepest-descent-like Gauss–Newton steps,
/// from the centre and, on curved faces, from the vertices too; edges by the same in one parameter.
/// Always `found`.
Projection closest_point(const Face& face, const Point& p);

/// The same without the limits of the face, from a start: the stationary point of the distance that Newton's
/// method finds, within four times the reference shape; `found` tells that it did.
Projection closest_point_extended(const Face& face, const Point& p, const Point& start);

/// The point of the face on the line p + s d, |d| = 1, by Newton's method in ξ. A point outside the face by
/// up to `tolerance` in reference coordinates counts as found, and ξ̄ is moved onto the face.
Projection project_along(const Face& face, const Point& p, const Point& d, double tolerance = 1e-9);

/// The same without the limits of the face: ξ̄ may lie anywhere the iteration converges to; `found` tells
/// that it did.
Projection project_along_extended(const Face& face, const Point& p, const Point& d);

}  // namespace solidus::contact
