/// Questions about a material that follow from its tables.
#include "material/material.hpp"

#include <algorithm>

#include "material/external_law.hpp"
#include "material/laws/liquid_law.hpp"

namespace solidus::material {

const PhaseChange* Material::solidification() const {
  const auto found = std::find_if(phase_changes.begin(), phase_changes.end(),
                                  [](const PhaseChange& change) { return change.solidification; });
  return found == phase_changes.end() ? nullptr : &*found;
}

std::vector<Property> Material::properties() const {
  std::vector<Property> all = {{"conductivity", "W/m/K", &conductivity},
                               {"specific_heat", "J/kg/K", &specific_heat}};
  if (mechanical()) {
    all.push_back({"young_modulus", "Pa", &young_modulus});
    all.push_back({"poisson_ratio", "1", &poisson_ratio});
    all.push_back({"expansion", "1/K", &expansion});
  }
  if (liquid_viscosity.max_value() > 0) all.push_back({"twice_shear_viscosity", "Pa s", &liquid_viscosity});
  if (flow)
    for (const Property& property : flow->properties()) all.push_back(property);
  for (const auto& [key, given] : added) all.push_back({key, given.unit, &given.table});
  return all;
}

double Material::solid_fraction(double temperature) const {
  const PhaseChange* change = solidification();
  return change == nullptr ? 1.0 : change->fraction.value(temperature);
}

bool Material::chooses_viscosity() const {
  return liquid_law(liquid_model).dashpot() && solidification() != nullptr &&
         !(liquid_viscosity.max_value() > 0);
}

const ExternalLaw* external_law(const Material& material) {
  return material.external.get();
}
std::string name_of_law(const Material& material) {
  const bool granular = material.external != nullptr && material.external->built_in();
  return (granular ? "the granular law of '" : "the law from outside of '") + material.name + "'";
}
void set_external_law(Material& material, std::shared_ptr<const ExternalLaw> law) {
  material.external = std::move(law);
}

}  // namespace solidus::material
