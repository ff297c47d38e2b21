/// A jet of water and a shot sleeve as the case gives them.
#pragma once

#include <string>
#include <vector>

#include "cases/load_spec.hpp"
#include "input/keys.hpp"
#include "system/errors.hpp"

namespace solidus::cases {

/// Water from a round nozzle that hits a surface: setup/jet_input.hpp makes a film of it.
struct JetSpec {
  std::string name, group;          ///< group: a surface of the mesh
  double nozzle = 0;                ///< its diameter [m]
  double distance = 0;              ///< from the nozzle to the surface [m]
  double radius = 0;                ///< of the circle around the place that it hits [m]
  double flow = 0;                  ///< [m³/s]
  double inlet = 0;                 ///< temperature of the water [K]
  std::vector<std::string> stages;  ///< in which it holds; empty: all
  SourceLocation where;
};

/// The sleeve in which metal waits before it is shot into the die; setup/shot_sleeve.hpp cools the metal by
/// it.
struct ShotSleeveSpec {
  std::string body;        ///< name of the [[body]] that is poured
  double diameter = 0;     ///< [m]
  double length = 0;       ///< of the metal's pool in it [m]
  double filling = 0;      ///< share of the cross-section that metal fills
  double time = 0;         ///< from the end of pouring until the die is full [s]
  double temperature = 0;  ///< of its wall [K]
  double coefficient = 0;  ///< between metal and wall [W/(m² K)]
  SourceLocation where;
};

}  // namespace solidus::cases
