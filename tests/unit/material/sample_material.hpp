/// A material with every property varying, for the tests of laws: nothing cancels by accident.
#pragma once

#include "material/material.hpp"

namespace solidus::material {

inline Material sample_material() {
  Material m;
  m.name = "sample";
  m.density = 2650;
  m.conductivity = Table({300, 900}, {230, 200});
  m.specific_heat = Table({300, 900}, {900, 1200});
  m.phase_changes = {{"solidification", PhaseFraction::linear(880, 930), 3.95e5, -0.05, true},
                     {"transformation", PhaseFraction::linear(700, 760), 2e4, 0.01, false}};
  m.young_modulus = Table({300, 600, 950}, {70e9, 50e9, 20e9});
  m.poisson_ratio = Table({300, 950}, {0.33, 0.42});
  m.expansion = Table({300, 950}, {2.1e-5, 2.9e-5});
  m.liquid_viscosity = Table({800, 1000}, {2e9, 1e9});
  return m;
}

}  // namespace solidus::material
