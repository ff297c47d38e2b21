/// The heat that passes at one contact point between the nodes around it, and its derivatives: functions of
/// what the points say of it (heat_points.hpp).
#pragma once

#include <array>
#include <span>
#include <vector>

#include "contact/interface/heat_transfer.hpp"
#include "contact/interface/interface_thermodynamics.hpp"
#include "numbers/types.hpp"

namespace solidus::contact {

/// The heat that passes at one contact point, with its derivatives.
struct HeatAtPoint {
  Index point = 0;
  std::span<const Index> nodes;
  std::span<const double> b;  ///< B of every node, of functions that are positive in a limited exchange
  std::size_t n_slave = 0;    ///< nodes
  bool nodal = false;         ///< the form
  bool limited = false;       ///< its functions are positive shares
  bool master_takes_heat = true;
  double slave = 0, master = 0;                ///< Θ_s, Θ_m
  double slave_fourth = 0, master_fourth = 0;  ///< Σ N Θ⁴
  Conductance h;
  double radiation = 0;  ///< e
  bool has_temperature = false;
  double slave_resistance = 0.5;  ///< s, with a temperature; its slope is left out of the tangent
  InterfaceResponse interface;    ///< with a temperature
  FrictionResponse friction;      ///< slip that this phase finds, of the whole step
  double dissipation = 0;         ///< D_c,mech Δt of the whole step [J/m²]
};
/// Adds `weight_h` × h' + `weight_e` × e' of the heat that every node gives off by conduction and radiation.
void add_exchange(const HeatAtPoint& at, std::span<const double> temperature, double weight_h,
                  double weight_e, std::span<double> heat);
/// Adds per-side fluxes by the shape functions.
void add_sides(const HeatAtPoint& at, const std::array<double, 2>& flux, std::span<double> heat);
/// Adds the heat that every node gives off at a point of the given weight.
void add_point_heat(const HeatAtPoint& at, std::span<const double> temperature, double weight,
                    std::span<double> heat);
/// Derivatives with respect to h of the fluxes Q_1 and Q_2 of the balance at fixed Θ_s, Θ_m, less those of
/// conduction.
std::array<double, 2> flux_by_conductance(const HeatAtPoint& at);
/// Adds the derivative of add_point_heat() by the nodal temperatures, [node][node].
/// @param per_h  scratch
void add_point_tangent(const HeatAtPoint& at, std::span<const double> temperature, double weight,
                       std::span<double> k, std::vector<double>& per_h);

}  // namespace solidus::contact
