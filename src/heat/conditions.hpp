/// Heat at the boundary and in the volume, as tables of time or temperature.
#pragma once

#include <string>
#include <vector>

#include "base/time_function.hpp"

namespace solidus::heat {

/// A coefficient that is a table of time [s] or of the surface's own temperature [K].
struct Coefficient {
  TimeFunction table;
  bool of_temperature = false;
};

/// The temperature of every node of a set follows Θ(t). Where two conditions meet, the later one in the list
/// holds.
struct PrescribedTemperature {
  std::string name;
  std::string node_set;  ///< a key of Mesh::node_sets
  TimeFunction value;    ///< [K] over time [s]
};

/// Heat per area into the body.
struct Flux {
  std::string name;
  std::string surface;  ///< a key of Mesh::surfaces
  TimeFunction value;   ///< [W/m²] over time [s]
};

/// q = h (Θ_a − Θ) into the body.
struct Film {
  std::string name;
  std::string surface;      ///< a key of Mesh::surfaces
  Coefficient coefficient;  ///< h [W/(m² K)], not negative
  TimeFunction ambient;     ///< Θ_a [K] over time [s]
};

/// Grey body in large surroundings: q = ε σ (Θ_a⁴ − Θ⁴) into the body.
struct Radiation {
  std::string name;
  std::string surface;     ///< a key of Mesh::surfaces
  Coefficient emissivity;  ///< ε, 0 to 1
  TimeFunction ambient;    ///< Θ_a [K] over time [s]
};

/// Heat released in the volume of a body.
struct Source {
  std::string name;
  std::string body;    ///< name of a body of the mesh
  TimeFunction power;  ///< [W/m³] over time [s]
};

/// Where nothing is said, a surface is insulated. Tables of time are taken at the end of the step (backward
/// Euler). `name` is for messages and history columns.
struct Conditions {
  std::vector<PrescribedTemperature> temperatures;
  std::vector<Flux> fluxes;
  std::vector<Film> films;
  std::vector<Radiation> radiations;
  std::vector<Source> sources;
  /// Names of the bodies that have gone: their elements conduct and store nothing, nodes of theirs alone keep
  /// their temperature, and conditions hold only where another body is.
  std::vector<std::string> absent_bodies;
};

}  // namespace solidus::heat
