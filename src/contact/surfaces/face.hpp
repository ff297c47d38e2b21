/// One face of a contact surface with the coordinates of its nodes: placement, tangents, normal, measure.
#pragma once

#include <array>
#include <cassert>
#include <span>

#include "contact/surfaces/vector.hpp"
#include "mesh/shape.hpp"

namespace solidus::contact {

inline constexpr int k_max_face_nodes = 8;  ///< quad8

/// Shapes line2, line3 (in the plane of a 2-D mesh), tri3, tri6, quad4, quad8. Value type, no allocation.
struct Face {
  mesh::Shape shape = mesh::Shape::line2;
  int n_nodes = 0;
  std::array<Point, k_max_face_nodes> x{};  ///< coordinates of the nodes [m]

  int dimension() const { return mesh::dimension(shape); }
  /// x(ξ) [m] (monograph 3.1).
  Point at(const Point& xi) const;
  /// The convected basis ∂x/∂ξ_α (3.2). For lines the second vector is e_z, so that the cross product of
  /// both is the outward normal of a 2-D body whose boundary runs anticlockwise.
  std::array<Point, 2> tangents(const Point& xi) const;
  /// ∂²x/∂ξ_α∂ξ_β in the order 11, 22, 12.
  std::array<Point, 3> curvatures(const Point& xi) const;
  /// Unit outward normal (3.10).
  Point normal(const Point& xi) const;
  /// Surface measure |∂x/∂ξ_1 × ∂x/∂ξ_2| per reference measure [m] or [m²].
  double jacobian(const Point& xi) const;
  /// Length or area [m], [m²], by Gauss quadrature.
  double measure() const;
  /// A length that tells the face's size: its length or the square root of its area [m].
  double size() const;
  /// The distance by which rounding of its coordinates moves a place, in reference coordinates: of a face far
  /// from the origin more than the last places of ξ.
  double rounding() const;
  /// The corners of its bounding box; of curved faces a bound that holds for moderate curvature.
  std::array<Point, 2> box() const;
  /// True when x(ξ) is affine in ξ up to rounding: simplices and parallelograms with straight edges.
  bool affine() const;
  /// True when the edges are straight with their mid nodes in the middle (always for linear shapes).
  bool straight_edges() const;
};

/// Two faces look at each other when the angle between one normal and the reverse of the other is below 72°;
/// the walls of a right-angled corner do not.
inline constexpr double k_facing_cosine = -0.3;

/// The reference coordinates of the centre and of the vertices of a face shape.
Point reference_centre(mesh::Shape shape);
std::span<const Point> reference_vertices(mesh::Shape shape);
/// Distance of ξ from the reference shape (zero inside), in reference units.
double outside_by(mesh::Shape shape, const Point& xi);
/// Its derivatives with respect to ξ; zero within.
std::array<double, 2> outside_by_xi(mesh::Shape shape, const Point& xi);
/// The nearest point of the reference shape in the sense of reference coordinates.
Point clamp(mesh::Shape shape, Point xi);

}  // namespace solidus::contact
