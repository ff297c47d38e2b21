/// Convex polygons in a plane: clipping and area, for the segments of contact between two faces.
#pragma once

#include <array>
#include <vector>

namespace solidus::contact {

using PlanePoint = std::array<double, 2>;
/// Vertices anticlockwise; convex.
using Polygon = std::vector<PlanePoint>;

/// Area, positive for anticlockwise vertices.
double signed_area(const Polygon& polygon);
PlanePoint centroid(const Polygon& polygon);
/// The part of `subject` inside the convex polygon `window` (Sutherland and Hodgman 1974). Vertices nearer
/// than `tolerance` to an edge of the window count as on it. Empty when they do not overlap.
Polygon clip(const Polygon& subject, const Polygon& window, double tolerance);

}  // namespace solidus::contact
