/// Loads that follow from a few numbers of the case and the place: the pressure of a melt that is no part of
/// the mesh, and the force of what turns.
#pragma once

#include <array>

#include "numbers/place_function.hpp"

namespace solidus::setup {

/// p = ρ g (l(t) − h) + p_0(t) where the place lies below the level, h < l, and zero above it; h = −x·g/|g|.
/// @param gravity  acceleration [m/s²], not zero
/// @param density  ρ [kg/m³]
/// @param level    l [m] of time
/// @param squeeze  p_0 [Pa] of time
PlaceFunction metallostatic_pressure(const std::array<double, 3>& gravity, double density, TimeFunction level,
                                     TimeFunction squeeze);

/// Component i of the acceleration ω(t)² r of what turns, r from the axis to the place [m/s²].
/// @param axis   of length one
/// @param point  of the axis [m]
PlaceFunction centrifugal_acceleration(const TimeFunction& omega, const std::array<double, 3>& axis,
                                       const std::array<double, 3>& point, std::size_t component);

}  // namespace solidus::setup
