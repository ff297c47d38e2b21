/// Elasto-viscoplastic materials for tests of the mechanical phase.
#pragma once

#include "body.hpp"
#include "material/laws/hardening_law.hpp"
#include "material/laws/perzyna.hpp"

namespace solidus::test {

/// Saturating and linear isotropic hardening and kinematic hardening, thermal softening, linear rate
/// dependence. Yields at 40 MPa (300 K), 0.02 % of strain.
inline material::Material plastic_material(
    material::KinematicHardening kinematic = material::KinematicHardening::linear) {
  material::Material m = elastic_material(2e11, 0.3, 1e-5);
  material::Flow flow;
  flow.flow_stress = Table({300, 500}, {4e7, 2e7});
  flow.isotropic = material::IsotropicHardening::saturation;
  set_hardening(flow, {{"saturation_stress", Table({300, 500}, {9e7, 5e7})},
                       {"saturation_rate", 200.0},
                       {"hardening_modulus", Table({300, 500}, {1e9, 7e8})}});
  flow.kinematic = kinematic;
  flow.kinematic_modulus = Table({300, 500}, {2e10, 1.6e10});
  flow.recall[0] = 300.0;
  flow.rate[material::Perzyna::viscosity] = 1e9;
  m.flow = flow;
  return m;
}

/// Rate-independent, without hardening.
inline material::Material perfectly_plastic(double flow_stress) {
  material::Material m = elastic_material(2e11, 0.3, 1e-5);
  material::Flow flow;
  flow.flow_stress = flow_stress;
  flow.rate[material::Perzyna::viscosity] = 0.0;
  m.flow = flow;
  return m;
}

}  // namespace solidus::test
