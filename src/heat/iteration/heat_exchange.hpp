/// Heat that depends on temperatures elsewhere, radiation between surfaces and the fluid of channels, which
/// follow from the temperatures of the nodes by iterations; and what surfaces and sources bring along.
#pragma once

#include <span>

#include "heat/iteration/heat_parts.hpp"

namespace solidus::heat {

/// Computes, from these temperatures, the loads that depend on temperatures elsewhere: radiation between
/// surfaces and the fluid of channels. Collective.
void begin_exchange(HeatParts& parts, std::span<const double> temperature);
/// Ends an iteration of it (EnclosedSurfaces::follow, Channels::follow) after a HeatSystem::residual() at
/// these temperatures: powers and entropy of that residual are with the new exchange then.
/// @param tolerance, tolerance_of_fluid  of radiation and of channels [K]
/// @param change  set to the heat that this brings the nodes beyond what they had, [owned node] [W]
/// Returns whether all of it has settled. Collective.
bool follow_exchange(HeatParts& parts, std::span<const double> temperature, double tolerance,
                     double tolerance_of_fluid, std::span<double> change);
/// Entropy that surfaces and sources brought with their heat at the last residual(), at the temperatures of
/// the bodies there; this process's share [W/K].
double entropy_power(const HeatParts& parts, std::span<const double> temperature);
/// Memory of the parts.
std::size_t bytes(const HeatParts& parts);

}  // namespace solidus::heat
