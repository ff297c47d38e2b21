#include "model/contact_input.hpp"

namespace solidus::model {

std::vector<contact::ContactSpec> contact_specs(const CaseSpec& spec) {
  std::vector<contact::ContactSpec> result;
  for (const ContactSpec& c : spec.contacts) {
    contact::ContactSpec pair;
    pair.name = c.name;
    pair.slave = c.slave;
    pair.master = c.master;
    pair.penalty_is_factor = !c.penalty;
    pair.penalty = c.penalty.value_or(c.penalty_factor);
    pair.stabilisation = c.stabilisation;
    pair.integration = c.integration;
    pair.gauss_degree = c.gauss_degree;
    pair.search_distance = c.search_distance;
    pair.touching = c.touching;
    pair.heat = c.heat;
    pair.nodal_heat = spec.heat.integration == heat::Integration::closed;
    pair.where = c.where;
    result.push_back(std::move(pair));
  }
  return result;
}

std::vector<double> contact_moduli(const std::vector<material::Material>& materials) {
  constexpr double k_room_temperature = 293.15, k_any = 1e9;
  std::vector<double> moduli;
  for (const auto& m : materials)
    moduli.push_back(m.mechanical() ? m.young_modulus.value(k_room_temperature) : k_any);
  return moduli;
}

}  // namespace solidus::model
