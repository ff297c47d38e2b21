/// Curvature of a contact surface, and the plane gap that resists heat as a gap along a curved face does.
///
/// Heat that crosses a gap of the width g goes along the normals, which spread where the face is convex: at
/// the distance s from the face the area is a(s) = (1 + κ_1 s)(1 + κ_2 s) of that on the face. With one
/// conductivity in the gap its resistance per area of the face is that of a plane gap of the width
///
///   g' = ∫_0^g ds/a(s) = [ln(1 + κ_1 g) − ln(1 + κ_2 g)]/(κ_1 − κ_2)
///
/// which for concentric cylinders is r_1 ln(r_2/r_1) and for spheres r_1 (r_2 − r_1)/r_2, whichever of the
/// two faces it is counted from. κ_1, κ_2 principal curvatures, positive where the face is convex (seen from
/// the gap) [1/m].
#pragma once

#include <vector>

#include "contact/surfaces/surface.hpp"
#include "numbers/types.hpp"

namespace solidus::contact {

struct SurfaceCurvature {
  double first = 0, second = 0;  ///< κ_1, κ_2 [1/m]

  /// a(s): the area at a distance from the face over that on it; at least k_least_area.
  double area(double distance) const;
  /// g' [m]; a gap that is closed or penetrated stays as it is.
  double plane_gap(double gap) const;
  /// da/ds [1/m].
  double area_slope(double distance) const;
  /// dg'/dg = 1/a(g).
  double plane_gap_slope(double gap) const { return gap > 0 ? 1 / area(gap) : 1; }

  /// Normals of a concave face meet where 1 + κ s = 0; no gap reaches nearer to that place than this.
  static constexpr double k_least_area = 0.05;
};

/// The symmetric S of n(x + d) − n(x) ≈ S d in the tangent plane at the centre of a face [1/m].
struct ShapeOperator {
  Point along{}, across{};           ///< unit vectors of the tangent plane
  double s11 = 0, s12 = 0, s22 = 0;  ///< components of S in them
  /// How far the turn towards every single neighbour agrees with S, 0 to 1: below one at the end of a curved
  /// part, where some neighbours stand in a plane with the face.
  double agreement = 1;

  /// dᵀ S d.
  double turn_along(const Point& d) const;
};

/// S of every face in the reference configuration by least squares over the faces that share a node with it
/// and stand at less than `feature_angle` to it [rad]: from the normals at their centres, of triangles from a
/// quadric through their nodes.
std::vector<ShapeOperator> shape_operators(const ContactSurface& surface, double feature_angle);

/// The curvatures of every face in the reference configuration, of its shape operator. Zero where they are
/// those of a plane.
std::vector<SurfaceCurvature> surface_curvatures(const ContactSurface& surface, AnalysisKind kind,
                                                 double feature_angle);

}  // namespace solidus::contact
