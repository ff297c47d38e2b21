#include "material/flow.hpp"

#include "material/laws/hardening_law.hpp"

namespace solidus::material {

std::vector<Property> Flow::properties() const {
  std::vector<Property> used = {{"plasticity.flow_stress", "Pa", &flow_stress}};
  const auto parameters = hardening_law(isotropic).parameters();
  for (std::size_t i = 0; i < parameters.size(); ++i)
    used.push_back({std::string("plasticity.") + parameters[i].key, parameters[i].unit, &hardening[i]});
  if (kinematic != KinematicHardening::none)
    used.push_back({"plasticity.kinematic_modulus", "Pa", &kinematic_modulus});
  if (kinematic == KinematicHardening::armstrong_frederick)
    used.push_back({"plasticity.recall", "1", &recall});
  if (!rate_independent()) {
    used.push_back({"plasticity.viscosity", "Pa s", &viscosity});
    used.push_back({"plasticity.rate_exponent", "1", &exponent});
    if (!linear_rate()) used.push_back({"plasticity.drag_stress", "Pa", &drag_stress});
  }
  if (heat_share) used.push_back({"plasticity.taylor_quinney", "1", &*heat_share});
  return used;
}

}  // namespace solidus::material
