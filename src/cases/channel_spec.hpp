/// A cooling channel as the case gives it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cases/load_spec.hpp"
#include "heat/loads/channel_film.hpp"
#include "input/keys.hpp"
#include "system/errors.hpp"

namespace solidus::cases {

/// The way of a channel: a file of points, or their coordinates one list each.
struct ChannelPathSpec {
  std::string file;             ///< empty: the lists
  std::vector<double> x, y, z;  ///< [m]; axisymmetric: x the radius, y along the axis
};

/// setup/channel_input.hpp makes the condition of the heat room of it.
struct ChannelSpec {
  enum class Fluid { water, given };
  std::string name, body;  ///< body: group of the mesh
  ChannelPathSpec path;
  double diameter = 0;                      ///< [m]
  std::optional<Function> flow, mass_flow;  ///< of time [m³/s], [kg/s]
  std::optional<Function> inlet;            ///< of time [K]
  std::string after;                        ///< the channel whose outlet feeds it; empty: none
  Fluid fluid = Fluid::water;
  Function density, specific_heat, conductivity, viscosity;  ///< of a given fluid, of temperature
  heat::ChannelLaw law = heat::ChannelLaw::gnielinski;
  double laminar = 0;               ///< Nu
  double share = 1;                 ///< of the channel that is in the model
  double pressure = 0;              ///< absolute [Pa]
  std::vector<std::string> stages;  ///< in which it flows; empty: all
  TimeOrigin clock = TimeOrigin::run;
  SourceLocation where;
};

}  // namespace solidus::cases
