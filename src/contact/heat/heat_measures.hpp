/// Heat that the points of an interface conduct, store and pass on at given temperatures: for results, for
/// the balance of a step, and for other gaps than those of the points. Functions of the points alone.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "contact/heat/heat_points.hpp"

namespace solidus::contact {

/// Heat into the bodies at a point, slave and master [W/m²]: in all, and the part of it by friction, that is
/// beyond conduction and radiation between the two surfaces as they are. What friction makes less what the
/// interface stores.
struct InterfaceHeatFlux {
  std::array<double, 2> total{}, by_friction{};
};

/// Heat dissipated and stored in the interface in a step, over the points that this process counts [J].
struct InterfaceHeat {
  double dissipated = 0;  ///< Σ w D_c,mech Δt
  double stored = 0;      ///< Σ w Θ_c (S^e_c − S^e_c,n)
};

/// Returns the heat fluxes of every point at these temperatures; zero where there is no partner.
std::vector<InterfaceHeatFlux> surface_heat(const HeatPoints& points, std::span<const double> temperature);
/// Its integral over the points that this process counts [W].
InterfaceHeatFlux counted_heat(const HeatPoints& points, std::span<const double> temperature);
/// h [W/(m² K)] of every point at these temperatures; without any, at room temperature.
std::vector<double> conductances(const HeatPoints& points, std::span<const double> temperature);
/// The gaps of the points, as they are placed: [point].
std::vector<HeatGap> gaps_of(const HeatPoints& points);
/// Conducts through other gaps until the next HeatPoints::place(), wherever a point has a partner in both,
/// [point].
void set_gaps(std::span<const HeatGap> gaps, HeatPoints& points);
/// The heat that passes at these temperatures through the gaps `used` instead of the right ones, over the
/// points that this process counts.
GapHeat gap_heat(const HeatPoints& points, std::span<const HeatGap> used, std::span<const HeatGap> right,
                 std::span<const double> temperature);
/// Θ_c of every point at these temperatures [K]; where friction does not act, as it was at t_n.
std::vector<double> interface_temperatures(const HeatPoints& points, std::span<const double> temperature);
/// Returns the heat of the interface over the phase, at the temperatures of its end. The heat of a point
/// without a partner goes to no body.
InterfaceHeat interface_heat(const HeatPoints& points, std::span<const double> temperature);

}  // namespace solidus::contact
