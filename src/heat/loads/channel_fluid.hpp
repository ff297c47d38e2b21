/// What flows in a cooling channel: density, heat capacity, conductivity and viscosity by temperature.
#pragma once

#include "numbers/table.hpp"

namespace solidus::heat {

struct ChannelFluid {
  Table density;        ///< ρ(Θ) [kg/m³]
  Table specific_heat;  ///< c(Θ) [J/(kg K)]
  Table conductivity;   ///< k(Θ) [W/(m K)]
  Table viscosity;      ///< μ(Θ), dynamic [Pa s]

  /// Pr = μ c/k.
  double prandtl(double temperature) const;
  /// The temperature to which a fluid at `from` comes with so much heat per mass [J/kg]: ∫ c dΘ equals it.
  double heated(double from, double heat) const;
};

/// Liquid water on its line of saturation from 0 to 250 °C; pressures of a cooling circuit change none of
/// these by a tenth of a percent. Source: IAPWS R7-97(2012) for density and heat capacity, R12-08 for the
/// viscosity, R15-11 for the conductivity, evaluated at the points of the tables.
const ChannelFluid& water();

/// The temperature at which water boils at an absolute pressure from 612 Pa to 22.06 MPa [K]: equation 31 of
/// IAPWS R7-97(2012). Pressures beyond are taken as the nearest of these.
double boiling_point_of_water(double pressure);

}  // namespace solidus::heat
