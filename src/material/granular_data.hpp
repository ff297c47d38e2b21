/// The data of [granular] of a material file, as read (granular.hpp).
#pragma once

#include <optional>
#include <string>

#include "input/keys.hpp"

namespace solidus::material {

/// [granular] as read.
struct GranularData {
  Function cohesion, tension_cutoff;
  double friction_angle = 0, dilatancy_angle = 0;  ///< [rad]
  double residual_cohesion = 0;                    ///< [Pa]
  std::optional<double> softening_strain;
  std::optional<Function> burnout_rate;  ///< [1/s]
  double burnt_stiffness = 1, residual_stiffness = 0;
  double relaxation_time = 0;                 ///< [s]
  std::optional<Function> crushing_pressure;  ///< [Pa]
  std::string source;
  SourceLocation where;
};

}  // namespace solidus::material
