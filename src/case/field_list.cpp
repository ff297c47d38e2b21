#include "case/field_list.hpp"

#include <algorithm>
#include <cassert>
#include <iterator>

namespace solidus::model {

namespace {

constexpr auto k_vector = FieldInfo::Rank::vector, k_tensor = FieldInfo::Rank::tensor,
               k_scalar = FieldInfo::Rank::scalar;

constexpr FieldInfo k_fields[] = {{"temperature", "K"},
                                  {"heat_flux", "W/m2", k_vector},
                                  {"conduction_dissipation", "W/m3"},
                                  {"solid_fraction", "1"},
                                  {"displacement", "m", k_vector},
                                  {"velocity", "m/s", k_vector},
                                  {"acceleration", "m/s2", k_vector},
                                  {"stress", "Pa", k_tensor},
                                  {"von_mises", "Pa"},
                                  {"pressure", "Pa"},
                                  {"viscous_strain", "1", k_tensor},
                                  {"dissipation", "W/m3"},
                                  {"plastic_strain", "1", k_tensor},
                                  {"equivalent_plastic_strain", "1"},
                                  {"back_stress", "Pa", k_tensor},
                                  {"flow_stress", "Pa"},
                                  {"pore_fraction", "1"},
                                  {"thermal_dissipation", "W/m3"},
                                  {"inelastic_entropy", "J/m3/K"},
                                  {"strain", "1", k_tensor},
                                  {"intermediate_temperature", "K"},
                                  {"nodal_stress", "Pa", k_tensor},
                                  {"nodal_von_mises", "Pa"},
                                  {"principal_stress_1", "Pa"},
                                  {"principal_stress_2", "Pa"},
                                  {"principal_stress_3", "Pa"},
                                  {"contact_pressure", "Pa", k_scalar, true},
                                  {"gap", "m", k_scalar, true},
                                  {"conductance", "W/m2/K", k_scalar, true},
                                  {"contact_heat_flux", "W/m2", k_scalar, true},
                                  {"frictional_heat_flux", "W/m2", k_scalar, true},
                                  {"friction_traction", "Pa", k_vector, true},
                                  {"contact_status", "1", k_scalar, true},
                                  {"slip", "m", k_scalar, true},
                                  {"internal_variable", "N/m", k_scalar, true},
                                  {"friction_coefficient", "1", k_scalar, true},
                                  {"friction_dissipation", "J/m2", k_scalar, true},
                                  {"wear_depth", "m", k_scalar, true},
                                  {"interface_temperature", "K", k_scalar, true},
                                  {"solidified_at", "s"},
                                  {"local_solidification_time", "s"},
                                  {"cooling_rate", "K/s"},
                                  {"thermal_gradient", "K/m"},
                                  {"front_speed", "m/s"},
                                  {"secondary_arm_spacing", "m"},
                                  {"niyama", "1"},
                                  {"dimensionless_niyama", "1"},
                                  {"shrinkage_porosity", "1"},
                                  {"liquid_pool", "1"},
                                  {"pool_volume", "m3"},
                                  {"strain_in_liquid", "1"},
                                  {"strain_since_coherency", "1"},
                                  {"brittle_strain", "1"},
                                  {"distortion", "m", k_vector}};

}  // namespace

const FieldInfo& field_info(std::string_view name) {
  const auto* found = std::find_if(std::begin(k_fields), std::end(k_fields),
                                   [&](const FieldInfo& f) { return f.name == name; });
  assert(found != std::end(k_fields));
  return *found;
}

std::vector<std::string> field_names(bool with_contact) {
  std::vector<std::string> names;
  for (const FieldInfo& field : k_fields)
    if (with_contact || !field.of_contact) names.emplace_back(field.name);
  return names;
}

}  // namespace solidus::model
