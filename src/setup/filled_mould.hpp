/// The start of a run from a mould that has been filled (docs/guide/filling.md): the folder of a filling
/// holds the temperatures of each body that is cast, on the cubes of the flow, and the heat that the mould
/// has taken.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "cases/case_spec.hpp"
#include "input/place_spec.hpp"
#include "material/material.hpp"
#include "mesh/mesh.hpp"

namespace solidus::setup {

/// Heat that a face of the cavity has let into the mould while it filled.
struct FilledWall {
  int body = 0;          ///< that took it
  mesh::Point centre{};  ///< [m]
  double heat = 0;       ///< [J]
  double seconds = 0;    ///< for which metal touched it
};

/// The field of temperature at the end of filling of a body that is cast: of the time folder of OpenFOAM,
/// FOLDER/body_NUMBER/start. Throws InputError where the folder has none.
PlaceSpec filled_temperature(const cases::FillingSpec& filling, int body);

/// Reads FOLDER/mould_heat.csv. Throws InputError with file and line.
std::vector<FilledWall> read_filled_walls(const cases::FillingSpec& filling, std::size_t n_bodies);

/// Adds the heat of walls to the enthalpies of the nodes of a body: that of a face goes to the nodes around
/// it by w exp(-d²/(4 δ²)), w the volume of a node, d its distance and δ² = a t, the depth into which heat of
/// the diffusivity a goes in the time of contact t, but at least the distance of the nearest node. What would
/// make a node hotter than a limit goes deeper: δ² is doubled for the rest until all has found room. The sum
/// is that of the walls. Collective.
/// @param nodes       local nodes of the body, ghosts too
/// @param weights     [m³], zero for ghosts
/// @param diffusivity of the body [m²/s]
/// @param limit       enthalpy that nodes get by walls at most [J/m³]: that of the metal's temperature
/// @param enthalpies  [J/m³], is changed
void add_heat_of_walls(std::span<const FilledWall> walls, const mesh::Mesh& mesh,
                       std::span<const Index> nodes, std::span<const double> weights, double diffusivity,
                       double limit, std::span<double> enthalpies);

}  // namespace solidus::setup
