/// The section [plasticity] of a material file: its keys as read, and the flow data made of them.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "input/keys.hpp"
#include "material/material.hpp"

namespace solidus::material {

/// The keys of [[plasticity.flow_curve]].
struct FlowCurveData {
  double temperature = 0;  ///< [K]
  Function stress;         ///< over plastic strain
  SourceLocation where;
};

/// The keys of [plasticity], in SI; those that do not belong to its kinds are constant zero.
struct FlowData {
  IsotropicHardening isotropic = IsotropicHardening::none;
  Function flow_stress;
  std::map<std::string, Function> parameters;  ///< of the laws of hardening and of rate dependence
  std::vector<FlowCurveData> curves;
  KinematicHardening kinematic = KinematicHardening::none;
  Function kinematic_modulus;
  RateDependence rate_dependence = RateDependence::none;
  std::optional<Function> taylor_quinney;
  bool allow_thermal_hardening = false;
  SourceLocation where;
};

const Section<FlowData>& flow_section();

/// Checks the flow data against each other and the rest of the material, whose elastic properties, phase
/// changes and viscosity are there already, and adds them with their sources. Throws InputError with the
/// place.
void add_flow(Material& material, const FlowData& data);

}  // namespace solidus::material
