/// Heat at the boundary and in the volume, as functions of position and time or tables of temperature.
///
/// Positions are those of the mesh, which deformation does not move.
#pragma once

#include <string>
#include <vector>

#include "heat/loads/channel_film.hpp"
#include "heat/loads/channel_fluid.hpp"
#include "heat/loads/exothermic.hpp"
#include "numbers/place_function.hpp"

namespace solidus::heat {

/// A coefficient that is a function of position and time [s] or a table of the surface's own temperature [K].
struct Coefficient {
  PlaceFunction table;
  bool of_temperature = false;
};

/// The temperature of every node of a set follows Θ(t). Where two conditions meet, the later one in the list
/// holds.
struct PrescribedTemperature {
  std::string name;
  std::string node_set;  ///< a key of Mesh::node_sets
  PlaceFunction value;   ///< [K]
};

/// Heat per area into the body, value × factor.
struct Flux {
  std::string name;
  std::string surface;  ///< a key of Mesh::surfaces
  PlaceFunction value;  ///< [W/m²]
  PlaceFunction factor = 1.0;
};

/// q = factor × h (Θ_a − Θ) into the body.
struct Film {
  std::string name;
  std::string surface;      ///< a key of Mesh::surfaces
  Coefficient coefficient;  ///< h [W/(m² K)], not negative
  PlaceFunction ambient;    ///< Θ_a [K]
  PlaceFunction factor = 1.0;
};

/// Grey body in large surroundings: q = factor × ε σ (Θ_a⁴ − Θ⁴) into the body.
struct Radiation {
  std::string name;
  std::string surface;     ///< a key of Mesh::surfaces
  Coefficient emissivity;  ///< ε, 0 to 1
  PlaceFunction ambient;   ///< Θ_a [K]; of an enclosure that of its opening, the same everywhere
  PlaceFunction factor = 1.0;
  /// It sees the other surfaces that are enclosed (radiation/enclosure.hpp); emissivity and factor are the
  /// same everywhere then.
  bool enclosed = false;
};

/// Heat released in the volume of a body, power × factor.
struct Source {
  std::string name;
  std::string body;     ///< name of a body of the mesh
  PlaceFunction power;  ///< [W/m³]
  PlaceFunction factor = 1.0;
};

/// A cooling channel that is a line in the mesh (channels/channels.hpp).
struct Channel {
  std::string name;
  std::string body;            ///< name of a body of the mesh
  std::vector<Position> path;  ///< corners of the way [m]; in two dimensions places of bores or rings
  double diameter = 0;         ///< [m]
  PlaceFunction flow;          ///< mass flow [kg/s], or volume flow [m³/s]; the same everywhere
  bool by_volume = false;      ///< which of the two; the density is that at the inlet
  PlaceFunction inlet;         ///< Θ of what comes in [K], the same everywhere
  ChannelFluid fluid;
  ChannelLaw law = ChannelLaw::gnielinski;
  double laminar = 3.66;  ///< Nu of laminar flow
  double share = 1;       ///< of the channel that is in the model: one half in a plane of symmetry
  std::string after;      ///< the channel, earlier in the list, whose outlet feeds it; empty: none
};

/// Thermal conditions of a model. A surface without a condition is insulated. Functions of time are taken at
/// the end of the step (backward Euler). `name` is for messages and history columns.
struct ThermalConditions {
  std::vector<PrescribedTemperature> temperatures;
  std::vector<Flux> fluxes;
  std::vector<Film> films;
  std::vector<Radiation> radiations;
  std::vector<Source> sources;
  std::vector<Exothermic> exothermics;
  std::vector<Channel> channels;
  /// Names of the bodies that have been removed: their elements neither conduct nor store heat, nodes that
  /// belong to them alone keep their temperature, and conditions hold only where another body is.
  std::vector<std::string> absent_bodies;
};

}  // namespace solidus::heat
