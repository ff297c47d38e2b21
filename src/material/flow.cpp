/// Which tables a flow rule reads, for the checks of their ranges and for the material's overview.
#include "material/flow.hpp"

#include "material/laws/hardening_law.hpp"
#include "material/laws/kinematic_law.hpp"
#include "material/laws/perzyna.hpp"

namespace solidus::material {

bool Flow::rate_independent() const {
  if (rate_dependence == RateDependence::perzyna) return rate[Perzyna::viscosity].max_value() == 0;
  return rate_dependence == RateDependence::none;
}

bool Flow::linear_rate() const {
  if (rate_dependence == RateDependence::perzyna) return Perzyna::linear(rate);
  return rate_dependence == RateDependence::none;
}

std::vector<Property> Flow::properties() const {
  std::vector<Property> used = {{"plasticity.flow_stress", "Pa", &flow_stress}};
  const auto add = [&used](const LawParameter& parameter, const Table& table) {
    used.push_back({std::string("plasticity.") + parameter.key, parameter.unit, &table});
  };
  // Tables in the order of the keys: isotropic hardening, kinematic hardening, rate dependence, heat.
  const auto of_isotropic = hardening_law(isotropic).parameters();
  for (std::size_t i = 0; i < of_isotropic.size(); ++i) add(of_isotropic[i], hardening[i]);
  if (kinematic != KinematicHardening::none)
    used.push_back({"plasticity.kinematic_modulus", "Pa", &kinematic_modulus});
  const auto of_kinematic = kinematic_law(kinematic).parameters();
  for (std::size_t i = 0; i < of_kinematic.size(); ++i) add(of_kinematic[i], recall[i]);
  // Of the rate law only what it reads with these parameters.
  if (!rate_independent()) {
    const RateLaw& law = rate_law(rate_dependence);
    for (std::size_t i = 0; i < law.parameters().size(); ++i)
      if (law.reads(i, rate)) add(law.parameters()[i], rate[i]);
  }
  if (heat_share) used.push_back({"plasticity.taylor_quinney", "1", &*heat_share});
  return used;
}

}  // namespace solidus::material
