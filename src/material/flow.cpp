#include "material/flow.hpp"

namespace solidus::material {

std::vector<Property> Flow::properties() const {
  std::vector<Property> used = {{"plasticity.flow_stress", "Pa", &flow_stress}};
  if (isotropic == IsotropicHardening::saturation) {
    used.push_back({"plasticity.saturation_stress", "Pa", &saturation_stress});
    used.push_back({"plasticity.saturation_rate", "1", &saturation_rate});
  }
  if (isotropic == IsotropicHardening::linear || isotropic == IsotropicHardening::saturation)
    used.push_back({"plasticity.hardening_modulus", "Pa", &hardening_modulus});
  if (isotropic == IsotropicHardening::power) {
    used.push_back({"plasticity.reference_strain", "1", &reference_strain});
    used.push_back({"plasticity.hardening_exponent", "1", &hardening_exponent});
  }
  if (kinematic != KinematicHardening::none)
    used.push_back({"plasticity.kinematic_modulus", "Pa", &kinematic_modulus});
  if (kinematic == KinematicHardening::armstrong_frederick)
    used.push_back({"plasticity.recall", "1", &recall});
  if (!rate_independent()) {
    used.push_back({"plasticity.viscosity", "Pa s", &viscosity});
    used.push_back({"plasticity.rate_exponent", "1", &exponent});
    if (!linear_rate()) used.push_back({"plasticity.drag_stress", "Pa", &drag_stress});
  }
  return used;
}

}  // namespace solidus::material
