/// Where an upright cylinder stands on a part, and how wide it is.
#pragma once

#include <optional>

#include "mesh/making/hot_spots.hpp"
#include "new_case/new_case_text.hpp"

namespace solidus::new_case {

/// Thickness of what is no metal above a place, up to the first metal above that, as sand under a handle
/// [m]; none where it is thinner than a tenth of the place.
std::optional<double> hollow_above(const mesh::ViewFromAbove& view, const mesh::InscribedSphere& place);

/// Diameter of a cylinder that is 1.5 diameters high [m].
/// @param modulus    of the place that it feeds [m]
/// @param metal      volume that it feeds [m³]
/// @param shrinkage  of the alloy when it freezes, a share of its volume, positive
double riser_diameter(double modulus, double metal, double shrinkage);

/// A cylinder over a place, which it covers.
/// @param fixed  coordinate that has to stay as it is; none: -1
DraftRiser cylinder_on(const mesh::ViewFromAbove& view, const mesh::Point& place, double diameter, int fixed);

}  // namespace solidus::new_case
